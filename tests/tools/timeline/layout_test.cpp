#include "castor/tests/tools/timeline/support.hpp"

#include "castor/tools/timeline/layout.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace castor::timeline::test {

namespace {

using testing::IsEmpty;
using testing::SizeIs;

bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

bool contains(const Box& outer, const Box& inner) {
  return outer.x <= inner.x && inner.right() <= outer.right() && outer.y <= inner.y &&
         inner.bottom() <= outer.bottom();
}

Layout layout_of(const Figure& figure) {
  return lay_out(figure, select(figure));
}

TEST(TimelineLayout, ArrowsGoFromWhatIsSeenToWhatIsSeen) {
  Story story;
  story.write(0s, "a", "1").write(0s, "b", "2", Pointer{{"a", "1"}});
  story.write(1s, "a", "3");
  auto figure = figure_of(story, {"a", "b"});
  ASSERT_THAT(figure.columns, SizeIs(3));
  auto layout = layout_of(figure);
  // Of two entries in the stage in which the second comes, and in that after it.
  ASSERT_THAT(layout.arrows, SizeIs(2));
  EXPECT_FALSE(layout.arrows[0].is_old);
  EXPECT_TRUE(layout.arrows[1].is_old);
  for (auto& x : layout.arrows) {
    EXPECT_EQ(layout.cards[x.from].row, 1u);
    EXPECT_EQ(layout.cards[x.to].row, 0u);
    EXPECT_EQ(layout.cards[x.from].column, layout.cards[x.to].column);
    EXPECT_FALSE(x.both_ways);
  }
}

TEST(TimelineLayout, ThoseThatReferToEachOtherHaveOneArrow) {
  Story story;
  story.write(0s, "a", "1", Note{"", {"2"}}).write(0s, "a", "2", Pointer{{"a", "1"}});
  auto layout = layout_of(figure_of(story));
  ASSERT_THAT(layout.arrows, SizeIs(1));
  EXPECT_TRUE(layout.arrows[0].both_ways);
}

TEST(TimelineLayout, WhatIsNotSeenIsCounted) {
  Story story;
  for (int i = 10; i < 63; ++i)
    story.write(0s, "a", std::to_string(i));
  story.write(1ms, "a", "p", Pointer{{"a", "10"}});
  auto layout = layout_of(figure_of(story));
  ASSERT_THAT(layout.chips, SizeIs(1));
  EXPECT_EQ(layout.chips[0].text.text, "+ 49 more");
  EXPECT_THAT(layout.chips[0].entries, SizeIs(49));
}

TEST(TimelineLayout, ARunInWhichNothingHappensHasOnlyRows) {
  auto layout = layout_of(figure_of(Story{}, {"a", "b"}));
  EXPECT_THAT(layout.rows, SizeIs(2));
  EXPECT_THAT(layout.cards, IsEmpty());
  EXPECT_GT(layout.width, 0);
}

RC_GTEST_PROP(TimelineLayout, NothingLiesOnAnythingElse, ()) {
  Story story;
  Timestamp time{0};
  auto count = *rc::gen::inRange(0, 80);
  auto text = [] {
    auto length = *rc::gen::inRange(0, 150);
    return *rc::gen::container<std::string>(static_cast<std::size_t>(length),
                                            rc::gen::element('w', 'i', ' ', '_', '\xc3'));
  };
  for (int i = 0; i < count; ++i) {
    time += *rc::gen::element<Timestamp>(1ms, 300ms);
    auto where = *rc::gen::element<std::string>("a", "b", "c");
    auto id = std::to_string(*rc::gen::inRange(0, 15)) + (i % 7 == 0 ? text() : "");
    auto about = std::to_string(*rc::gen::inRange(0, 15));
    switch (*rc::gen::inRange(0, 4)) {
      case 0:
        story.write(time, where, "n" + id, Note{text(), {about, "n" + about}});
        break;
      case 1:
        story.write(time, where, "p" + id, Pointer{{"a", "n" + about}});
        break;
      case 2: {
        auto side = *rc::gen::element<std::uint32_t>(1, 20, 200, 400);
        story.write(time, where, "s" + id,
                    Sight{{image(side, 30), image(3, side)}, {{"b", "p" + about}}, {}});
        break;
      }
      default:
        story.write(time, where, "x" + about).remove(time + 1ms, where, "x" + about);
    }
  }
  auto figure = figure_of(story);
  auto layout = layout_of(figure);
  struct Placed {
    Box box;
    std::size_t row;
  };
  std::vector<Placed> all;
  for (auto& x : layout.cards)
    all.push_back({x.box, x.row});
  for (auto& x : layout.chips)
    all.push_back({x.box, x.row});
  for (auto& x : layout.labels)
    all.push_back({x.box, x.row});
  for (std::size_t i = 0; i < all.size(); ++i) {
    RC_ASSERT(contains(layout.rows[all[i].row], all[i].box));
    RC_ASSERT(std::ranges::any_of(layout.columns, [&](const Box& x) {
      return x.x <= all[i].box.x && all[i].box.right() <= x.right();
    }));
    for (std::size_t j = 0; j < i; ++j)
      RC_ASSERT(!overlap(all[i].box, all[j].box));
  }
  for (std::size_t i = 0; i < layout.rows.size(); ++i) {
    RC_ASSERT(contains({0, 0, layout.width, layout.height}, layout.rows[i]));
    for (std::size_t j = 0; j < i; ++j)
      RC_ASSERT(!overlap(layout.rows[i], layout.rows[j]));
  }
  for (auto& card : layout.cards) {
    for (auto& x : card.pictures)
      RC_ASSERT(contains(card.box, x.box));
    for (auto& x : card.lines)
      RC_ASSERT(x.y <= card.box.bottom());
  }
}

} // namespace

} // namespace castor::timeline::test
