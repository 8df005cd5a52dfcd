#include "castor/actors/cast/supervision_rules.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace castor::cast {

namespace {

using namespace std::chrono_literals;
using test::is_clean;
using test::parse;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string systems = "HOSTNAME Far 10.0.0.9\nHOST h\n"
                            "SUBARCHITECTURE vision\nCPP WM W\nCPP TM T\nCPP UM tracker C\n"
                            "SUBARCHITECTURE binding\nCPP WM W\nCPP TM T\n";

TEST(SupervisionRules, SayHowToDealWithFailures) {
  auto result = parse(systems + "SUPERVISE vision rest_for_one RESTARTS 5 IN 1min "
                                "DELAY 50ms TO 2s # as it is slow\n");
  ASSERT_TRUE(is_clean(result));
  SupervisionPolicy expected{RestartStrategy::rest_for_one, 5, 60s, 50ms, 2s};
  EXPECT_EQ(result.architecture->supervision_of("vision"), expected);
  EXPECT_EQ(result.architecture->supervision_of("binding"), SupervisionPolicy{});
}

TEST(SupervisionRules, MayBeForAllOthers) {
  auto result = parse(systems + "SUPERVISE * one_for_all\nSUPERVISE binding RESTARTS 0 IN 10s\n"
                                "SUPERVISE SYSTEM RESTARTS 7 IN 10s\n");
  ASSERT_TRUE(is_clean(result));
  auto& x = *result.architecture;
  EXPECT_EQ(x.supervision_of("vision").strategy, RestartStrategy::one_for_all);
  EXPECT_EQ(x.supervision_of("binding").strategy, RestartStrategy::one_for_one);
  EXPECT_EQ(x.supervision_of("SYSTEM").restarts, 7U);
  EXPECT_EQ(
    parse(systems + "SUPERVISE * one_for_all\n").architecture->supervision_of("SYSTEM").strategy,
    RestartStrategy::one_for_one);
}

TEST(SupervisionRules, SayWhatIsWrong) {
  for (auto [line, message] : {
         std::pair{"SUPERVISE", "SUPERVISE without a name"},
         {"SUPERVISE vison", "no subarchitecture 'vison'"},
         {"SUPERVISE vision one_for_al", "did you mean 'one_for_all'"},
         {"SUPERVISE vision RESTARTS many IN 10s", "whole number"},
         {"SUPERVISE vision RESTARTS 3", "followed by IN"},
         {"SUPERVISE vision RESTARTS 3 IN 10", "duration"},
         {"SUPERVISE vision RESTARTS 3 IN 0s", "duration"},
         {"SUPERVISE vision DELAY 1s", "followed by TO"},
         {"SUPERVISE vision DELAY 1s TO 10ms", "no shorter"},
         {"SUPERVISE vision\nSUPERVISE vision", "already"},
         {"FAILOVER vision", "this FAILOVER line is incomplete"},
         {"FAILOVER vision TO", "this FAILOVER line is incomplete"},
         {"FAILOVER trackr TO h", "neither a subarchitecture nor a component 'trackr'"},
       })
    EXPECT_THAT(render(parse(systems + line + '\n').diagnostics), HasSubstr(message)) << line;
}

TEST(SupervisionRules, SayWhereThingsMove) {
  auto result = parse(systems + "FAILOVER vision TO h2 [Far]\nFAILOVER tracker TO h3\n");
  ASSERT_TRUE(is_clean(result));
  auto& x = *result.architecture;
  EXPECT_THAT(x.failover_of(*x.component("vision_wm")), ElementsAre("h2", "10.0.0.9"));
  EXPECT_THAT(x.failover_of(*x.component("tracker")), ElementsAre("h3"));
  EXPECT_THAT(x.failover_of(*x.component("binding_wm")), IsEmpty());
}

TEST(SupervisionRules, LeaveHostsOfTheSameNameAlone) {
  EXPECT_TRUE(is_clean(parse("SUBARCHITECTURE a h\nCPP WM W\nCPP TM T\nSUPERVISE CPP UM x C\n")));
}

} // namespace

} // namespace castor::cast
