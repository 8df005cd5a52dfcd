#include "castor/base/markup.hpp"

#include <gtest/gtest.h>

namespace castor {

namespace {

TEST(Markup, EscapesWhatMarkupIsMadeOf) {
  EXPECT_EQ(escaped(R"(<a href="x">'&')"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
}

TEST(Markup, KeepsCharactersOfUnicode) {
  EXPECT_EQ(escaped("6 × grün – 0,5 s …"), "6 × grün – 0,5 s …");
}

TEST(Markup, MakesControlCharactersAndBytesThatAreNoneVisible) {
  EXPECT_EQ(escaped("a\x1b[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(escaped("\xc3"), "\\xc3");
}

TEST(Markup, KeepsLinesApart) {
  EXPECT_EQ(escaped("a\n<\n\nb\n"), "a\n&lt;\n\nb\n");
  EXPECT_EQ(escaped(""), "");
}

} // namespace

} // namespace castor
