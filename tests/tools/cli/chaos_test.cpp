#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <sstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// Short runs under fault plans.
class Chaos : public Castor {
protected:
  std::vector<std::string> arguments(const std::string& system, const std::string& plan,
                                     const std::string& duration = "1s",
                                     const std::vector<std::string>& more = {}) const {
    std::vector<std::string> result{
      "chaos",    system,  "--plan",   write("system.plan", plan), "--duration", duration,
      "--settle", "300ms", "--report", report().string()};
    result.insert(result.end(), more.begin(), more.end());
    return result;
  }

  std::filesystem::path report() const { return folder / "report"; }
  json report_as_json() const { return json::parse(read(report() / "chaos.json")); }

  static std::vector<std::string> values(const json& list, const std::string& name) {
    std::vector<std::string> result;
    for (auto& x : list)
      result.push_back(x.at(name));
    return result;
  }

  /// The command that a report gives for making the same faults again.
  static std::vector<std::string> command_for_again(const std::string& text) {
    std::vector<std::string> result;
    std::istringstream words{text.substr(text.find("again: castor ") + 7)};
    std::string line;
    std::getline(words, line);
    std::istringstream in{line};
    for (std::string word; in >> word;)
      result.push_back(word);
    result.front() = CASTOR_EXECUTABLE;
    return result;
  }
};

TEST_F(Chaos, ItsResultIsOneObjectForScripts) {
  auto answer =
    ask(arguments(system("CPP UM clock Clock\n"), "at 100ms crash clock\n", "300ms", {"--json"}));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  auto lines = json_lines(answer.output);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], report_as_json());
}

TEST_F(Chaos, ASystemThatHoldsIsReportedWithEverythingThatBefellIt) {
  auto answer = ask(arguments(system("CPP UM clock Clock\nCPP UM listener Listener --count 1000\n"),
                              "at 200ms crash clock\n"
                              "after overwritten Tick in a where number == 3: crash listener\n"
                              "after Tick where number == 4: crash a_tm\n"
                              "at 400ms jump clock of a by 1s\n"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output,
              AllOf(HasSubstr("system.cast: held"), HasSubstr("3 of 3 faults happened"),
                    HasSubstr("outages: 2 back, 0 given up, 0 neither")));
  auto result = report_as_json();
  EXPECT_EQ(result["held"], true);
  auto page = read(report() / "chaos.html");
  for (auto fault : {"crash clock", "crash listener", "jump clock of a by 1s"}) {
    EXPECT_THAT(answer.errors, HasSubstr(std::string{"[faults] happened: "} + fault));
    EXPECT_THAT(values(result["faults"], "fault"), Contains(fault));
    EXPECT_THAT(page, HasSubstr(fault));
  }
  for (auto who : {"clock", "listener"}) {
    EXPECT_THAT(answer.errors, ContainsRegex("\\[" + std::string{who} + "\\] is back after"));
    EXPECT_THAT(values(result["outages"], "target"), Contains(who));
  }
  for (auto& x : result["faults"])
    EXPECT_EQ(x["state"], "happened") << x;
  // Everybody's operations were written down, and every change was told.
  EXPECT_THAT(answer.output,
              ContainsRegex("ok +operations on a +[0-9]+ operations on [2-9] entries"));
  EXPECT_THAT(answer.output, ContainsRegex("ok +changes in a +[0-9]+ changes"));
}

TEST_F(Chaos, AFaultWhoseOccasionDoesNotComeIsNotSaidToHaveHappened) {
  auto answer = ask(arguments(system("CPP UM clock Clock\nCPP UM listener Listener --count 1000\n"),
                              "at 100ms throw in callback 1000 of listener\n"
                              "at 200ms slow clock by 1ms for 100ms\n"
                              "at 300ms crash clock\n"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("1 of 3 faults happened, 2 never triggered"));
  EXPECT_THAT(answer.errors,
              AllOf(HasSubstr("armed: throw in callback 1000 of listener"),
                    HasSubstr("never triggered: slow clock by 1ms for 100ms: its component had no "
                              "such callback")));
  auto faults = report_as_json()["faults"];
  EXPECT_THAT(values(faults, "state"),
              testing::ElementsAre("never triggered", "never triggered", "happened"));
  EXPECT_EQ(faults[0]["happened_us"], nullptr);
  EXPECT_GE(faults[2]["happened_us"], faults[2]["at_us"]);
}

TEST_F(Chaos, ARunInWhichNothingGoesDownIsVacuous) {
  auto answer =
    ask(arguments(system("CPP UM clock Clock\n"), "at 100ms jump clock of a by 1s\n", "500ms"));
  EXPECT_EQ(answer.status, 4) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("system.cast: vacuous, nothing went down (0 outages;"));
  EXPECT_EQ(report_as_json()["vacuous"], "nothing went down");
}

TEST_F(Chaos, ARunInWhichNothingGoesOnIsVacuous) {
  auto answer = ask(arguments(system("CPP UM clock Clock\n"), "at 1s crash clock\n", "12s"));
  EXPECT_EQ(answer.status, 4) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("system.cast: vacuous, idle in 12 of 12"));
}

TEST_F(Chaos, WithoutAPlanFaultsKeepWithinTheRestartsThatSupervisorsAllow) {
  auto file = write("strict.cast", "SUPERVISE a RESTARTS 1 IN 1min\n" +
                                     read(system("CPP UM clock Clock\n"
                                                 "CPP UM listener Listener --count 1000\n")));
  auto answer = ask({"chaos", file, "--duration", "6s", "--seeds", "1..2", "--settle", "300ms",
                     "--report", report().string()});
  // A run that happens to hit nobody is vacuous.
  EXPECT_NE(answer.status, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, AllOf(ContainsRegex("strict.cast: .*seed 1,"),
                                   ContainsRegex("strict.cast: .*seed 2,"),
                                   ContainsRegex("[0-9]+ of 12 pairs of a fault and a target"),
                                   ContainsRegex("  listener +[0-9.]")));
  for (auto seed : {"1", "2"}) {
    auto result = json::parse(read(report() / seed / "chaos.json"));
    EXPECT_LE(result["outages"].size(), 1U);
    // The kept plan makes the same faults again.
    EXPECT_EQ(read(report() / seed / "chaos.plan"), result["plan"]);
    EXPECT_THAT(result["command"], HasSubstr("--plan"));
  }
}

TEST_F(Chaos, FindsTheRateOfFailuresThatSupervisorsDoNotBear) {
  auto file = write("limited.cast", "SUPERVISE * RESTARTS 2 IN 1min\n"
                                    "SUPERVISE SYSTEM RESTARTS 0 IN 1min\n" +
                                      read(system("CPP UM clock Clock\nCPP UM other Clock\n")));
  auto answer = ask({"chaos", file, "--find-limit", "--rate", "60", "--duration", "2s", "--settle",
                     "300ms", "--json"});
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  double survived = 0;
  double too_many = 1e9;
  for (auto& x : json_lines(answer.output)) {
    double rate = x["failures_per_minute"];
    if (x["survived"])
      survived = std::max(survived, rate);
    else
      too_many = std::min(too_many, rate);
  }
  EXPECT_LT(survived, too_many);
  EXPECT_LT(too_many, 1.2 * std::max(survived, 1.0));
}

TEST_F(Chaos, OneThatDoesNotHoldIsReportedWithTheCommandThatDoesTheSameAgain) {
  auto file = write("fragile.cast", "SUPERVISE * RESTARTS 0 IN 1min\n"
                                    "SUPERVISE SYSTEM RESTARTS 0 IN 1min\n" +
                                      read(system("CPP UM clock Clock\n")));
  auto answer = ask(arguments(file, "at 200ms crash any component\n", "1s", {"--bound", "5s"}));
  EXPECT_EQ(answer.status, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, AllOf(HasSubstr("VIOLATED   survival"),
                                   HasSubstr("the system ended: the supervisor: clock has failed"),
                                   HasSubstr("clock is down: failed in run(): injected crash")));
  auto again = command_for_again(answer.output);
  EXPECT_THAT(again, AllOf(Contains("--plan"), Contains("--settle"), Contains("--bound"),
                           Contains("--plugin"), Not(Contains("--report"))));
  Process repetition{again};
  EXPECT_EQ(repetition.wait(), 1) << repetition.errors();
  EXPECT_THAT(repetition.output(), HasSubstr("the system ended: the supervisor: clock has failed"));
}

TEST_F(Chaos, AStateThatIsNotTheSameAsWithoutFaultsIsAViolation) {
  // Each time that it is started, the clock adds another entry.
  auto answer = ask(
    arguments(system("CPP UM clock Clock\n"), "at 200ms crash clock\n", "1s", {"--same", "Tick"}));
  EXPECT_EQ(answer.status, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, AllOf(HasSubstr("VIOLATED   state as without faults"),
                                   HasSubstr("  + a Tick {\"number\":3}")));
  EXPECT_THAT(values(report_as_json()["violations"], "check"),
              testing::ElementsAre("state as without faults"));
}

TEST_F(Chaos, AFlawedPlanIsRefusedWithItsPlace) {
  auto file = system("CPP UM clock Clock\n");
  auto answer = ask(arguments(file, "at 1s crash clock\nat 1s tickle clock\n"));
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, AllOf(HasSubstr("system.plan:2"), HasSubstr("is not a fault")));
  answer = ask(arguments(file, "at 1s crash clocl\n"));
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, AllOf(HasSubstr("system.plan:1"), HasSubstr("clock")));
  answer = ask(arguments(file, "at 1s fail journal of a\n"));
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, HasSubstr("add --journal full to its WM line"));
  EXPECT_FALSE(std::filesystem::exists(report()));
}

TEST_F(Chaos, AnInterruptEndsTheRunInOrder) {
  auto file =
    write("nodes.cast", "HOSTNAME one one.test\n" + read(system("CPP UM ticker Ticker\n")) +
                          "[one] CPP UM listener Listener --count 1000000 --late\n");
  Process castor{command(arguments(file, "at 100ms crash listener\n", "1min"))};
  ASSERT_TRUE(castor.wait_for_output("[listener] is back")) << castor.errors();
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 1) << castor.errors();
  EXPECT_THAT(castor.output(), AllOf(HasSubstr("interrupted"), HasSubstr("1 of 1 faults")));
  EXPECT_THAT(castor.errors(), HasSubstr("stopped, in this order: listener, ticker, a_tm"));
  EXPECT_EQ(report_as_json()["held"], false);
}

TEST_F(Chaos, AnIsolatedComponentThatIsStoppedGoesOn) {
  auto answer = ask(arguments(system("CPP UM clock Clock --isolate\nCPP UM other Clock\n"),
                              "at 100ms stop clock for 300ms\nat 200ms crash other\n", "600ms"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, AllOf(HasSubstr("2 of 2 faults"), HasSubstr("outages: 1 back")));
  EXPECT_THAT(answer.errors, HasSubstr("[other] is back after"));
}

TEST_F(Chaos, AnIsolatedComponentWhoseStartIsBlockedIsKilledAndStartedAgain) {
  for (auto phase : {"start", "configure"}) {
    auto answer = ask(arguments(
      system("CPP UM clock Clock --isolate --budget 500ms\n"),
      "at 100ms block " + std::string{phase} + " of clock\nat 200ms crash clock\n", "4s"));
    EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
    EXPECT_THAT(answer.errors, HasSubstr("[clock] hangs; its process is killed"));
    EXPECT_THAT(answer.errors, ContainsRegex("\\[clock\\] is back after"));
  }
}

TEST_F(Chaos, ProcessesWithoutFileDescriptorsGoOnAndAreStartedAgain) {
  auto file =
    write("nodes.cast", "HOSTNAME one one.test\n" +
                          read(system("CPP UM clock Clock --isolate\nCPP UM other Clock\n")) +
                          "[one] CPP UM listener Listener --count 1000000 --late\n");
  auto answer = ask(arguments(file,
                              "at 100ms use up descriptors of one for 1s\n"
                              "at 200ms use up descriptors of clock for 300ms\n"
                              "at 200ms crash listener\n"
                              "at 1200ms use up descriptors of coordinator for 1500ms\n"
                              "at 1300ms kill clock\n"
                              "at 1300ms kill one\n"
                              "at 1300ms crash other\n",
                              "5s"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("7 of 7 faults"));
  for (auto who : {"clock", "listener", "other"})
    EXPECT_THAT(answer.errors, ContainsRegex("\\[" + std::string{who} + "\\] is back after"));
}

TEST_F(Chaos, NodesThatAreFloodedKeepTheirLinksAndGetNewOnes) {
  auto file =
    write("nodes.cast", "HOSTNAME one one.test\n" +
                          read(system("CPP UM clock Clock --isolate\nCPP UM other Clock\n")) +
                          "[one] CPP UM listener Listener --count 1000000 --late\n");
  auto answer = ask(arguments(file,
                              "at 100ms flood one for 2s\n"
                              "at 200ms flood clock with 50/s for 1s\n"
                              "at 1s kill one\n"
                              "at 1s kill clock\n",
                              "4s"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.errors, ContainsRegex("flood one is over: [1-9][0-9]+ connections"));
  EXPECT_THAT(answer.errors, ContainsRegex("turned away process [0-9]+"));
  for (auto who : {"clock", "listener"})
    EXPECT_THAT(answer.errors, ContainsRegex("\\[" + std::string{who} + "\\] is back after"));
}

TEST_F(Chaos, AComponentWhoseStartIsBlockedForTooLongIsBackTooLate) {
  auto answer = ask(arguments(system("CPP UM clock Clock\n"),
                              "at 100ms block start of clock for 1s\nat 200ms crash clock\n", "1s",
                              {"--bound", "300ms"}));
  EXPECT_EQ(answer.status, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output,
              AllOf(HasSubstr("VIOLATED   back or given up in time"),
                    HasSubstr("2 of 2 faults happened"), HasSubstr("outages: 1 back")));
}

TEST_F(Chaos, WritesItsReportBeforeItLeavesAComponentThatDoesNotComeBackFromItsStart) {
  auto answer = ask(arguments(system("CPP UM clock Clock --shutdown 1s\n"),
                              "at 100ms block start of clock\nat 200ms crash clock\n", "1s",
                              {"--bound", "300ms"}));
  EXPECT_EQ(answer.status, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output,
              AllOf(HasSubstr("VIOLATED   back or given up in time"),
                    HasSubstr("the system did not come to rest, since not everything is back")));
  EXPECT_THAT(answer.errors, HasSubstr("still running: a.clock in start()"));
  EXPECT_THAT(values(report_as_json()["violations"], "check"),
              Contains("back or given up in time"));
}

TEST_F(Chaos, NothingThatAJournalHasAcknowledgedIsLostWhenItFails) {
  auto file =
    write("journaled.cast",
          "HOSTNAME one one.test\nACCESS a WRITES b\n" + read(system("CPP UM clerk Clerk\n")) +
            "SUBARCHITECTURE b [one]\nCPP WM SubarchitectureWorkingMemory --journal full "
            "--journal-dir " +
            (folder / "journals").string() + "\nCPP TM AlwaysPositiveTaskManager\n");
  auto answer = ask(arguments(
    file, "at 100ms slow journal of b by 20ms for 200ms\nat 400ms fail journal of b\n", "20s"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output,
              AllOf(HasSubstr("2 of 2 faults"),
                    HasSubstr("ended by: a.clerk: all that was acknowledged is there")));
  EXPECT_THAT(answer.errors, HasSubstr("injected failure. The working memory of b ends"));
  EXPECT_THAT(values(report_as_json()["outages"], "target"), Contains("b_wm"));
}

TEST_F(Chaos, AJournalIsRefusedToAnotherSystemByNameAndProcess) {
  auto file =
    write("journaled.cast", "HOSTNAME one one.test\n" + read(system("CPP UM clock Clock\n")) +
                              "SUBARCHITECTURE b [one]\nCPP WM SubarchitectureWorkingMemory "
                              "--journal full --journal-dir " +
                              (folder / "journals").string() +
                              "\nCPP TM AlwaysPositiveTaskManager\nCPP UM other Clock\n");
  auto answer =
    ask(arguments(file, "at 200ms claim journal of b\nat 200ms crash clock\n", "400ms"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(
    answer.errors,
    ContainsRegex("claim journal of b: it was refused: the journal .*/b.castor-journal of b cannot "
                  "be opened: system journaled-[0-9-]+, process [0-9]+ on .* writes it"));
}

// -- workloads

constexpr const char* order = R"({"dish": "soup", "portion": "small", "extras": [], )"
                              R"("place": {"table": 1, "seat": 2}})";

TEST_F(Chaos, AWorkloadBesideTheSystemIsDoneAndItsWritesAreJudgedAsWell) {
  auto file = system("CPP UM clock Clock\n");
  write("system.workload", std::string{"every 100ms write Order "} + order + " to a/order\n" +
                             "rate 10/s write Order " + order + " to a\n");
  auto answer = ask(arguments(file, "at 300ms crash clock\n"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.errors, HasSubstr("workload: " + (folder / "system.workload").string()));
  EXPECT_THAT(answer.output,
              AllOf(ContainsRegex("workload: .*other actions"), ContainsRegex("ok +workload done"),
                    ContainsRegex("ok +operations on a "), ContainsRegex("ok +changes in a ")));
  auto work = report_as_json().at("workload");
  EXPECT_EQ(work["statements"][0]["counts"]["due"], 9);
  EXPECT_EQ(work["counts"]["due"], work["counts"]["done"]);
  // With another, or none.
  answer = ask(arguments(file, "at 300ms crash clock\n", "400ms", {"--workload", "none"}));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_EQ(report_as_json().at("workload"), nullptr);
  EXPECT_THAT(answer.output, Not(HasSubstr("workload")));
}

TEST_F(Chaos, AChangeThatTheWorkloadForbidsIsAViolation) {
  auto file = system("CPP UM clock Clock\n");
  write("system.workload", "never Order\nnever overwritten Tick where number > 1000000\n");
  auto answer = ask(arguments(file, "at 300ms crash clock\n", "500ms"));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, ContainsRegex("ok +no forbidden change +2 filters"));
  write("system.workload", "never Order\nnever overwritten Tick where number > 0\n");
  answer = ask(arguments(file, "at 300ms crash clock\n", "500ms"));
  EXPECT_EQ(answer.status, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output,
              ContainsRegex("system.workload:2: never overwritten Tick where number > 0: [0-9]+ "
                            "changes, the first: OVERWRITE of a/.* by clock"));
}

TEST_F(Chaos, WhatAWorkloadCannotWriteNowIsWrittenWhenTheWorkingMemoryIsBack) {
  auto file = system("CPP UM clock Clock\n");
  auto workload = write("w.workload", std::string{"every 20ms write Order "} + order + " to a\n");
  auto answer = ask(
    arguments(file, "at 200ms crash a_wm\nat 500ms crash a_wm\n", "1s", {"--workload", workload}));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  auto work = report_as_json().at("workload");
  EXPECT_EQ(work["counts"]["due"], 49);
  EXPECT_EQ(work["counts"]["done"], 49);
  EXPECT_THAT(answer.output, ContainsRegex("ok +operations on a .*lives"));
}

TEST_F(Chaos, EverySentenceOfAWorkloadIsAnswered) {
  auto file = write("talk.cast", "HOST localhost\n"
                                 "SUBARCHITECTURE talk\n"
                                 "CPP WM SubarchitectureWorkingMemory\n"
                                 "CPP TM AlwaysPositiveTaskManager\n"
                                 "CPP UM parser UtteranceParser\n"
                                 "CPP UM interpreter DialogueInterpreter\n"
                                 "CPP UM communication-monitor CommunicationBindingMonitor\n"
                                 "CPP UM content-planner ContentPlanner\n"
                                 "CPP UM realiser SentenceRealiser\n"
                                 "CPP UM speech SpeechOutput\n"
                                 "SUPERVISE * RESTARTS 100 IN 1s\n");
  auto workload = write("w.workload", "every 200ms say \"Hello.\" or \"Zorg the zorg.\"\n"
                                      "expect answer within 10s\n");
  auto answer = ask(
    arguments(file, "every 210ms crash any component\nat 1s crash talk_wm\nat 2s throw in speech\n",
              "3s", {"--workload", workload, "--seed", "4"}));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, ContainsRegex("ok +sentences answered +14 sentences, within 10"));
  auto counts = report_as_json().at("workload").at("counts");
  EXPECT_EQ(counts["said"], 14);
  EXPECT_EQ(counts["answered"].get<int>() + counts["apologised"].get<int>(), 14);
  EXPECT_GT(counts["answered"], 0);
  EXPECT_GT(counts["apologised"], 0);
}

TEST_F(Chaos, ASentenceThatNobodyAnswersIsAViolation) {
  auto file = system("CPP UM parser UtteranceParser\n");
  auto workload = write("w.workload", "at 100ms say \"Hello.\"\nexpect answer within 10s\n");
  auto answer = ask(arguments(file, "at 50ms crash parser\n", "500ms", {"--workload", workload}));
  EXPECT_EQ(answer.status, 1) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, AllOf(ContainsRegex("VIOLATED +sentences answered"),
                                   ContainsRegex("'Hello.', said at .*, was not answered"),
                                   ContainsRegex("again: .* --workload " + workload)));
}

TEST_F(Chaos, AWorkloadChangesACopyOfTheScene) {
  auto scene = write("table.scene", "image 160 120\nred cube at 0 0\n");
  auto file =
    write("see.cast", "HOST localhost\nCOMPONENT CPP camera Camera --source scene:" + scene +
                        "\nSUBARCHITECTURE vision\nCPP WM SubarchitectureWorkingMemory\n"
                        "CPP TM AlwaysPositiveTaskManager\n"
                        "CPP UM change-detector ChangeDetector\nCPP MG segmentor Segmentor\n");
  auto workload = write("w.workload", "at 1s add blue cube at 0.2 0.1\nat 1s remove red cube\n"
                                      "at 2s add green cube at -0.2 0.1\n"
                                      "same SceneChanged, ROI but for time, object_id, box, mask, "
                                      "contour, region, pose\n");
  auto before = read(scene);
  auto answer = ask(arguments(file, "after every 2 added ROI in vision: crash segmentor\n", "3s",
                              {"--workload", workload}));
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, AllOf(ContainsRegex("ok +workload done +3 of 3 actions"),
                                   ContainsRegex("ok +state as without faults +3 entries")));
  EXPECT_EQ(read(scene), before);
}

TEST_F(Chaos, AFlawedWorkloadIsRefusedWithItsPlace) {
  auto file = system("CPP UM clock Clock\n");
  auto flawed = write("w.workload", "at 1s say \"a\"\nat 1s write Oder {} to a\n"
                                    "at 1s write Order {\"dsh\": 1} to a\n");
  for (auto& answer : {ask(arguments(file, "", "1s", {"--workload", flawed})),
                       ask({"check", file, "--workload", flawed})}) {
    EXPECT_NE(answer.status, 0);
    EXPECT_THAT(answer.errors,
                AllOf(HasSubstr("w.workload:1: error: no subarchitecture has an UtteranceParser"),
                      HasSubstr("w.workload:2"), HasSubstr("Oder"), HasSubstr("w.workload:3"),
                      HasSubstr("dsh")));
  }
  EXPECT_FALSE(std::filesystem::exists(report()));
}

} // namespace

} // namespace castor::test
