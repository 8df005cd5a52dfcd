#include "castor/base/text.hpp"

#include "castor/actors/cast/paths.hpp"
#include "castor/base/suggestion.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::cast {

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

TEST(Text, KnowsIdentifiers) {
  EXPECT_TRUE(is_identifier("aZ_9"));
  for (auto text : {"", "9a", "_a", "a-b", "\xc3\xa4"})
    EXPECT_FALSE(is_identifier(text)) << text;
}

TEST(EditDistance, CountsChanges) {
  EXPECT_EQ(edit_distance("abc", "abc", 3), 0U);
  EXPECT_EQ(edit_distance("abc", "abd", 3), 1U);
  EXPECT_EQ(edit_distance("abc", "acb", 3), 1U);
  EXPECT_EQ(edit_distance("abc", "bc", 3), 1U);
  EXPECT_EQ(edit_distance("", "abc", 3), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting", 5), 3U);
}

TEST(EditDistance, StopsAtTheLimit) {
  EXPECT_EQ(edit_distance("abc", "xyz", 1), 2U);
  EXPECT_EQ(edit_distance("a", "abcdef", 2), 3U);
  EXPECT_EQ(edit_distance(std::string(100, 'a'), std::string(100, 'a'), 2), 3U);
}

TEST(Suggestions, TakeTheNearestCandidate) {
  std::vector<std::string_view> candidates{"HOST", "HOSTNAME", "COMPONENT"};
  EXPECT_EQ(nearest("HOTS", candidates), "HOST");
  EXPECT_EQ(nearest("hostname", candidates), "HOSTNAME");
  EXPECT_EQ(nearest("COMPONNET", candidates), "COMPONENT");
  EXPECT_EQ(nearest("vision", candidates), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("", candidates), "");
}

TEST(Suggestions, AreQuestions) {
  EXPECT_EQ(did_you_mean("HOTS", {"HOST"}), "did you mean 'HOST'?");
  EXPECT_EQ(did_you_mean("other", {"HOST"}), "");
  EXPECT_EQ(did_you_mean("HOST", {"HOST", "HOTS"}), "")
    << "it is there, and cannot be what was meant";
}

TEST(Paths, HaveDirectories) {
  EXPECT_EQ(directory_of("a.cast"), "");
  EXPECT_EQ(directory_of("x/a.cast"), "x");
  EXPECT_EQ(directory_of("/a.cast"), "/");
}

TEST(Paths, OfIncludesAreRelativeToTheIncludingFile) {
  EXPECT_EQ(include_target("a.cast", "b.cast"), "b.cast");
  EXPECT_EQ(include_target("x/a.cast", "y/b.cast"), "x/y/b.cast");
  EXPECT_EQ(include_target("x/a.cast", "/b.cast"), "/b.cast");
  EXPECT_EQ(include_target("/a.cast", "b.cast"), "/b.cast");
}

TEST(Paths, AreRelativeInTheWorkingDirectoryOnly) {
  EXPECT_EQ(path_for_users("x/a", "/home/me"), "x/a");
  EXPECT_EQ(path_for_users("./x//a/.", "/home/me/"), "x/a");
  EXPECT_EQ(path_for_users("/home/me/x", "/home/me"), "x");
  EXPECT_EQ(path_for_users("/home/me", "/home/me"), ".");
  EXPECT_EQ(path_for_users("/home/me2/x", "/home/me"), "/home/me2/x");
  EXPECT_EQ(path_for_users("/x", "/"), "x");
  EXPECT_EQ(path_for_users("../x", "/home/me"), "../x");
  EXPECT_EQ(directory_for_users("a.cast", "/home/me"), ".");
  EXPECT_EQ(directory_for_users("x/../a.cast", "/home/me"), "x/..");
}

TEST(Text, LinesAreJoinedWithoutIndentation) {
  EXPECT_EQ(on_one_line("file:2: error: no word\n    colour azure\n\n  Mend it.\n"),
            "file:2: error: no word; colour azure; Mend it.");
  EXPECT_EQ(on_one_line("one"), "one");
  EXPECT_EQ(on_one_line(""), "");
}

} // namespace

} // namespace castor::cast
