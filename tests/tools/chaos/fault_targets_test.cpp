#include "castor/tools/chaos/fault_targets.hpp"

#include "castor/tests/tools/chaos/support.hpp"

#include <gmock/gmock.h>

namespace castor::faults {

namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string flaws_in(std::string_view plan, const FaultTargets& targets = test::table_top()) {
  return render(check_plan(test::plan_of(plan), targets));
}

TEST(FaultTargets, APlanThatFitsHasNoFlaws) {
  EXPECT_EQ(flaws_in("at 1s crash segmentor\n"
                     "at 1s crash vision_wm or crash any component of binding\n"
                     "after added A in vision from tracker: hang camera for 1s\n"
                     "at 1s use up descriptors of coordinator or use up descriptors of tracker\n"
                     "at 1s flood tracker or flood any node with 5/s for 1s\n"
                     "at 1s block start of camera or block configure of vision_tm for 1s\n"
                     "at 1s kill tracker or kill node1 or stop any node for 1s\n"
                     "at 1s partition node1, coordinator from node2\n"
                     "at 1s drop 10% between coordinator and node1\n"
                     "at 1s delay 1ms on any link\n"
                     "at 1s fail journal of vision or slow journal of any by 1ms\n"
                     "at 1s remove journal of vision or claim journal of any\n"
                     "at 1s jump clock of binding by 1s\n"),
            "");
}

TEST(FaultTargets, NamesOfNothingAreFound) {
  EXPECT_THAT(flaws_in("\nat 1s crash segmentr"),
              AllOf(HasSubstr("test.plan:2: error: there is no component 'segmentr'"),
                    HasSubstr("did you mean 'segmentor'?")));
  EXPECT_THAT(flaws_in("at 1s crash any component of vison"), HasSubstr("did you mean 'vision'?"));
  EXPECT_THAT(flaws_in("at 1s kill node3"), HasSubstr("did you mean 'node1'?"));
  EXPECT_THAT(flaws_in("at 1s kill everything"), HasSubstr("there are: node1, node2, tracker"));
  EXPECT_THAT(flaws_in("at 1s partition node1 from segmentor"),
              HasSubstr("there is no node 'segmentor'"));
  EXPECT_THAT(flaws_in("at 1s drop 1% between node1 and nodes"), HasSubstr("no node 'nodes'"));
  EXPECT_THAT(flaws_in("at 1s jump clock of vision_wm by 1s"),
              HasSubstr("there is no subarchitecture 'vision_wm'"));
  EXPECT_THAT(flaws_in("after added A in vison: crash tracker"), HasSubstr("'vision'"));
  EXPECT_THAT(flaws_in("after added A from trakcer: crash tracker"), HasSubstr("'tracker'"));
  EXPECT_THAT(flaws_in("at 1s crash tracker or crash trakcer"), HasSubstr("'tracker'"));
}

TEST(FaultTargets, FaultsThatCannotBeInjectedIntoThemAreFound) {
  EXPECT_THAT(flaws_in("at 1s kill segmentor"),
              AllOf(HasSubstr("has no process of its own"), HasSubstr("write crash segmentor")));
  EXPECT_THAT(flaws_in("at 1s block start of vision_wm"), HasSubstr("has no start()"));
  EXPECT_THAT(flaws_in("at 1s use up descriptors of segmentor"),
              HasSubstr("has no process of its own"));
  EXPECT_THAT(flaws_in("at 1s flood coordinator"), HasSubstr("takes no connections"));
  EXPECT_THAT(flaws_in("at 1s stop coordinator"), HasSubstr("brings the faults about"));
  EXPECT_THAT(flaws_in("at 1s partition node1 from node1"), HasSubstr("cut off from itself"));
  EXPECT_THAT(flaws_in("at 1s drop 1% between node1 and node1"), HasSubstr("no link with itself"));
  for (auto fault : {"fail", "slow", "remove", "claim"})
    EXPECT_THAT(flaws_in("at 1s " + std::string{fault} + " journal of binding" +
                         (fault == std::string{"slow"} ? " by 1ms" : "")),
                HasSubstr("has no journal"));
}

TEST(FaultTargets, WhatCannotBeDrawnIsFound) {
  auto& targets = test::small_system();
  EXPECT_THAT(flaws_in("at 1s kill any node", targets), HasSubstr("no node besides"));
  EXPECT_THAT(flaws_in("at 1s drop 1% on any link", targets), HasSubstr("has no links"));
  EXPECT_THAT(flaws_in("at 1s fail journal of any", targets),
              HasSubstr("no working memory has a journal"));
  EXPECT_EQ(flaws_in("at 1s crash any component of only or jump clock of any by 1s", targets), "");
  FaultTargets nothing;
  EXPECT_THAT(flaws_in("at 1s crash any component", nothing), HasSubstr("no component to choose"));
  EXPECT_THAT(flaws_in("at 1s jump clock of any by 1s", nothing), HasSubstr("no working memory"));
}

} // namespace

} // namespace castor::faults
