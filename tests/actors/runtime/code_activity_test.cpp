#include "castor/actors/runtime/code_activity.hpp"

#include "castor/tests/wm/values/test_types.hpp"
#include "castor/wm/values/value.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

namespace castor::test {

namespace {

std::unique_ptr<ChangeEvent> box_event(std::string id, Version version) {
  auto result = std::make_unique<ChangeEvent>();
  result->address = {"vision", std::move(id)};
  result->source = "segmentor";
  result->type = descriptor_of<Box>();
  result->version = version;
  return result;
}

TEST(CurrentActivity, IsNothingAtFirst) {
  CurrentActivity activity;
  EXPECT_EQ(activity.text(), "");
}

TEST(CurrentActivity, IsThatOfTheInnermostCodeThatRuns) {
  CurrentActivity activity;
  const auto event = box_event("0:3", 2);
  const CodeActivity run{"run()"}, callback{"the callback for ", event.get()};
  {
    ActivityScope outer{activity, run};
    {
      ActivityScope inner{activity, callback};
      EXPECT_EQ(activity.text(), "the callback for ADD Box vision/0:3 v2 by segmentor");
      inner.leave();
    }
    EXPECT_EQ(activity.text(), "run()");
    outer.leave();
  }
  EXPECT_EQ(activity.text(), "");
}

/// Throws out of `run` and a callback for an event, which has ended when it returns.
void fail_in_callback(CurrentActivity& activity, const std::string& id) {
  const CodeActivity run{"run()"};
  try {
    ActivityScope outer{activity, run};
    const auto event = box_event(id, 1);
    const CodeActivity callback{"the callback for ", event.get()};
    ActivityScope inner{activity, callback};
    throw std::runtime_error("oops");
  } catch (const std::runtime_error&) {
    // It is the activity that is of interest.
  }
}

TEST(CurrentActivity, AfterAnExceptionIsThatOfTheCodeThatHasThrownThoughItsEventHasEnded) {
  CurrentActivity activity;
  for (auto* id : {"a-name-that-is-long-enough-not-to-fit-into-a-string-itself", "0:3"}) {
    fail_in_callback(activity, id);
    EXPECT_EQ(activity.text(),
              "the callback for ADD Box vision/" + std::string{id} + " v1 by segmentor");
    EXPECT_EQ(to_string(activity.own()), activity.text());
  }
}

TEST(CurrentActivity, IsTheOutersAgainAfterAnExceptionThatWasCaught) {
  CurrentActivity activity;
  const CodeActivity start{"start()"}, run{"run()"};
  activity.set(start);
  {
    ActivityScope outer{activity, run};
    fail_in_callback(activity, "0:3");
    EXPECT_THAT(activity.text(), testing::StartsWith("the callback for "));
    outer.leave();
  }
  EXPECT_EQ(activity.text(), "start()");
}

TEST(CurrentActivity, OthersReadWholeTextsOfEventsThatHaveNotEnded) {
  const CodeActivity idle;
  CurrentActivity activity;
  std::atomic<bool> is_over{false};
  std::atomic<int> texts{0};
  auto read = [&] {
    while (!is_over) {
      const auto text = activity.text();
      if (!text.empty()) {
        EXPECT_THAT(text,
                    testing::AnyOf("run()", "the callback for ADD Box vision/0:3 v7 by segmentor",
                                   "the callback for ADD Box vision/0:4 v7 by segmentor",
                                   "the callback for ADD Box vision/kept v1 by segmentor"));
        ++texts;
      }
    }
  };
  std::thread first{read}, second{read};
  for (int i = 0; i < 10'000 || texts < 100; ++i) {
    if (i % 100 == 0) {
      fail_in_callback(activity, "kept");
      activity.set(idle);
    }
    auto event = box_event(i % 2 ? "0:3" : "0:4", 7);
    const CodeActivity callback{"the callback for ", event.get()};
    ActivityScope scope{activity, callback};
    scope.leave();
  }
  is_over = true;
  first.join();
  second.join();
}

} // namespace

} // namespace castor::test
