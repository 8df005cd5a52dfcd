#include "castor/base/text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor {

namespace {

TEST(Text, IsTrimmedOfBlanksAndControlCharacters) {
  EXPECT_EQ(trim(std::string_view("\x01\t a b \0\n", 9)), "a b");
  EXPECT_EQ(trim("   "), "");
}

TEST(Text, IsSplitIntoWords) {
  std::string_view rest = " a\t\tbc ";
  EXPECT_EQ(take_word(rest), "a");
  EXPECT_EQ(take_word(rest), "bc");
  EXPECT_EQ(take_word(rest), "");
  EXPECT_EQ(take_word(rest), "");
}

TEST(Text, IsShortenedAtCharacterBoundaries) {
  EXPECT_EQ(shorten("abc", 3), "abc");
  EXPECT_EQ(shorten("abcd", 3), "abc...");
  EXPECT_EQ(shorten("ab\xc3\xa4", 3), "ab...");
  EXPECT_EQ(shorten("\x80\x80\x80\x80\x80\x80", 5), "\x80\x80...");
}

TEST(Text, IsQuoted) {
  EXPECT_EQ(in_quotes("a"), "'a'");
  EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 100U);
}

TEST(Text, IsMadePrintable) {
  EXPECT_EQ(printable("a\tb\x7f\x01 \xc3\xa4"), "a b\\x7f\\x01 \xc3\xa4");
  EXPECT_EQ(printable("\xe2\x82\xac \xf0\x9f\x98\x80"), "\xe2\x82\xac \xf0\x9f\x98\x80");
  // A control sequence introducer of eight bits, and the order of writing turned round.
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J"),
            "\\xc2\\x9b2J");
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "a"),
            "\\xe2\\x80\\xaea");
  // Not UTF-8: a byte alone, one cut off, one longer than it need be, a surrogate.
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");
  EXPECT_EQ(printable("\xc0\x80"), "\\xc0\\x80");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
}

TEST(Text, EveryOccurrenceIsReplaced) {
  auto replaced = [](std::string text, std::string_view from, std::string_view to) {
    replace_all(text, from, to);
    return text;
  };
  EXPECT_EQ(replaced("a NAME and a NAME", "NAME", "castor"), "a castor and a castor");
  EXPECT_EQ(replaced("aaa", "aa", "b"), "ba");
  EXPECT_EQ(replaced("x.y", ".", ".."), "x..y");
  EXPECT_EQ(replaced("none", "other", "any"), "none");
}

TEST(Text, KnowsIdentifiers) {
  EXPECT_TRUE(is_identifier("aZ_9"));
  for (auto text : {"", "9a", "_a", "a-b", "\xc3\xa4"})
    EXPECT_FALSE(is_identifier(text)) << text;
}

TEST(Text, LinesAreJoinedWithoutIndentation) {
  EXPECT_EQ(on_one_line("file:2: error: no word\n    colour azure\n\n  Mend it.\n"),
            "file:2: error: no word; colour azure; Mend it.");
  EXPECT_EQ(on_one_line("one"), "one");
  EXPECT_EQ(on_one_line(""), "");
}

} // namespace

} // namespace castor
