#include "castor/tools/chaos/fault_plan.hpp"

#include "castor/tests/tools/chaos/support.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

#include <gmock/gmock.h>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;
using test::flaws_of;
using test::plan_of;
using testing::AllOf;
using testing::HasSubstr;

Fault fault_in(const std::string& text) {
  auto plan = plan_of("at 1s " + text);
  if (plan.statements.size() != 1 || plan.statements.front().faults.size() != 1) {
    ADD_FAILURE() << text;
    return Crash{};
  }
  return plan.statements.front().faults.front();
}

TEST(FaultPlan, FaultsOfComponents) {
  EXPECT_EQ(fault_in("crash segmentor"), (Fault{Crash{{"segmentor", {}}}}));
  EXPECT_EQ(fault_in("crash any component"), Fault{Crash{}});
  EXPECT_EQ(fault_in("crash any component of vision"), (Fault{Crash{{{}, "vision"}}}));
  EXPECT_EQ(fault_in("throw in tracker"), (Fault{Throw{{"tracker", {}}, 1}}));
  EXPECT_EQ(fault_in("throw in callback 3 of tracker"), (Fault{Throw{{"tracker", {}}, 3}}));
  EXPECT_EQ(fault_in("hang tracker"), (Fault{Hang{{"tracker", {}}, {}}}));
  EXPECT_EQ(fault_in("hang tracker for 3s"), (Fault{Hang{{"tracker", {}}, 3s}}));
  EXPECT_EQ(fault_in("slow tracker by 20ms for 3s"), (Fault{Slow{{"tracker", {}}, 20ms, 3s}}));
}

TEST(FaultPlan, FaultsOfProcesses) {
  EXPECT_EQ(fault_in("kill node1"), (Fault{Kill{{"node1"}}}));
  EXPECT_EQ(fault_in("kill any node"), Fault{Kill{}});
  EXPECT_EQ(fault_in("stop node1 for 2s"), (Fault{Stop{{"node1"}, 2s}}));
  EXPECT_EQ(fault_in("continue node1"), (Fault{Continue{{"node1"}}}));
}

TEST(FaultPlan, ShortagesAndFloodsOfProcesses) {
  EXPECT_EQ(fault_in("use up descriptors of coordinator for 1s"),
            (Fault{UseUpDescriptors{{"coordinator"}, 1s}}));
  EXPECT_EQ(fault_in("flood any node for 1s"), (Fault{Flood{{}, flood_rate, 1s}}));
  EXPECT_EQ(fault_in("flood with with 5/s"), (Fault{Flood{{"with"}, {5000}, {}}}));
}

TEST(FaultPlan, BlockedRestarts) {
  EXPECT_EQ(fault_in("block start of a for 1s"),
            (Fault{Block{{"a", {}}, Block::Phase::start, 1s}}));
  EXPECT_EQ(fault_in("block configure of any component of vision"),
            (Fault{Block{{{}, "vision"}, Block::Phase::configure, {}}}));
}

TEST(FaultPlan, FaultsOfLinks) {
  EXPECT_EQ(fault_in("partition node1"), (Fault{Partition{{"node1"}, {}, {}}}));
  EXPECT_EQ(fault_in("partition node1 from node2, coordinator for 2s"),
            (Fault{Partition{{"node1"}, {"node2", "coordinator"}, 2s}}));
  EXPECT_EQ(fault_in("delay 50ms between node1 and node2"),
            (Fault{Delay{50ms, {"node1", "node2"}, {}}}));
  EXPECT_EQ(fault_in("drop 10% on any link for 1s"), (Fault{Drop{{10'000}, {}, 1s}}));
  EXPECT_EQ(fault_in("duplicate 0.5% between node1 and node2"),
            (Fault{Duplicate{{500}, {"node1", "node2"}, {}}}));
  EXPECT_EQ(fault_in("reorder 100% on any link"), (Fault{Reorder{everything, {}, {}}}));
}

TEST(FaultPlan, FaultsOfWorkingMemories) {
  EXPECT_EQ(fault_in("fail journal of vision for 1s"), (Fault{FailJournal{{"vision"}, 1s}}));
  EXPECT_EQ(fault_in("slow journal of any by 20ms"), (Fault{SlowJournal{{}, 20ms, {}}}));
  EXPECT_EQ(fault_in("remove journal of vision"), (Fault{RemoveJournal{{"vision"}}}));
  EXPECT_EQ(fault_in("claim journal of any"), (Fault{ClaimJournal{}}));
  EXPECT_EQ(fault_in("jump clock of vision by 5s"), (Fault{JumpClock{{"vision"}, 5s}}));
  EXPECT_EQ(fault_in("jump clock of vision by -5s"), (Fault{JumpClock{{"vision"}, -5s}}));
}

TEST(FaultPlan, HappensAtTimesAndRatesAndAfterChanges) {
  auto plan = plan_of("# comment\n"
                      "seed 42   # the answer\n"
                      "\n"
                      "at 2s crash a # comment, with a comma: and \"quotes\n"
                      "every 1500ms crash a\n"
                      "rate 0.5/s crash a\n"
                      "after overwritten SceneObject in vision: hang a for 3s\n"
                      "after 3 where label == \"a: b # c\" && x > 1: crash a\n"
                      "after every 2 added A: crash a\n");
  EXPECT_EQ(plan.seed, 42U);
  ASSERT_EQ(plan.statements.size(), 6U);
  EXPECT_EQ(plan.statements[0].trigger, Trigger{At{2s}});
  EXPECT_EQ(plan.statements[1].trigger, Trigger{Every{1500ms}});
  EXPECT_EQ(plan.statements[2].trigger, Trigger{AtRandom{{500}}});
  EXPECT_EQ(plan.statements[3].trigger,
            (Trigger{After{parse_change_filter("overwritten SceneObject in vision"), 1, false}}));
  EXPECT_EQ(
    plan.statements[4].trigger,
    (Trigger{After{parse_change_filter("where label == \"a: b # c\" && x > 1"), 3, false}}));
  EXPECT_EQ(plan.statements[5].trigger, (Trigger{After{parse_change_filter("added A"), 2, true}}));
  EXPECT_EQ(to_string(plan.statements[1].where), "test.plan:5");
}

TEST(FaultPlan, OneOfSeveralFaults) {
  auto plan = plan_of("every 1s crash any component or hang a for 1s or kill any node");
  ASSERT_EQ(plan.statements.size(), 1U);
  EXPECT_EQ(plan.statements[0].faults, (std::vector<Fault>{Crash{}, Hang{{"a", {}}, 1s}, Kill{}}));
}

TEST(FaultPlan, OnlyWordsThatJoinAreNoNames) {
  EXPECT_EQ(fault_in("crash clock"), (Fault{Crash{{"clock", {}}}}));
  EXPECT_EQ(fault_in("slow journal by 1s"), (Fault{Slow{{"journal", {}}, 1s, {}}}));
  EXPECT_EQ(fault_in("throw in callback"), (Fault{Throw{{"callback", {}}, 1}}));
  EXPECT_EQ(fault_in("throw in callback 2 of callback"), (Fault{Throw{{"callback", {}}, 2}}));
  EXPECT_EQ(fault_in("partition node, link from component"),
            (Fault{Partition{{"node", "link"}, {"component"}, {}}}));
}

TEST(FaultPlan, NamesInQuotesAreNames) {
  EXPECT_EQ(fault_in("crash \"any\""), (Fault{Crash{{"any", {}}}}));
  EXPECT_EQ(fault_in(R"(crash "a \"b\" \\ # c")"), (Fault{Crash{{R"(a "b" \ # c)", {}}}}));
}

TEST(FaultPlan, FaultsNameTheirTargets) {
  EXPECT_EQ(target_of(fault_in("hang tracker for 1s")), "tracker");
  EXPECT_EQ(target_of(fault_in("crash any component of vision")), "any component of vision");
  EXPECT_EQ(target_of(fault_in("kill any node")), "any node");
  EXPECT_EQ(target_of(fault_in("partition node2, node1 from coordinator")), "node2, node1");
  EXPECT_EQ(target_of(fault_in("drop 1% between node2 and node1")), "node1 and node2");
  EXPECT_EQ(target_of(fault_in("delay 1s on any link")), "any link");
  EXPECT_EQ(target_of(fault_in("fail journal of vision")), "vision");
  EXPECT_EQ(target_of(fault_in("jump clock of any by 1s")), "any subarchitecture");
  EXPECT_EQ(duration_of(fault_in("hang tracker for 1s")), 1s);
  EXPECT_EQ(duration_of(fault_in("crash tracker")), std::nullopt);
}

TEST(FaultPlan, IncludesOthers) {
  auto plan = plan_of("at 1s crash a\nINCLUDE more.plan\n");
  ASSERT_EQ(plan.statements.size(), 2U);
  EXPECT_EQ(to_string(plan.statements[1].where), "more.plan:1");
  EXPECT_THAT(flaws_of("INCLUDE none.plan"), HasSubstr("no such file"));
}

TEST(FaultPlan, EveryErrorSaysWhereAndWhatToWrite) {
  EXPECT_THAT(flaws_of("at 1s crahs a"),
              AllOf(HasSubstr("test.plan:1: error: 'crahs' is not a fault"),
                    HasSubstr("did you mean 'crash'?")));
  EXPECT_THAT(flaws_of("at 1s explode a"), HasSubstr("write one of block, claim, continue"));
  EXPECT_THAT(flaws_of("\nevry 1s crash a"),
              AllOf(HasSubstr("test.plan:2"), HasSubstr("did you mean 'every'?")));
  EXPECT_THAT(flaws_of("at soon crash a"), HasSubstr("'soon' is not a time"));
  EXPECT_THAT(flaws_of("at 1s"), HasSubstr("the fault is missing"));
  EXPECT_THAT(flaws_of("at 1s for 2s hang a"), HasSubstr("stands at its end"));
  EXPECT_THAT(flaws_of("at 1s crash"), HasSubstr("the name of the component is missing"));
  EXPECT_THAT(flaws_of("at 1s crash a for 2s"), HasSubstr("not a fault that lasts"));
  EXPECT_THAT(flaws_of("at 1s hang a for 0s"), HasSubstr("not a time above zero"));
  EXPECT_THAT(flaws_of("at 1s hang a 2s"), HasSubstr("do not know what to do with '2s'"));
  EXPECT_THAT(flaws_of("at 1s crash or"), HasSubstr("write \"or\" with the quotes"));
  EXPECT_THAT(flaws_of("at 1s crash a or"), HasSubstr("the fault is missing"));
  EXPECT_THAT(flaws_of("at 1s crash a;b"), HasSubstr("is not a name"));
  EXPECT_THAT(flaws_of("at 1s crash \"a"), HasSubstr("a quote has no end"));
  EXPECT_THAT(flaws_of("at 1s throw in callback 0 of a"), HasSubstr("not the number"));
  EXPECT_THAT(flaws_of("at 1s throw in callback of a"), HasSubstr("not the number"));
  EXPECT_THAT(flaws_of("at 1s drop 110% on any link"), HasSubstr("up to 100%"));
  EXPECT_THAT(flaws_of("at 1s drop 10% from a"), HasSubstr("write between NODE and NODE"));
  EXPECT_THAT(flaws_of("at 1s partition a, from b"), HasSubstr("the name of the node is missing"));
  EXPECT_THAT(flaws_of("rate 5 crash a"), HasSubstr("write a rate such as 0.5/s"));
  EXPECT_THAT(flaws_of("every 0s crash a"), HasSubstr("at least 1ms"));
  EXPECT_THAT(flaws_of("after added A crash a"), HasSubstr("the change filter has no end"));
  EXPECT_THAT(flaws_of("after added A B: crash a"), HasSubstr("do not know what to do with"));
  EXPECT_THAT(flaws_of("after every added A: crash a"), HasSubstr("every how many changes"));
  EXPECT_THAT(flaws_of("after 0 added A: crash a"), HasSubstr("not a number of changes"));
  EXPECT_THAT(flaws_of("seed many"), HasSubstr("write seed 42"));
  EXPECT_THAT(flaws_of("seed 1\nseed 2"), HasSubstr("test.plan:2: error: the seed is given twice"));
}

TEST(FaultPlan, ErrorsInFaultsOfSeveralWordsSayHowTheyAreWritten) {
  EXPECT_THAT(flaws_of("at 1s block a"), HasSubstr("write block start of COMPONENT"));
  EXPECT_THAT(flaws_of("at 1s block start a"), HasSubstr("write block start of COMPONENT"));
  EXPECT_THAT(flaws_of("at 1s use descriptors of a"), HasSubstr("write use up descriptors of"));
  EXPECT_THAT(flaws_of("at 1s flood a with 5"),
              AllOf(HasSubstr("'5' is not a rate"), HasSubstr("0.5/s")));
  EXPECT_THAT(flaws_of("at 1s flood a with"), HasSubstr("the rate is missing"));
  EXPECT_THAT(flaws_of("at 1s claim vision"), HasSubstr("write journal of SUBARCHITECTURE"));
  EXPECT_THAT(flaws_of("at 1s remove journal of vision for 1s"),
              HasSubstr("this is not a fault that lasts"));
}

TEST(FaultPlan, AllErrorsAreFound) {
  auto flaws = flaws_of("at 1s crahs a\nat 1s crash a\nat x crash a\n");
  EXPECT_THAT(flaws, AllOf(HasSubstr("test.plan:1"), HasSubstr("test.plan:3")));
  EXPECT_EQ(flaws.find("test.plan:2"), std::string::npos);
}

} // namespace

} // namespace castor::faults
