#include "castor/tests/tools/cli/castor_fixture.hpp"

#include "castor/tests/support/terminal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Runs that are recorded, and recordings that are replayed.
class RecordCommand : public Castor {
protected:
  std::string recording() const { return (folder / "recording").string(); }

  /// Records a run that ends of itself, or in simulated time if it goes on for a time, and returns
  /// what it says.
  std::string record(const std::string& components, std::vector<std::string> options = {}) const {
    if (std::ranges::find(options, "--for") != options.end())
      options.insert(options.end(), {"--speed", "max"});
    options.insert(options.begin(), {"run", system(components), "--record", recording()});
    auto answer = ask(options);
    EXPECT_EQ(answer.status, 0) << answer.errors;
    return answer.output;
  }

  std::vector<std::string> replay_command(std::vector<std::string> options) const {
    options.insert(options.begin(), {"journal", "replay", recording()});
    return options;
  }

  json replay(std::vector<std::string> options) const {
    options.push_back("--json");
    auto answer = ask(replay_command(options));
    EXPECT_EQ(answer.status, 0) << answer.errors;
    return answer.output.empty() ? json{} : json::parse(answer.output);
  }

  std::string refusal(std::vector<std::string> options) const {
    auto answer = ask(replay_command(options));
    EXPECT_EQ(answer.status, 2);
    EXPECT_EQ(answer.output, "");
    return answer.errors;
  }

  std::vector<json> entries(const std::string& journal) const {
    return json_lines(ask({"journal", "show", journal, "--entries", "--json"}).output);
  }

  static constexpr auto watched_beacon = "CPP UM watcher Watcher\nCOMPONENT CPP beacon Beacon";
};

TEST_F(RecordCommand, KeepsChangesAndSaysHowTheyAreReplayed) {
  auto said = record("CPP UM clock Clock --status 0\n");
  EXPECT_THAT(said, HasSubstr("4 changes of 1 working memory (1 entry in the end)"));
  EXPECT_THAT(said, AllOf(HasSubstr("replay it with: castor --plugin "),
                          HasSubstr("journal replay " + recording())));
  auto outcome = replay({});
  EXPECT_EQ(outcome["writes"], 4);
  EXPECT_EQ(outcome["refused"], 0);
}

TEST_F(RecordCommand, ReplaysWhatAStandAloneComponentHandedOutInItsPlace) {
  auto said = record(watched_beacon, {"--for", "1s"});
  EXPECT_THAT(said, testing::ContainsRegex("[0-9]+ pushes and 1 answer to a pull of beacon"));
  // The watcher fails unless it pulls what was pulled and gets the pushes one after another.
  auto output = (folder / "output").string();
  EXPECT_GT(replay({"--without", "beacon", "--output", output})["values"], 20);
  EXPECT_THAT(read(folder / "output/entries.json"), HasSubstr("\"who\":\"watcher\""));
}

TEST_F(RecordCommand, AnEffectorThatIsLeftOutObeysWithoutEffect) {
  auto file = write("wheel.cast", "COMPONENT CPP wheel TestWheel\nSUBARCHITECTURE drive localhost\n"
                                  "CPP WM SubarchitectureWorkingMemory\n"
                                  "CPP TM AlwaysPositiveTaskManager\n"
                                  "CPP UM clock Clock\nCPP UM pusher Pusher\n");
  auto live = ask({"run", file, "--record", recording()});
  EXPECT_EQ(live.status, 0) << live.errors;
  EXPECT_THAT(live.errors, HasSubstr("[wheel] turns with speed 1"));
  auto replayed = ask(replay_command({"--without", "clock,wheel"}));
  EXPECT_EQ(replayed.status, 0) << replayed.errors;
  EXPECT_THAT(replayed.errors, HasSubstr("[drive.pusher] the wheel has obeyed"));
  EXPECT_THAT(replayed.errors, Not(HasSubstr("turns with speed")));
}

TEST_F(RecordCommand, TellsScriptsWhatWasRecorded) {
  auto lines = json_lines(record(watched_beacon, {"--for", "1s", "--json"}));
  ASSERT_EQ(lines.size(), 1U);
  auto& recorded = lines.front()["recording"];
  EXPECT_EQ(recorded["folder"], recording());
  EXPECT_GT(recorded["changes"], 0);
  EXPECT_THAT(recorded["replay"].get<std::string>(), HasSubstr("journal replay " + recording()));
  ASSERT_EQ(recorded["providers"].size(), 1U);
  EXPECT_EQ(recorded["providers"][0]["provider"], "beacon");
  EXPECT_GT(recorded["providers"][0]["pushes"], 20);
  EXPECT_EQ(recorded["providers"][0]["pulls"], 1);
}

TEST_F(RecordCommand, IsListedWithWhatStandAloneComponentsHandedOut) {
  record(watched_beacon, {"--for", "1s"});
  auto text = ask({"journal", "ls", recording()});
  EXPECT_EQ(text.status, 0) << text.errors;
  EXPECT_THAT(text.output, testing::ContainsRegex("\na +[0-9]+ +[0-9]+ "));
  EXPECT_THAT(text.output, HasSubstr("stand-alone component"));
  EXPECT_THAT(text.output, testing::ContainsRegex("\nbeacon +[0-9]+ +1 .*beacon.castor-pushes"));
  auto lines = json_lines(ask({"journal", "ls", recording(), "--json"}).output);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]["subarchitecture"], "a");
  EXPECT_EQ(lines[1]["provider"], "beacon");
  EXPECT_GT(lines[1]["pushes"], 20);
  EXPECT_EQ(lines[1]["pulls"], 1);
  // Alone, and damaged.
  auto pushes = recording() + "/beacon.castor-pushes";
  EXPECT_THAT(ask({"journal", "ls", pushes}).output, Not(HasSubstr("subarchitecture")));
  std::ofstream{pushes} << "nothing";
  auto damaged = ask({"journal", "ls", pushes});
  EXPECT_EQ(damaged.status, 2);
  EXPECT_EQ(damaged.output, "");
  EXPECT_THAT(damaged.errors, HasSubstr("beacon.castor-pushes"));
}

TEST_F(RecordCommand, RecordsOtherProcessesOfThisMachine) {
  for (auto& [file, options] : std::vector<std::pair<std::string, std::vector<std::string>>>{
         {"HOST localhost\nSUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory\n"
          "CPP TM AlwaysPositiveTaskManager\nCPP UM watcher Watcher\n"
          "COMPONENT CPP beacon Beacon --isolate\n",
          {}},
         {"HOST localhost\nSUBARCHITECTURE a elsewhere\nCPP WM SubarchitectureWorkingMemory\n"
          "CPP TM AlwaysPositiveTaskManager\nCPP UM watcher Watcher\n"
          "COMPONENT elsewhere CPP beacon Beacon\n",
          {"--local-nodes"}}}) {
    std::filesystem::remove_all(recording());
    std::vector<std::string> arguments{
      "run", write("nodes.cast", file), "--record", recording(), "--for", "2s"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    auto answer = ask(arguments);
    EXPECT_EQ(answer.status, 0) << answer.errors;
    EXPECT_THAT(answer.output, testing::ContainsRegex("[0-9]+ pushes and 1 answer to a pull"));
    // All of it in one process.
    EXPECT_GT(replay({"--without", "beacon"})["values"], 20);
  }
}

TEST_F(RecordCommand, DropsTheOldestPushesBeyondTheLimit) {
  auto said = record("CPP UM drain PushDrain\nCOMPONENT CPP flood PushFlood --time 2s",
                     {"--record-limit", "1"});
  EXPECT_THAT(said, testing::ContainsRegex("the [0-9]+ oldest pushes and answers were dropped"));
  EXPECT_THAT(said, HasSubstr("--record-limit"));
  EXPECT_LT(std::filesystem::file_size(folder / "recording/flood.castor-pushes"), 8'000'000u);
}

TEST_F(RecordCommand, RefusesFoldersBeforeTheRun) {
  auto file = system("CPP UM clock Clock --status 0\n");
  auto refused = [&](const std::string& place, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"run", file, "--trace", "--record", place});
    auto answer = ask(options);
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.output, Not(HasSubstr("ADD")));
    return answer.errors;
  };
  write("occupied", "");
  EXPECT_THAT(refused((folder / "occupied/x").string()),
              AllOf(HasSubstr("cannot make the folder " + (folder / "occupied/x").string()),
                    HasSubstr("choose another place"), Not(HasSubstr("filesystem error"))));
  EXPECT_THAT(refused(folder.string()), HasSubstr("is not empty"));
  record("CPP UM clock Clock --status 0\n");
  EXPECT_THAT(refused(recording()), HasSubstr("holds a recording"));
  EXPECT_THAT(refused((folder / "other").string(), {"--journal", "off"}),
              HasSubstr("remove --journal off"));
}

TEST_F(RecordCommand, LeavesAJournalAloneThatIsKeptAnyway) {
  auto file =
    write("own.cast", "HOST localhost\nSUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory "
                      "--journal full --journal-dir " +
                        (folder / "journals").string() +
                        "\nCPP TM AlwaysPositiveTaskManager\nCPP UM clock Clock --status 0\n");
  auto answer = ask({"run", file, "--record", recording()});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, AllOf(HasSubstr("own.cast:3"), HasSubstr("--journal batched")));
  EXPECT_FALSE(std::filesystem::exists(recording()));
  EXPECT_EQ(ask({"run", file, "--record", recording(), "--journal", "full"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "journals"));
  EXPECT_EQ(replay({})["writes"], 4);
  // A replay leaves the recording as it was, and keeps no journal of its own.
  EXPECT_EQ(replay({"--config", file})["writes"], 4);
  EXPECT_FALSE(std::filesystem::exists(folder / "journals"));
}

TEST_F(RecordCommand, TheCommandLineDecidesOnJournals) {
  auto file = system("CPP UM clock Clock --status 0\n");
  auto journals = folder / "journals";
  EXPECT_EQ(ask({"run", file, "--journal", "full", "--journal-dir", journals.string()}).status, 0);
  EXPECT_EQ(entries((journals / "a.castor-journal").string()).size(), 1u);
  EXPECT_EQ(ask({"run", file, "--journal", "batched", "--journal-dir", journals.string()}).status,
            0);
  EXPECT_EQ(entries((journals / "a.castor-journal").string()).size(), 2u);
  std::filesystem::remove_all(journals);
  auto journaled = write("journaled.cast",
                         "HOST localhost\nSUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory "
                         "--journal full --journal-dir " +
                           journals.string() +
                           "\nCPP TM AlwaysPositiveTaskManager\nCPP UM clock Clock --status 0\n");
  EXPECT_EQ(ask({"run", journaled, "--journal", "off"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(journals));
  auto misspelt = ask({"run", file, "--journal", "ful"});
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_THAT(misspelt.errors, HasSubstr("batched"));
}

TEST_F(RecordCommand, SaysWhatThereIsIfThereIsNothingToReplay) {
  record(watched_beacon, {"--for", "1s"});
  EXPECT_THAT(refusal({"--without", "wacher"}), HasSubstr("did you mean 'watcher'?"));
  EXPECT_THAT(refusal({"--without", "nosuch"}), HasSubstr("there are: a, beacon, watcher"));
  EXPECT_THAT(refusal({"--from", "1h"}), HasSubstr("--from 1h is behind the end"));
  EXPECT_THAT(refusal({"--from", "500ms", "--to", "400ms"}), HasSubstr("later than --from"));
  EXPECT_THAT(refusal({"--speed", "fast"}), HasSubstr("--speed max"));
  EXPECT_THAT(refusal({"--set", "a=b"}), HasSubstr("--config"));
  EXPECT_THAT(ask({"journal", "replay", (folder / "nowhere").string()}).errors,
              HasSubstr("there is no file or folder"));
  EXPECT_THAT(ask({"journal", "replay", folder.string()}).errors, HasSubstr("holds no recording"));
}

TEST_F(RecordCommand, AJournalWithoutWritesCannotBeReplayed) {
  // Nobody writes; a component that fails is no reason to go on.
  auto file = system("CPP UM broken Broken --restart temporary\n");
  ask({"run", file, "--record", recording(), "--for", "200ms"});
  EXPECT_THAT(refusal({}), AllOf(HasSubstr("there is nothing to replay"), HasSubstr("no changes")));
}

TEST_F(RecordCommand, ASubarchitectureStandsForItsComponents) {
  record("CPP UM clock Clock\nCPP UM pair Pair\n");
  auto answer = ask(replay_command({"--without", "a"}));
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.output, AllOf(Not(HasSubstr("a.clock")), Not(HasSubstr("a.pair"))));
}

TEST_F(RecordCommand, BeginsLaterWithTheEntriesThatWereThere) {
  record("CPP UM early Clock --count 1\nCPP UM ticker Ticker\n", {"--for", "2s"});
  auto all = replay({"--speed", "max"})["writes"].get<int>();
  auto output = (folder / "output").string();
  auto part =
    replay({"--speed", "max", "--from", "1s", "--to", "1500ms", "--output", output})["writes"]
      .get<int>();
  EXPECT_LT(part, all / 2);
  EXPECT_GT(part, 2);
  EXPECT_THAT(read(folder / "output/entries.json"), HasSubstr("\"writer\": \"early\""));
}

TEST_F(RecordCommand, LoopsAndRemovesWhatItHasAddedInBetween) {
  record("CPP UM clock Clock --status 0\n");
  auto output = (folder / "output").string();
  EXPECT_EQ(replay({"--speed", "max", "--loop", "3", "--output", output})["writes"], 12);
  auto all = json::parse(read(folder / "output/entries.json"));
  ASSERT_EQ(all["a"].size(), 1u);
  EXPECT_EQ(all["a"][0]["value"]["number"], 3);
}

TEST_F(RecordCommand, LastsAsLongAsTheRun) {
  record("CPP UM clock Clock\n", {"--for", "1500ms"});
  auto begin = std::chrono::steady_clock::now();
  replay({"--until-quiet", "100ms"});
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds{1500});
  begin = std::chrono::steady_clock::now();
  replay({"--until-quiet", "100ms", "--speed", "0.5"});
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::seconds{3});
}

TEST_F(RecordCommand, PausesAndEndsByKeysInATerminalOnly) {
  record("CPP UM ticker Ticker\n", {"--for", "2s"});
  Terminal terminal{200};
  terminal.start(command(replay_command({"--loop"})));
  ASSERT_TRUE(terminal.wait_for("speed 1x"));
  terminal.type(" ");
  ASSERT_TRUE(terminal.wait_for("paused"));
  terminal.type(" ");
  ASSERT_TRUE(terminal.wait_for("round 2"));
  terminal.type("q");
  EXPECT_EQ(terminal.wait(), 0);
  EXPECT_THAT(terminal.written(), HasSubstr("writes replayed"));
  auto answer = ask(replay_command({"--speed", "max"}));
  EXPECT_EQ(answer.errors.find("speed"), std::string::npos) << answer.errors;
}

} // namespace

} // namespace castor::test
