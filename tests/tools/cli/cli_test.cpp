#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

TEST_F(Castor, SaysWhatItIs) {
  Process castor{command({"--version"})};
  EXPECT_EQ(castor.wait(), 0);
  EXPECT_TRUE(std::regex_match(castor.output(), std::regex{"castor \\d+\\.\\d+\\.\\d+\n"}));
}

TEST_F(Castor, WithoutACommandItExplainsItself) {
  Process castor{command({})};
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_NE(castor.errors().find("castor needs a command: run, "), std::string::npos)
    << castor.errors();
}

TEST_F(Castor, ListsComponentsWithTheirOptions) {
  Process castor{command({"components"})};
  EXPECT_EQ(castor.wait(), 0);
  for (auto part : {"Clock", "ticks a few times", "--count", "how often it ticks",
                    "whole number; 3", "SubarchitectureWorkingMemory", "AlwaysPositiveTaskManager",
                    "SchedulingTaskManager", "--resource-budget", "--backfill"})
    EXPECT_NE(castor.output().find(part), std::string::npos) << part;
}

TEST_F(Castor, ListsComponentsForScripts) {
  auto answer = ask({"components", "--json"});
  EXPECT_EQ(answer.status, 0);
  for (auto& x : json_lines(answer.output))
    if (x["class"] == "Clock") {
      EXPECT_EQ(x["kind"], "unmanaged");
      EXPECT_EQ(x["options"].back()["name"], "status");
      EXPECT_EQ(x["options"].back()["default"], "-1");
      return;
    }
  ADD_FAILURE() << answer.output;
}

TEST_F(Castor, ATracedRunWithAStandaloneComponentEnds) {
  auto file =
    write("beacon.cast", "HOST localhost\nCOMPONENT CPP beacon Beacon\nSUBARCHITECTURE a\n"
                         "CPP WM SubarchitectureWorkingMemory\n"
                         "CPP TM AlwaysPositiveTaskManager\n"
                         "CPP UM clock Clock --count 2 --status 0\n");
  Process castor{command({"run", file, "--trace"})};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
}

TEST_F(Castor, TheTimelineIsPlainInAPipe) {
  Process castor{command({"run", system("CPP UM clock Clock --count 2 --status 0\n"), "--trace"})};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  auto text = castor.output();
  EXPECT_EQ(text.find('\033'), text.npos);
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex{"a +ADD +Tick +\\S+ +clock +v0\n"}));
  EXPECT_TRUE(std::regex_search(text, match, std::regex{"a +OVERWRITE +Tick +\\S+ +clock +v2\n"}));
  EXPECT_TRUE(std::regex_search(text, match, std::regex{"\na +Tick +1\n"})) << text;
  EXPECT_TRUE(std::regex_search(text, match, std::regex{"a\\.clock +stopped +0 +0 +0 +3 +0\n"}));
}

TEST_F(Castor, ARunForScriptsPrintsHowItEnded) {
  auto answer = ask({"run", system("CPP UM clock Clock --count 2 --status 7\n"), "--json"});
  EXPECT_EQ(answer.status, 7);
  auto lines = json_lines(answer.output);
  ASSERT_EQ(lines.size(), 1U) << answer.output;
  auto& end = lines.front();
  EXPECT_EQ(end["ended"], "component");
  EXPECT_EQ(end["reason"], "a.clock: it has ticked 2 times");
  EXPECT_EQ(end["status"], 7);
  EXPECT_TRUE(end["failures"].empty());
  EXPECT_EQ(end["components"].back()["name"], "clock");
  EXPECT_EQ(end["components"].back()["node"], "localhost");
  EXPECT_EQ(end["components"].back()["writes"], 3);
  bool is_counted = false;
  for (auto& wm : end["working_memories"])
    is_counted = is_counted || (wm["subarchitecture"] == "a" && wm["events"] == 3 &&
                                wm["entries_by_type"] == nlohmann::json{{"Tick", 1}});
  EXPECT_TRUE(is_counted) << end.dump(2);
  EXPECT_EQ(end["processes"].front()["name"], "localhost");
}

TEST_F(Castor, ARunForScriptsSaysWhyItEnded) {
  auto end_of = [&](const std::string& components, std::vector<std::string> options) {
    options.insert(options.begin(), {"run", system(components), "--json"});
    auto answer = ask(options);
    auto lines = json_lines(answer.output);
    EXPECT_EQ(lines.size(), 1U) << answer.output << answer.errors;
    auto end = lines.empty() ? nlohmann::json{} : lines.front();
    EXPECT_EQ(end["status"], answer.status);
    return end;
  };
  EXPECT_EQ(end_of("CPP UM clock Clock\n", {"--until-quiet", "100ms"})["ended"], "quiet");
  EXPECT_EQ(end_of("CPP UM clock Clock\n", {"--for", "100ms"})["ended"], "time");
  auto failed = end_of("CPP UM broken Broken\n", {"--no-restarts"});
  EXPECT_EQ(failed["ended"], "failed");
  EXPECT_EQ(failed["status"], 1);
  ASSERT_EQ(failed["failures"].size(), 1U);
  EXPECT_EQ(failed["failures"][0]["component"], "a.broken");
  EXPECT_NE(failed["failures"][0]["failure"].get<std::string>().find("the spring is gone"),
            std::string::npos);
}

TEST_F(Castor, ATracedRunForScriptsPrintsEveryChangeAsJson) {
  auto output = (folder / "out").string();
  auto answer = ask(
    {"run", system("CPP UM clock Clock --status 0\n"), "--trace", "--json", "--output", output});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  auto lines = json_lines(answer.output);
  ASSERT_FALSE(lines.empty());
  std::vector<std::string> changes;
  for (auto& x : lines) {
    if (!x.contains("operation") || x["type"] != "Tick")
      continue;
    EXPECT_EQ(x["component"], "clock");
    EXPECT_EQ(x["subarchitecture"], "a");
    changes.push_back(x["operation"]);
  }
  EXPECT_EQ(changes, (std::vector<std::string>{"ADD", "OVERWRITE", "OVERWRITE", "OVERWRITE"}));
  EXPECT_EQ(lines.back()["ended"], "component");
  EXPECT_EQ(lines.back()["wrote"], nlohmann::json::array({output}));
  // The file is for people, as without --json.
  EXPECT_NE(read(folder / "out/timeline.txt").find("OVERWRITE       Tick"), std::string::npos);
}

TEST_F(Castor, ATracedRunForScriptsPrintsWhatBecomesOfTasksAsJson) {
  auto file =
    write("tasks.cast", "SUBARCHITECTURE a localhost\nCPP WM SubarchitectureWorkingMemory\n"
                        "CPP TM SchedulingTaskManager --resource-budget 1\n"
                        "CPP MG worker Worker\n");
  auto answer = ask({"run", file, "--trace", "--json"});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  bool is_completed = false;
  for (auto& x : json_lines(answer.output))
    is_completed = is_completed || (x.value("task", "") == "COMPLETED" && x["name"] == "look" &&
                                    x["component"] == "worker");
  EXPECT_TRUE(is_completed) << answer.output;
}

TEST_F(Castor, WhatComponentsPrintIsNotAmongTheJsonOfARun) {
  for (auto options : {"", " --isolate"}) {
    auto answer =
      ask({"run", system(std::string{"CPP UM printer Printer"} + options + "\n"), "--json"});
    EXPECT_EQ(answer.status, 0) << answer.errors;
    EXPECT_EQ(json_lines(answer.output).size(), 1U) << answer.output;
    EXPECT_NE(answer.errors.find("printed by a component"), std::string::npos) << answer.errors;
  }
}

TEST_F(Castor, EveryCommandThatPrintsDataTakesJson) {
  const std::set<std::string> that_print_text{// For shells, and for people.
                                              "completion", "man"};
  std::function<void(std::vector<std::string>)> visit = [&](std::vector<std::string> words) {
    auto help = words;
    help.push_back("--help");
    auto text = ask(help).output;
    auto commands = text.find("\nSubcommands:\n");
    if (commands == text.npos) {
      bool takes_json = text.find("--json ") != text.npos;
      EXPECT_NE(takes_json, that_print_text.count(words.front()) > 0) << text;
      return;
    }
    std::istringstream in{text.substr(commands + 14)};
    for (std::string line; std::getline(in, line) && line.starts_with("  ");) {
      std::string name;
      std::istringstream{line} >> name;
      if (line[2] == ' ')
        continue;
      auto deeper = words;
      deeper.push_back(name);
      visit(deeper);
    }
  };
  visit({});
}

TEST_F(Castor, TheTimelineShowsEveryChangeOfAnAtomicWrite) {
  Process castor{command({"run", system("CPP UM pair Pair\n"), "--trace"})};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  for (auto line : {"a +ADD +Tick +left +pair +v0\n", "a +ADD +Tick +right +pair +v0\n"})
    EXPECT_TRUE(std::regex_search(castor.output(), std::regex{line})) << castor.output();
}

TEST_F(Castor, AWorkingMemoryLogsItsChangesIfAsked) {
  for (bool asked : {true, false}) {
    auto file = write("log.cast", std::string{"SUBARCHITECTURE a\n"
                                              "CPP WM SubarchitectureWorkingMemory --log "} +
                                    (asked ? "true" : "false") +
                                    "\nCPP TM AlwaysPositiveTaskManager\nCPP UM pair Pair\n");
    Process castor{command({"run", file})};
    EXPECT_EQ(castor.wait(), 0) << castor.errors();
    for (auto part :
         {"[a.a_wm] ADD Tick a/left v0 by pair", "[a.a_wm] ADD Tick a/right v0 by pair"})
      EXPECT_EQ(castor.errors().find(part) != std::string::npos, asked) << castor.errors();
  }
}

TEST_F(Castor, TheTimelineShowsWhatBecomesOfTasks) {
  auto file =
    write("tasks.cast", "SUBARCHITECTURE a localhost\nCPP WM SubarchitectureWorkingMemory\n"
                        "CPP TM SchedulingTaskManager --resource-budget 1\n"
                        "CPP MG worker Worker\n");
  auto output = folder / "out";
  Process castor{command({"run", file, "--trace", "--output", output})};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  for (auto& text : {castor.output(), read(output / "timeline.txt")})
    for (auto line : {
           "a +TASK ADOPTED +look +task:worker:1 +worker\n",
           "a +TASK WAITING +reach +task:worker:2 +worker +it costs 1, and 1 of the budget of 1 is",
           "a +TASK WAITING +grasp +task:worker:3 +worker +it waits for task:worker:2\n",
           "a +TASK REJECTED +carry everything +task:worker:4 +worker +it costs 100, more than the",
           "a +TASK COMPLETED +look +task:worker:1 +worker +success\n",
           "a +TASK ADOPTED +grasp +task:worker:3 +worker\n",
         })
      EXPECT_TRUE(std::regex_search(text, std::regex{line})) << line << " in\n" << text;
}

TEST_F(Castor, AComponentEndsTheSystemWithItsStatus) {
  Process castor{command({"run", system("CPP UM clock Clock --status 29\n")})};
  EXPECT_EQ(castor.wait(), 29);
  EXPECT_NE(castor.errors().find("ended by a.clock: it has ticked 3 times"), std::string::npos);
}

TEST_F(Castor, StopsInReverseOrderOnCtrlC) {
  Process castor{command({"run", system("CPP UM one Clock\nCPP UM two Clock\n"), "--trace"})};
  ASSERT_TRUE(castor.wait_for_output("two"));
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0);
  EXPECT_NE(castor.errors().find("stopped, in this order: two, one, a_tm"), std::string::npos)
    << castor.errors();
  EXPECT_NE(castor.output().find("working memory"), std::string::npos) << "the summary is printed";
}

TEST_F(Castor, StopsAfterTheTimeGiven) {
  Process castor{command({"run", system("CPP UM clock Clock\n"), "--for", "200ms"})};
  EXPECT_EQ(castor.wait(), 0);
}

TEST_F(Castor, AFailedComponentShowsInReportAndStatus) {
  Process castor{command(
    {"run", system("CPP UM broken Broken\nCPP UM clock Clock\n"), "--until-quiet", "200ms"})};
  EXPECT_EQ(castor.wait(), 1);
  EXPECT_NE(castor.errors().find("[a.broken] failed in run(): the spring is gone"),
            std::string::npos);
  EXPECT_NE(castor.output().find("failed in run(): the spring is gone"), std::string::npos);
}

TEST_F(Castor, IsNotQuietWhileAComponentFailsAgainAndAgain) {
  auto file = write("broken.cast", "SUPERVISE a DELAY 150ms TO 150ms\n"
                                   "SUBARCHITECTURE a localhost\n"
                                   "CPP WM SubarchitectureWorkingMemory\n"
                                   "CPP TM AlwaysPositiveTaskManager\n"
                                   "CPP UM broken Broken\n");
  auto answer = ask({"run", file, "--until-quiet", "1s"});
  EXPECT_EQ(answer.status, 1);
  EXPECT_NE(answer.errors.find("ended by the supervisor"), std::string::npos) << answer.errors;
}

TEST_F(Castor, SaysOnceWhyAComponentHasFailed) {
  auto times = [](const std::string& what, const std::string& text) {
    std::size_t result = 0;
    for (auto i = text.find(what); i != text.npos; i = text.find(what, i + 1))
      ++result;
    return result;
  };
  auto restarted =
    ask({"run", system("CPP UM shaky Shaky --failures 1\n"), "--until-quiet", "200ms"});
  EXPECT_EQ(restarted.status, 0);
  EXPECT_EQ(times("it always does", restarted.errors), 1u) << restarted.errors;
  EXPECT_EQ(times("[a.shaky] failed in run(): it always does", restarted.errors), 1u);
  EXPECT_EQ(times("[shaky] is started again", restarted.errors), 1u);
  auto left =
    ask({"run", system("CPP UM shaky Shaky --restart temporary\n"), "--until-quiet", "200ms"});
  EXPECT_EQ(left.status, 1);
  EXPECT_EQ(times("it always does", left.errors), 1u) << left.errors;
  EXPECT_EQ(times("[shaky] stays down", left.errors), 1u);
}

TEST_F(Castor, LeavesAComponentBehindThatNeverComesBack) {
  Process castor{command({"run", system("CPP UM endless Endless\n"), "--for", "10ms"})};
  EXPECT_EQ(castor.wait(), 1);
  EXPECT_NE(castor.errors().find("[endless] did not stop"), std::string::npos) << castor.errors();
}

TEST_F(Castor, WritesItsOutputFolder) {
  auto output = folder / "out";
  Process castor{command({"run", system("CPP UM clock Clock --status 0\n"), "--output", output})};
  EXPECT_EQ(castor.wait(), 0);
  EXPECT_NE(read(output / "timeline.txt").find("OVERWRITE"), std::string::npos);
  EXPECT_NE(read(output / "entries.json").find("\"value\": {\"number\":3}"), std::string::npos)
    << read(output / "entries.json");
}

TEST_F(Castor, DrawsWhatWasInTheWorkingMemories) {
  auto scene = write("one.scene", "table cloth\ncamera 0 -0.62 0.55 looking-at 0 0 0 fov 42\n"
                                  "light 1 -0.8 2\nnoise 2\nseed 5\nred cube at 0 0 size 0.07\n");
  std::vector<std::string> arguments{"run",           CASTOR_CONFIGS "/vision.cast",
                                     "--set",         "source=scene:" + scene,
                                     "--until-quiet", "500ms"};
  for (auto name : {"page.html", "picture.svg", "picture.png"})
    arguments.insert(arguments.end(), {"--timeline", folder / name});
  Process castor{command(arguments)};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  auto page = read(folder / "page.html");
  const std::string begin = "id=\"data\">";
  auto at = page.find(begin) + begin.size();
  auto data = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
  // What the object was in the end, and that it leads to its region.
  std::string label;
  std::set<std::size_t> regions;
  for (auto& x : data["versions"])
    if (data["entries"][x["entry"].get<std::size_t>()][2] == "SceneObject") {
      label = x["content"]["label"]["value"];
      for (const auto link : x["links"].get<std::vector<std::size_t>>())
        if (data["entries"][link][2] == "ROI")
          regions.insert(link);
    }
  EXPECT_EQ(label, "red cube");
  EXPECT_EQ(regions.size(), 1U);
  for (auto& text : {page, read(folder / "picture.svg")}) {
    for (auto part : {">vision</text>", ">SceneObject</text>", ">ScenePicture</text>", "t = 0",
                      "data:image/png;base64,iVBORw0KGgo", "class=\"arrow\""})
      EXPECT_NE(text.find(part), std::string::npos) << part;
    EXPECT_EQ(text.find("class=\"card gone\" data-v"), std::string::npos)
      << "what ends with the system does not count";
  }
  // Signature, length and name of the header, width, height.
  auto png = read(folder / "picture.png");
  ASSERT_EQ(png.substr(1, 3), "PNG");
  auto number = [&](std::size_t place) {
    return static_cast<unsigned char>(png.at(place)) << 8 |
           static_cast<unsigned char>(png[place + 1]);
  };
  EXPECT_GT(number(18), 800);
  EXPECT_GT(number(22), 400);
}

TEST_F(Castor, DrawsARunThatIsInterrupted) {
  auto file = folder / "page.html";
  Process castor{command({"run", system("CPP UM clock Clock\n"), "--trace", "--timeline", file})};
  ASSERT_TRUE(castor.wait_for_output("OVERWRITE"));
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0);
  EXPECT_NE(read(file).find(">Tick</text>"), std::string::npos);
}

TEST_F(Castor, ATimelineThatCannotBeWrittenIsRefusedBeforeTheRun) {
  auto file = system("CPP UM clock Clock\n");
  auto unknown = ask({"run", file, "--timeline", folder / "page.pdf"});
  EXPECT_NE(unknown.status, 0);
  EXPECT_NE(unknown.errors.find("(.html) or as a picture (.svg, .png)"), std::string::npos)
    << unknown.errors;
  auto nowhere = ask({"run", file, "--timeline", folder / "none" / "page.html"});
  EXPECT_NE(nowhere.status, 0);
  EXPECT_NE(nowhere.errors.find("there is no folder"), std::string::npos) << nowhere.errors;
}

TEST_F(Castor, SetsVariablesBeforeTheFileIsRead) {
  auto file = system("VARDEFAULT status=1\nCPP UM clock Clock --status %(status)\n");
  Process castor{command({"run", file, "--set", "status=5"})};
  EXPECT_EQ(castor.wait(), 5) << castor.errors();
}

TEST_F(Castor, ChecksAFileAndReportsAllErrorsAtOnce) {
  auto file = system("CPP UM clock Clok\nCPP MG other Clock\nCPP UM third Clock --cuont 4\n"
                     "CPP UM fourth Clock --count many\n");
  Process castor{command({"check", file})};
  EXPECT_EQ(castor.wait(), 1);
  auto text = castor.errors();
  for (auto part : {":5: error: there is no component class Clok", "did you mean 'Clock'?",
                    ":6: error: Clock is not for a MG line", ":7: error: Clock of third",
                    "did you mean 'count'?", ":8: error", "--count takes a whole number"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST_F(Castor, ChecksAGoodFile) {
  Process castor{command({"check", system("CPP UM clock Clock\n")})};
  EXPECT_EQ(castor.wait(), 0);
  EXPECT_NE(castor.output().find("no errors"), std::string::npos);
}

TEST_F(Castor, ChecksAFaultPlanAgainstTheSystem) {
  auto file = system("CPP UM clock Clock\n");
  auto plan = write("good.plan", "seed 1\nat 1s crash clock\nat 2s kill node2\n");
  Process good{command({"check", file, "--plan", plan, "--spread", "2"})};
  EXPECT_EQ(good.wait(), 0) << good.errors();
  Process alone{command({"check", file, "--plan", plan})};
  EXPECT_EQ(alone.wait(), 1);
  EXPECT_NE(alone.errors().find("good.plan:3: error: there is no node"), std::string::npos)
    << alone.errors();
  auto bad = write("bad.plan", "at 1s crash clok\nat 1s carsh clock\n");
  Process castor{command({"check", file, "--plan", bad})};
  EXPECT_EQ(castor.wait(), 1);
  EXPECT_NE(castor.errors().find("bad.plan:2: error: 'carsh' is not a fault"), std::string::npos)
    << castor.errors();
}

TEST_F(Castor, PrintsTheResolvedArchitecture) {
  auto answer = ask({"check", "--json", system("CPP UM clock Clock --count 4\n")});
  EXPECT_EQ(answer.status, 0);
  auto lines = json_lines(answer.output);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0]["subarchitectures"][0]["components"][0]["name"], "clock");
}

TEST_F(Castor, ExpandsVariablesInComments) {
  auto file = system("SETVAR x=42\n#EXPAND the answer is %(x)\nCPP UM clock Clock\n");
  Process castor{command({"check", "--expand", file})};
  EXPECT_EQ(castor.wait(), 0);
  EXPECT_NE(castor.output().find("the answer is 42"), std::string::npos) << castor.output();
}

TEST_F(Castor, AMissingFileIsAnErrorNotACrash) {
  Process castor{command({"run", (folder / "nowhere.cast").string()})};
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_NE(castor.errors().find("nowhere.cast"), std::string::npos);
}

TEST_F(Castor, AClassCanBeNamedWithItsLibrary) {
  auto file = system("CPP UM clock Clock@" CASTOR_TEST_PLUGIN " --status 4\n");
  Process castor{{CASTOR_EXECUTABLE, "run", file}};
  EXPECT_EQ(castor.wait(), 4) << castor.errors();
}

TEST_F(Castor, LoggedTextNeitherDrivesTheTerminalNorPassesForOtherLines) {
  auto answer = ask({"run", system("CPP UM forger Forger\n")});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.errors, testing::HasSubstr("seen\\x1b[2J\n    12:00:00.000 error"));
}

TEST_F(Castor, OutputThatCannotBeWrittenIsAFailure) {
  auto file = system("CPP UM clock Clock\n");
  for (std::string how : {"check", "check --json"}) {
    Process shell{{"/bin/sh", "-c",
                   std::string{CASTOR_EXECUTABLE} + " --plugin " + CASTOR_TEST_PLUGIN + ' ' + how +
                     ' ' + file + " > /dev/full"}};
    EXPECT_NE(shell.wait(), 0) << how;
    EXPECT_THAT(shell.errors(), testing::HasSubstr("No space left")) << how;
  }
}

} // namespace

} // namespace castor::test
