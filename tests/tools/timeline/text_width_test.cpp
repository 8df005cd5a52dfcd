#include "castor/tools/timeline/text_width.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace castor::timeline::test {

namespace {

using testing::ElementsAre;

TEST(TextWidth, IsThatOfTheInstalledFont) {
  // Liberation Sans, which scripts/setup.sh installs: 667 + 222 thousandths, 722 + 278 in bold.
  EXPECT_NEAR(text_width("Ai", 10), 8.89, 0.02);
  EXPECT_NEAR(text_width("Ai", 10, true), 10.0, 0.02);
  EXPECT_NEAR(text_width("\u2192", 10), 10, 0.02);
  EXPECT_EQ(text_width("", 10), 0);
}

TEST(TextWidth, GrowsWithTheSizeAndTakesAnyBytes) {
  EXPECT_NEAR(text_width("blue disc", 22), 2 * text_width("blue disc", 11), 0.1);
  EXPECT_GT(text_width("\xff\xfe", 10), 0);
}

TEST(TextWidth, WhatDoesNotFitEndsWithAnEllipsisAfterAWholeLetter) {
  EXPECT_EQ(fitted("blue", 100, 10), "blue");
  EXPECT_EQ(fitted("\u00e4\u00e4\u00e4\u00e4", 22, 10), "\u00e4\u00e4\u2026");
}

TEST(TextWidth, LinesAreBrokenBetweenWords) {
  EXPECT_THAT(wrapped("aaa bbb ccc", 40, 10, 5), ElementsAre("aaa bbb", "ccc"));
  EXPECT_THAT(wrapped("aaa bbb ccc ddd eee", 40, 10, 2), ElementsAre("aaa bbb", "ccc dd\u2026"));
  EXPECT_THAT(wrapped("", 40, 10, 2), ElementsAre());
}

RC_GTEST_PROP(TextWidth, NothingIsWiderThanItMayBe, (const std::string& text)) {
  auto width = *rc::gen::inRange(15, 200);
  RC_ASSERT(text_width(fitted(text, width, 10), 10) <= width);
  auto most = *rc::gen::inRange<std::size_t>(1, 5);
  auto lines = wrapped(text, width, 10, most);
  RC_ASSERT(lines.size() <= most);
  for (auto& x : lines)
    RC_ASSERT(text_width(x, 10) <= width);
}

} // namespace

} // namespace castor::timeline::test
