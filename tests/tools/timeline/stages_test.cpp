#include "castor/tests/tools/timeline/support.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

namespace castor::timeline::test {

namespace {

using testing::ElementsAre;
using testing::SizeIs;

using Changes = std::vector<std::vector<std::string>>;

TEST(TimelineStages, APauseEndsAStage) {
  Story story;
  story.write(10ms, "a", "1").write(200ms, "a", "2").write(700ms, "a", "1");
  EXPECT_EQ(story.changes(), (Changes{{"a/1", "a/2"}, {"a/1"}}));
  auto& last = story.stages.list().back();
  EXPECT_EQ(last.pause, Timestamp{500ms});
  EXPECT_FALSE(last.changed.begin()->second.is_new);
}

TEST(TimelineStages, WhatGoesOnDoesNotHideThatSomethingBegins) {
  Story story;
  for (auto i = 1; i < 50; ++i)
    story.write(i * 100ms, "a", "clock");
  story.write(4900ms, "a", "new", Pointer{});
  EXPECT_THAT(story.changes(), SizeIs(2));
  EXPECT_THAT(story.changes().back(), ElementsAre("a/new"));
}

TEST(TimelineStages, WhatHasJustBegunToRepeatItselfKeepsItsStageOpen) {
  Story story;
  for (auto i = 1; i < 6; ++i)
    story.write(i * 100ms, "a", "clock");
  story.write(600ms, "a", "new", Pointer{});
  EXPECT_THAT(story.changes(), SizeIs(1));
}

TEST(TimelineStages, WorkThatPassesOnToAnotherWorkingMemoryIsALaterStage) {
  Story story;
  // As in the paper's figure: vision, then space and binding, then binding again.
  story.write(1ms, "vision", "object")
    .write(2ms, "spatial", "location", Pointer{{"vision", "object"}})
    .write(3ms, "binding", "proxy of object", Note{})
    .write(4ms, "vision", "object", Note{"recognised", {}})
    .write(5ms, "binding", "union", Note{"", {"proxy of object"}})
    .write(6ms, "binding", "proxy of location", Note{})
    .write(7ms, "binding", "union", Note{"", {"proxy of object", "proxy of location"}});
  EXPECT_EQ(story.changes(),
            (Changes{{"vision/object"},
                     {"binding/proxy of object", "binding/union", "spatial/location"},
                     {"binding/proxy of location", "binding/union"}}));
}

TEST(TimelineStages, WhatIsReferredToHereIsNoLaterStage) {
  Story story;
  story.write(1ms, "a", "1").write(2ms, "a", "2", Note{"", {"1"}}).write(3ms, "b", "3");
  EXPECT_THAT(story.changes(), SizeIs(1));
}

TEST(TimelineStages, WhatHasChangedBeforeAPauseIsNotReferredToAnew) {
  Story story;
  story.write(1ms, "a", "1").write(900ms, "b", "2", Note{"", {"1"}});
  EXPECT_EQ(story.changes(), (Changes{{"a/1"}, {"b/2"}}));
}

TEST(TimelineStages, OfTooManyThoseWithTheShortestPausesAreMerged) {
  StageOptions options;
  options.most = 2;
  Story story{options};
  story.write(0ms, "a", "1").write(400ms, "a", "2").write(2s, "a", "1").write(2500ms, "a", "3");
  EXPECT_EQ(story.changes(), (Changes{{"a/1", "a/2"}, {"a/1", "a/3"}}));
  EXPECT_TRUE(story.stages.list().front().changed.begin()->second.is_new);
}

TEST(TimelineStages, AnEntryThatCameAndWentIsNew) {
  Story story;
  story.write(1ms, "a", "1").remove(2ms, "a", "1");
  ASSERT_EQ(story.changes(), (Changes{{"-a/1"}}));
  EXPECT_TRUE(story.stages.list().front().changed.begin()->second.is_new);
}

TEST(TimelineStages, AnEntryThatWasReadTooLateIsShownUntilTheRightOneComes) {
  auto late = std::make_shared<Entry>();
  late->address = {"a", "1"};
  late->version = 2;
  late->value = Value::of(Note{"late", {}});
  auto event = Story::event_of(1ms, *late);
  event.version = 0;
  Stages stages;
  stages.add(event, late);
  auto text = [&] { return stages.list().front().changed.begin()->second.value.as<Note>()->text; };
  EXPECT_EQ(text(), "late");
  auto right = std::make_shared<Entry>(*late);
  right->version = 1;
  right->value = Value::of(Note{"right", {}});
  stages.add(Story::event_of(2ms, *right), right);
  EXPECT_EQ(text(), "right");
  event.version = 1;
  stages.add(event, late);
  EXPECT_EQ(text(), "right");
}

/// However stages are divided and merged, laid over each other they are what there is, and they are
/// in order.
RC_GTEST_PROP(TimelineStages, TogetherTheyAreWhatThereIs, ()) {
  StageOptions options;
  options.most = *rc::gen::inRange<std::size_t>(1, 5);
  Story story{options};
  std::map<Address, std::string> truth;
  Timestamp time{0};
  auto count = *rc::gen::inRange(0, 60);
  for (int i = 0; i < count; ++i) {
    time += *rc::gen::element<Timestamp>(1ms, 50ms, 300ms, 2s);
    Address at{*rc::gen::element<std::string>("a", "b", "c"),
               *rc::gen::element<std::string>("1", "2", "3", "4")};
    if (truth.count(at) > 0 && *rc::gen::inRange(0, 3) == 0) {
      story.remove(time, at.subarchitecture, at.id);
      truth.erase(at);
      continue;
    }
    auto text = std::to_string(i);
    auto about = *rc::gen::element<std::string>("", "1", "2", "3", "4");
    story.write(time, at.subarchitecture, at.id, Note{text, {about}});
    truth[at] = text;
  }
  RC_ASSERT(story.stages.list().size() <= options.most);
  std::map<Address, std::string> shown;
  std::set<Address> present;
  for (auto& stage : story.stages.list()) {
    RC_ASSERT(stage.begin <= stage.end);
    RC_ASSERT(!stage.changed.empty());
    for (auto& [address, x] : stage.changed) {
      RC_ASSERT(x.is_new == (present.count(address) == 0));
      if (x.is_gone) {
        present.erase(address);
        shown.erase(address);
      } else {
        present.insert(address);
        shown[address] = x.value.as<Note>()->text;
      }
    }
  }
  RC_ASSERT(shown == truth);
}

} // namespace

} // namespace castor::timeline::test
