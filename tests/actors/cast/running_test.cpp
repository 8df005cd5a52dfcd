#include "castor/actors/cast/running.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace castor::cast {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* running_system = "HOSTNAME eye 10.0.0.7\n"
                                       "SUBARCHITECTURE vision\n"
                                       "CPP WM SubarchitectureWorkingMemory\n"
                                       "CPP TM AlwaysPositiveTaskManager\n"
                                       "CPP MG segmentor Segmentor\n"
                                       "CPP UM tracker Tracker\n"
                                       "COMPONENT CPP camera Camera\n"
                                       "ACCESS arm WRITES *\n"
                                       "SUBARCHITECTURE arm\n"
                                       "CPP WM SubarchitectureWorkingMemory\n"
                                       "CPP TM AlwaysPositiveTaskManager\n";

ParseResult read_addition(const std::string& text) {
  auto options = test::options_for({});
  options.running_subarchitectures = {"vision", "arm"};
  return parse_string(text, "more.cast", options);
}

class RunningSystem : public testing::Test {
protected:
  RunningSystem() : running(test::parse(running_system).architecture.value()) {
    for_each_component(running, [&](auto& x) { next = std::max(next, x.number + 1); });
    before = names();
  }

  std::vector<Diagnostic> add(const std::string& text) {
    auto parsed = read_addition(text);
    EXPECT_TRUE(test::is_clean(parsed));
    return join(running, parsed.architecture.value(), next);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for_each_component(running, [&](auto& x) { result.push_back(x.name); });
    return result;
  }

  ArchitectureDescription running;
  std::size_t next = 0;
  std::vector<std::string> before;
};

TEST_F(RunningSystem, TakesComponentsForItsSubarchitectures) {
  EXPECT_THAT(add("SUBARCHITECTURE vision\nCPP MG recogniser Recogniser --deep\n"), IsEmpty());
  EXPECT_THAT(names(), ElementsAre("vision_wm", "vision_tm", "segmentor", "tracker", "recogniser",
                                   "arm_wm", "arm_tm", "camera"));
  EXPECT_EQ(running.component("recogniser")->number, before.size());
  EXPECT_NE(running.component("recogniser")->option("deep"), nullptr);
}

TEST_F(RunningSystem, TakesWholeSubarchitecturesStandaloneComponentsAndRules) {
  EXPECT_THAT(add("ACCESS speech WRITES vision\nSUBARCHITECTURE speech\n"
                  "CPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n"
                  "COMPONENT CPP microphone Microphone\n"),
              IsEmpty());
  EXPECT_NE(running.subarchitecture("speech"), nullptr);
  EXPECT_NE(running.component("microphone"), nullptr);
  EXPECT_TRUE(running.may_write("speech", "vision"));
  EXPECT_EQ(next, before.size() + 3);
}

TEST_F(RunningSystem, RefusesRulesAboutOperators) {
  auto parsed = read_addition("ACCESS operator WRITES vision\n");
  ASSERT_EQ(parsed.diagnostics.size(), 1U);
  EXPECT_THAT(parsed.diagnostics[0].message, HasSubstr("are fixed when the system is started"));
}

TEST_F(RunningSystem, OperatorsMayNotWriteMoreWhenASubarchitectureIsRemoved) {
  running.access_rules.push_back({"operator", "vision", {}});
  remove(running, "vision");
  EXPECT_FALSE(running.may_write("operator", "arm"));
}

TEST_F(RunningSystem, NumbersAreNeverUsedAgain) {
  add("SUBARCHITECTURE vision\nCPP MG recogniser Recogniser\n");
  auto first = running.component("recogniser")->number;
  remove(running, "recogniser");
  add("SUBARCHITECTURE vision\nCPP MG recogniser Recogniser\n");
  EXPECT_EQ(running.component("recogniser")->number, first + 1);
}

TEST_F(RunningSystem, RefusesNamesThatThereAre) {
  auto problems = add("SUBARCHITECTURE arm\nCPP MG other Other\nCPP MG tracker Other\n");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message, HasSubstr("there is a component tracker in the running system"));
  EXPECT_EQ(problems[0].where.line(), 3u);
  EXPECT_EQ(names(), before);
}

TEST_F(RunningSystem, RefusesAnotherWorkingMemory) {
  auto problems = add("SUBARCHITECTURE vision\nCPP WM SubarchitectureWorkingMemory\n"
                      "CPP TM AlwaysPositiveTaskManager\nCPP MG other Other\n");
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0].message, HasSubstr("vision runs and has its working memory"));
  EXPECT_THAT(problems[1].message, HasSubstr("vision runs and has its task manager"));
  EXPECT_EQ(names(), before);
}

TEST_F(RunningSystem, RefusesAnotherMeaningOfAHostsName) {
  auto problems = add("HOSTNAME eye 10.0.0.8\nCOMPONENT [eye] CPP microphone Microphone\n");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message, HasSubstr("eye is the host 10.0.0.7, here it is 10.0.0.8"));
}

TEST_F(RunningSystem, NewSubarchitecturesNeedAWorkingMemory) {
  EXPECT_TRUE(test::reports(read_addition("SUBARCHITECTURE speech\nCPP MG x X\n"), Severity::error,
                            1, "no working memory", {}, "more.cast"));
}

TEST_F(RunningSystem, RemovesAComponent) {
  auto removal = remove(running, "tracker");
  EXPECT_THAT(removal.problem, IsEmpty());
  EXPECT_THAT(removal.components, ElementsAre("tracker"));
  EXPECT_EQ(running.component("tracker"), nullptr);
  EXPECT_THAT(remove(running, "camera").components, ElementsAre("camera"));
}

TEST_F(RunningSystem, RemovesASubarchitectureInTheReverseOrderOfItsStart) {
  EXPECT_THAT(remove(running, "vision").components,
              ElementsAre("tracker", "segmentor", "vision_tm"));
  EXPECT_THAT(names(), ElementsAre("arm_wm", "arm_tm", "camera"));
  remove(running, "arm");
  EXPECT_THAT(running.access_rules, IsEmpty());
}

TEST_F(RunningSystem, SaysWhyItCannotRemove) {
  EXPECT_THAT(remove(running, "trakcer").problem, HasSubstr("did you mean 'tracker'"));
  EXPECT_THAT(remove(running, "vision_wm").problem, HasSubstr("remove vision as a whole"));
  EXPECT_EQ(names(), before);
}

} // namespace

} // namespace castor::cast
