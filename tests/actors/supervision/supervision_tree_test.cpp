#include "castor/actors/supervision/supervision_tree.hpp"

#include "castor/actors/cast/parser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = SupervisionDecision::Kind;

/// A subarchitecture a with a managed and two unmanaged components, a subarchitecture b, and a
/// stand-alone component.
constexpr const char* system = R"(
SUBARCHITECTURE a
CPP WM W
CPP TM T
CPP UM first C
CPP MG worker C
CPP UM second C %(options)
SUBARCHITECTURE b
CPP WM W
CPP TM T
CPP UM other C
COMPONENT CPP camera C
)";

SupervisionTree tree(const std::string& rules = {}, const std::string& options = {}) {
  auto text = std::string{system} + rules;
  text.replace(text.find("%(options)"), 10, options);
  auto parsed = cast::parse_string(text, "test.cast");
  if (!parsed.architecture)
    throw std::runtime_error(render(parsed.diagnostics));
  SupervisionTree result;
  result.set(*parsed.architecture);
  return result;
}

TEST(SupervisionTree, StartsInOrder) {
  EXPECT_THAT(tree().order(), ElementsAre("camera", "a_wm", "a_tm", "worker", "first", "second",
                                          "b_wm", "b_tm", "other"));
}

TEST(SupervisionTree, WhoFailsBecauseAnotherIsDownIsRestartedWithoutALimit) {
  auto x = tree("SUPERVISE a RESTARTS 1 IN 10s DELAY 100ms TO 400ms\n");
  EXPECT_EQ(x.failed_without("first", 1s).delay, 0s);
  Timestamp last{0};
  for (int i = 0; i < 20; ++i) {
    auto decision = x.failed_without("first", 2s);
    EXPECT_EQ(decision.kind, Kind::restart);
    EXPECT_THAT(decision.start, ElementsAre("first"));
    EXPECT_GE(decision.delay, 75ms);
    last = decision.delay;
  }
  EXPECT_GE(last, 300ms);
  // Its own failures count as before.
  EXPECT_EQ(x.failed("first", 3s).escalated, "");
  EXPECT_EQ(x.failed("first", 3s).escalated, "a");
}

TEST(SupervisionTree, WhoIsNeverRestartedStaysDownWhateverItWaitedFor) {
  EXPECT_EQ(tree({}, "--restart temporary").failed_without("second", 1s).kind, Kind::leave);
}

TEST(SupervisionTree, RestartsWhoHasFailedAtOnce) {
  auto decision = tree().failed("first", 1s);
  EXPECT_EQ(decision.kind, Kind::restart);
  EXPECT_EQ(decision.delay, 0s);
  EXPECT_THAT(decision.stop, ElementsAre("first"));
  EXPECT_THAT(decision.start, ElementsAre("first"));
}

TEST(SupervisionTree, RestartsAllForOne) {
  auto decision = tree("SUPERVISE a one_for_all").failed("first", 1s);
  EXPECT_THAT(decision.start, ElementsAre("a_wm", "a_tm", "worker", "first", "second"));
}

TEST(SupervisionTree, RestartsTheRestForOne) {
  auto decision = tree("SUPERVISE a rest_for_one").failed("first", 1s);
  EXPECT_THAT(decision.start, ElementsAre("first", "second"));
}

TEST(SupervisionTree, TakesAllThatDependsOnAWorkingMemory) {
  auto x = tree();
  EXPECT_THAT(x.failed("a_wm", 1s).start, ElementsAre("a_wm", "a_tm", "worker", "first", "second"));
  EXPECT_THAT(x.failed("a_tm", 2s).start, ElementsAre("a_tm", "worker"));
}

TEST(SupervisionTree, LeavesTemporaryOnesDown) {
  auto x = tree("SUPERVISE a one_for_all", "--restart temporary");
  EXPECT_EQ(x.failed("second", 1s).kind, Kind::leave);
  auto decision = x.failed("first", 1s);
  EXPECT_THAT(decision.stop, ElementsAre("a_wm", "a_tm", "worker", "first", "second"));
  EXPECT_THAT(decision.start, ElementsAre("a_wm", "a_tm", "worker", "first"));
}

TEST(SupervisionTree, KnowsWhoseEndIsAFailure) {
  EXPECT_EQ(tree().ended("second", 1s).kind, Kind::restart);
  EXPECT_EQ(tree({}, "--restart transient").ended("second", 1s).kind, Kind::leave);
  EXPECT_EQ(tree({}, "--restart transient").failed("second", 1s).kind, Kind::restart);
  EXPECT_EQ(tree({}, "--restart temporary").ended("second", 1s).kind, Kind::leave);
}

TEST(SupervisionTree, WaitsLongerEachTime) {
  auto x = tree("SUPERVISE a RESTARTS 10 IN 10s DELAY 100ms TO 300ms");
  EXPECT_EQ(x.failed("first", 1s).delay, 0s);
  auto expect_about = [](Timestamp delay, Timestamp most) {
    EXPECT_LE(delay, most);
    EXPECT_GE(delay, most * 3 / 4);
  };
  expect_about(x.failed("first", 2s).delay, 100ms);
  expect_about(x.failed("first", 3s).delay, 200ms);
  expect_about(x.failed("first", 4s).delay, 300ms);
  expect_about(x.failed("first", 5s).delay, 300ms);
  EXPECT_EQ(x.failed("second", 6s).delay, 0s);
  EXPECT_EQ(x.failed("first", 20s).delay, 0s);
}

TEST(SupervisionTree, EscalatesWhatFailsTooOften) {
  auto x = tree();
  for (auto time : {1s, 2s, 3s})
    EXPECT_THAT(x.failed("first", time).escalated, IsEmpty());
  auto decision = x.failed("second", 4s);
  EXPECT_EQ(decision.kind, Kind::restart);
  EXPECT_EQ(decision.escalated, "a");
  EXPECT_THAT(decision.start, ElementsAre("a_wm", "a_tm", "worker", "first", "second"));
  EXPECT_THAT(decision.reason,
              HasSubstr("second has failed, and 3 restarts in 10s were allowed in a"));
  // It begins anew.
  EXPECT_THAT(x.failed("first", 5s).escalated, IsEmpty());
}

TEST(SupervisionTree, ForgetsFailuresOfThePast) {
  auto x = tree();
  for (int i = 0; i < 50; ++i)
    EXPECT_THAT(x.failed("first", i * 4s).escalated, IsEmpty()) << i;
}

TEST(SupervisionTree, GivesUpAtTheTop) {
  auto x = tree("SUPERVISE a RESTARTS 0 IN 10s\nSUPERVISE SYSTEM RESTARTS 2 IN 1min");
  EXPECT_EQ(x.failed("first", 1s).escalated, "a");
  EXPECT_EQ(x.failed("first", 2s).escalated, "a");
  auto decision = x.failed("first", 3s);
  EXPECT_EQ(decision.kind, Kind::give_up);
  EXPECT_THAT(decision.reason, HasSubstr("a has failed as a whole, and 2 restarts in 60s were "
                                         "allowed in the system"));
}

TEST(SupervisionTree, TakesOtherSubarchitecturesWhereItIsToldTo) {
  auto x = tree("SUPERVISE a RESTARTS 0 IN 10s\nSUPERVISE SYSTEM rest_for_one");
  EXPECT_THAT(x.failed("first", 1s).start,
              ElementsAre("a_wm", "a_tm", "worker", "first", "second", "b_wm", "b_tm", "other"));
}

TEST(SupervisionTree, SupervisesStandaloneComponentsAtTheTop) {
  auto x = tree("SUPERVISE SYSTEM RESTARTS 1 IN 10s");
  EXPECT_THAT(x.failed("camera", 1s).start, ElementsAre("camera"));
  EXPECT_EQ(x.failed("camera", 2s).kind, Kind::give_up);
}

TEST(SupervisionTree, KeepsThePastOfThoseThatStay) {
  auto x = tree("SUPERVISE a RESTARTS 1 IN 10s");
  x.failed("first", 1s);
  auto parsed = cast::parse_string(std::string{"SUBARCHITECTURE a\nCPP WM W\nCPP TM T\nCPP UM "
                                               "first C\nSUPERVISE a RESTARTS 1 IN 10s\n"},
                                   "test.cast");
  x.set(*parsed.architecture);
  EXPECT_EQ(x.failed("first", 2s).escalated, "a");
}

} // namespace

} // namespace castor::test
