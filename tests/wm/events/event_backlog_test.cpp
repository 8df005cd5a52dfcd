#include "castor/wm/events/event_backlog.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using Filters = FilterIds;
using Lines = std::vector<std::string>;

ChangeEventPtr event(Operation operation, const std::string& id, Version version,
                     FieldMask changed = 0) {
  static std::uint64_t sequence = 0;
  auto result = std::make_shared<ChangeEvent>();
  result->operation = operation;
  result->address = {"a", id};
  result->source = "writer";
  result->type = descriptor_of<Box>();
  result->version = version;
  result->sequence = ++sequence;
  result->changed = changed;
  return result;
}

ChangeEventPtr add(const std::string& id, Version version = 0) {
  return event(Operation::add, id, version);
}
ChangeEventPtr overwrite(const std::string& id, Version version, FieldMask changed = 1) {
  return event(Operation::overwrite, id, version, changed);
}
ChangeEventPtr remove(const std::string& id, Version version = 0) {
  return event(Operation::remove, id, version);
}

/// "ADD x v1 for 1 2, coalesced", a line for each notice in the order in which they come out.
Lines drained(EventBacklog& backlog) {
  Lines result;
  while (!backlog.empty())
    for (auto& [e, filters] : backlog.pop()) {
      auto& line = result.emplace_back(to_string(e->operation));
      line += ' ' + e->address.id + " v" + std::to_string(e->version);
      if (e->changed != 0)
        line += " changed " + std::to_string(e->changed);
      line += " for";
      for (auto filter : filters)
        line += ' ' + std::to_string(filter);
      if (e->coalesced)
        line += ", coalesced";
    }
  return result;
}

/// What comes out of a backlog that merges from the first event on.
Lines merged(const std::vector<ChangeEventPtr>& events) {
  EventBacklog backlog{0};
  for (auto& x : events)
    backlog.push(x, {1});
  return drained(backlog);
}

TEST(EventBacklog, GivesBackUnchangedWhatStaysWithinItsBound) {
  EventBacklog backlog{3};
  auto first = add("x");
  backlog.push(first, {1, 2});
  backlog.push(overwrite("x", 1), {2});
  backlog.push(remove("x", 1), {1, 2});
  EXPECT_EQ(backlog.size(), 3u);
  EXPECT_FALSE(backlog.is_merging());
  auto batch = backlog.pop();
  ASSERT_EQ(batch.size(), 1u);
  EXPECT_EQ(batch[0].event, first);
  EXPECT_EQ(batch[0].filters, (Filters{1, 2}));
  EXPECT_EQ(drained(backlog), (Lines{"OVERWRITE x v1 changed 1 for 2", "DELETE x v1 for 1 2"}));
  EXPECT_EQ(backlog.suppressed(), 0u);
}

TEST(EventBacklog, MergesEachEntrysStory) {
  EXPECT_EQ(merged({add("x"), overwrite("x", 1), overwrite("x", 2)}),
            (Lines{"ADD x v2 for 1, coalesced"}));
  EXPECT_EQ(merged({overwrite("x", 1, 1), overwrite("x", 2, 4)}),
            (Lines{"OVERWRITE x v2 changed 5 for 1, coalesced"}));
  EXPECT_EQ(merged({overwrite("x", 1), remove("x", 1)}), (Lines{"DELETE x v1 for 1, coalesced"}));
  EXPECT_EQ(merged({add("x"), overwrite("x", 1), remove("x", 1)}), Lines{});
  EXPECT_EQ(merged({remove("x"), add("x", 1)}), (Lines{"DELETE x v0 for 1", "ADD x v1 for 1"}));
  EXPECT_EQ(merged({remove("x"), add("x", 1), overwrite("x", 2)}),
            (Lines{"DELETE x v0 for 1", "ADD x v2 for 1, coalesced"}));
  EXPECT_EQ(merged({remove("x"), add("x", 1), remove("x", 1)}),
            (Lines{"DELETE x v1 for 1, coalesced"}));
}

TEST(EventBacklog, LeavesAloneWhatStandsAlone) {
  EventBacklog backlog{0};
  auto x = add("x");
  auto y = overwrite("y", 3, 6);
  backlog.push(x, {1});
  backlog.push(y, {1});
  EXPECT_EQ(backlog.pop().front().event, x);
  EXPECT_EQ(backlog.pop().front().event, y);
}

TEST(EventBacklog, PutsAMergedEventInThePlaceOfItsNewest) {
  EXPECT_EQ(
    merged({overwrite("x", 1), add("y"), overwrite("x", 2), add("z")}),
    (Lines{"ADD y v0 for 1", "OVERWRITE x v2 changed 1 for 1, coalesced", "ADD z v0 for 1"}));
  EventBacklog backlog{0};
  backlog.push(add("x"), {1});
  auto newest = std::make_shared<ChangeEvent>(*overwrite("x", 1));
  newest->source = "another";
  newest->time = Timestamp{7};
  backlog.push(newest, {1});
  auto merged = backlog.pop().front().event;
  EXPECT_EQ(merged->sequence, newest->sequence);
  EXPECT_EQ(merged->source, "another");
  EXPECT_EQ(merged->time, Timestamp{7});
}

TEST(EventBacklog, TellsEachFilterOfItsOwnPartOfTheStory) {
  constexpr std::uint32_t any = 1, adds = 2, overwrites = 3, deletions = 4;
  EventBacklog backlog{0};
  backlog.push(add("x"), {any, adds});
  backlog.push(overwrite("x", 1), {any, overwrites});
  EXPECT_EQ(drained(backlog), (Lines{"ADD x v0 for 2", "ADD x v1 for 1, coalesced",
                                     "OVERWRITE x v1 changed 1 for 3"}));
  backlog.push(overwrite("x", 2), {any, overwrites});
  backlog.push(remove("x", 2), {any, deletions});
  backlog.push(add("x", 3), {any, adds});
  EXPECT_EQ(drained(backlog),
            (Lines{"DELETE x v2 for 1, coalesced", "DELETE x v2 for 4", "ADD x v3 for 1 2"}));
}

TEST(EventBacklog, SharesANoticeAmongFiltersThatGetTheSame) {
  EventBacklog backlog{0};
  backlog.push(overwrite("x", 1, 1), {1, 2, 3});
  backlog.push(overwrite("x", 2, 2), {1, 2, 4});
  EXPECT_EQ(backlog.size(), 3u);
  EXPECT_EQ(drained(backlog),
            (Lines{"OVERWRITE x v1 changed 1 for 3", "OVERWRITE x v2 changed 3 for 1 2, coalesced",
                   "OVERWRITE x v2 changed 2 for 4"}));
}

TEST(EventBacklog, DoesNotMixTheFieldsOfDifferentTypes) {
  auto second = std::make_shared<ChangeEvent>(*overwrite("x", 3, 2));
  second->type = descriptor_of<SignedBox>();
  EXPECT_EQ(merged({overwrite("x", 1, 1), second}),
            (Lines{"OVERWRITE x v3 changed 2 for 1, coalesced"}));
}

TEST(EventBacklog, KeepsOneWriteInOnePieceUnlessItMerges) {
  EventBacklog backlog{3};
  backlog.push({{add("x"), {1}}, {add("y"), {1}}});
  backlog.push(add("z"), {1});
  EXPECT_EQ(backlog.size(), 3u);
  EXPECT_EQ(backlog.pop().size(), 2u);
  backlog.push({{add("v"), {1}}, {add("w"), {1}}, {overwrite("v", 1), {2}}});
  EXPECT_TRUE(backlog.is_merging());
  EXPECT_EQ(backlog.pop().size(), 1u);
  EXPECT_EQ(drained(backlog),
            (Lines{"ADD v v0 for 1", "ADD w v0 for 1", "OVERWRITE v v1 changed 1 for 2"}));
}

TEST(EventBacklog, MergesUntilItIsEmptied) {
  EventBacklog backlog{2};
  backlog.push(add("x"), {1});
  backlog.push(overwrite("x", 1), {1});
  EXPECT_FALSE(backlog.is_merging());
  backlog.push(overwrite("x", 2), {1});
  EXPECT_TRUE(backlog.is_merging());
  EXPECT_EQ(backlog.size(), 1u);
  backlog.push(add("y"), {1});
  EXPECT_EQ(backlog.pop().size(), 1u);
  EXPECT_TRUE(backlog.is_merging()) << "something waits still";
  EXPECT_EQ(drained(backlog), (Lines{"ADD y v0 for 1"}));
  backlog.push(overwrite("x", 3), {1});
  backlog.push(overwrite("x", 4), {1});
  EXPECT_EQ(drained(backlog),
            (Lines{"OVERWRITE x v3 changed 1 for 1", "OVERWRITE x v4 changed 1 for 1"}));
}

TEST(EventBacklog, TellsOfTheEndOfWhatItHasToldTheBeginningOf) {
  EventBacklog backlog{0};
  backlog.push(add("x"), {1});
  backlog.push(add("y"), {1});
  EXPECT_EQ(backlog.pop().front().event->address.id, "x");
  EXPECT_TRUE(backlog.is_merging());
  backlog.push(remove("x"), {1});
  backlog.push(remove("y"), {1});
  EXPECT_EQ(drained(backlog), (Lines{"DELETE x v0 for 1"}));
}

TEST(EventBacklog, KeepsNothingOfEntriesThatCameAndWentWhileItMerged) {
  constexpr std::uint32_t adds = 2, overwrites = 3, deletions = 4;
  EventBacklog backlog{0};
  backlog.push(add("stays"), {adds});
  for (int i = 0; i < 100; ++i) {
    auto id = std::to_string(i);
    backlog.push(add(id), {adds});
    backlog.push(overwrite(id, 1), {overwrites});
    backlog.push(remove(id, 1), {deletions});
    // Here nobody wanted to hear of the beginning, there nobody of the end.
    backlog.push(add(id, 2), {});
    backlog.push(remove(id, 2), {deletions});
    backlog.push(add(id, 3), {adds});
    backlog.push(remove(id, 3), {});
  }
  EXPECT_EQ(backlog.size(), 1u);
  EXPECT_EQ(backlog.suppressed(), 500u);
  EXPECT_EQ(drained(backlog), (Lines{"ADD stays v0 for 2"}));
}

TEST(EventBacklog, IgnoresWhatNobodyWantsWhileItDoesNotMerge) {
  EventBacklog backlog{1};
  backlog.push(add("x"), {});
  EXPECT_TRUE(backlog.empty());
  backlog.push({{add("x"), {}}, {add("y"), {1}}});
  EXPECT_EQ(backlog.size(), 1u);
  EXPECT_FALSE(backlog.is_merging());
}

TEST(EventBacklog, ForgetsAFilter) {
  for (std::size_t bound : {0, 10}) {
    EventBacklog backlog{bound};
    backlog.push(add("x"), {1, 2});
    backlog.push(add("y"), {1});
    backlog.push({{add("z"), {2}}, {add("w"), {1}}});
    backlog.erase(1);
    EXPECT_EQ(backlog.size(), 2u);
    EXPECT_EQ(backlog.suppressed(), 2u);
    // Another filter of that number knows nothing of what its predecessor wanted.
    backlog.push(overwrite("y", 1), {1});
    EXPECT_EQ(drained(backlog),
              (Lines{"ADD x v0 for 2", "ADD z v0 for 2", "OVERWRITE y v1 changed 1 for 1"}));
    backlog.push(add("v"), {3});
    backlog.erase(3);
    EXPECT_TRUE(backlog.empty());
    EXPECT_FALSE(backlog.is_merging());
  }
}

TEST(EventBacklog, CountsWhatItKeptBack) {
  EventBacklog backlog{0};
  backlog.push(overwrite("x", 1), {1});
  for (Version version = 2; version <= 10; ++version)
    backlog.push(overwrite("x", version), {1});
  EXPECT_EQ(backlog.suppressed(), 9u);
  backlog.push(add("y"), {1});
  backlog.push(remove("y"), {1});
  EXPECT_EQ(backlog.suppressed(), 11u);
  EXPECT_EQ(drained(backlog).size(), 1u);
  EXPECT_EQ(backlog.suppressed(), 11u);
}

} // namespace

} // namespace castor::test
