#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <csignal>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Systems whose working memory keeps a journal.
class JournalCommand : public Castor {
protected:
  static std::vector<json> objects(const std::vector<std::string>& arguments) {
    auto answer = ask(arguments);
    EXPECT_EQ(answer.status, 0) << answer.errors;
    return json_lines(answer.output);
  }

  std::string journaled(const std::string& components, const std::string& options = "full") const {
    return write("journaled.cast",
                 "HOST localhost\nSUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory "
                 "--journal " +
                   options + " --journal-dir " + (folder / "journals").string() +
                   "\nCPP TM AlwaysPositiveTaskManager\n" + components);
  }

  std::string journal() const { return (folder / "journals/a.castor-journal").string(); }

  /// Of the type Tick, whatever their ids.
  std::vector<int> numbers() const {
    std::vector<int> result;
    for (auto& x : objects({"journal", "show", journal(), "Tick", "--entries", "--json"}))
      result.push_back(x["value"]["number"]);
    return result;
  }
};

TEST_F(JournalCommand, AJournalThatMayNotGrowAnyFurtherIsAnErrorThatIsReported) {
  auto file = journaled("CPP UM clock Clock --count 1000000\n");
  auto castor = command({"run", file, "--for", "20s"});
  castor.insert(castor.begin(), {"sh", "-c", "ulimit -f 200; exec \"$0\" \"$@\""});
  Process shell{castor};
  EXPECT_EQ(shell.wait(), 1) << shell.errors();
  EXPECT_THAT(shell.errors(), HasSubstr("journals/a.castor-journal of a cannot be written"));
  EXPECT_THAT(shell.errors(), Not(HasSubstr("runtime_error")));
}

TEST_F(JournalCommand, EntriesOutliveTheSystemAndIdsAreNotUsedAgain) {
  auto file = journaled("CPP UM clock Clock --status 0\n", "batched");
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(ask({"run", file}).status, 0);
  EXPECT_THAT(numbers(), ElementsAre(3, 3));
  auto found = objects({"journal", "ls", (folder / "journals").string(), "--json"});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0]["subarchitecture"], "a");
  EXPECT_EQ(found[0]["changes"], 8);
  EXPECT_EQ(found[0]["session"], 2);
  EXPECT_EQ(found[0]["incarnation"], 0);
  EXPECT_EQ(found[0]["clean"], true);
}

TEST_F(JournalCommand, EntriesOutliveAProcessThatIsKilled) {
  auto file = journaled("CPP UM ticker Ticker\n");
  std::size_t changes = 0;
  {
    Process castor{command({"run", file, "--trace"})};
    ASSERT_TRUE(castor.wait_for_output("v5\n"));
    castor.send_signal(SIGKILL);
    castor.wait();
  }
  changes = objects({"journal", "show", journal(), "--json"}).size();
  EXPECT_GE(changes, 6u);
  EXPECT_EQ(numbers().front(), static_cast<int>(changes) - 1);
}

TEST_F(JournalCommand, IsNotWrittenByASecondSystemMeanwhile) {
  auto file = journaled("CPP UM ticker Ticker\n");
  Process first{command({"run", file, "--trace"})};
  ASSERT_TRUE(first.wait_for_output("v1\n"));
  auto second = ask({"run", file});
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.errors, HasSubstr("journaled.cast:3"));
  EXPECT_THAT(second.errors, HasSubstr("system journaled-" + std::to_string(first.pid())));
  EXPECT_THAT(second.errors, HasSubstr("process " + std::to_string(first.pid())));
  first.send_signal(SIGINT);
  EXPECT_EQ(first.wait(), 0) << first.errors();
}

TEST_F(JournalCommand, ThatIsRemovedEndsTheSystemWithTheReason) {
  Process castor{command({"run", journaled("CPP UM ticker Ticker\n"), "--trace"})};
  ASSERT_TRUE(castor.wait_for_output("v1\n"));
  std::filesystem::remove_all(folder / "journals");
  EXPECT_NE(castor.wait(), 0);
  EXPECT_THAT(castor.errors(), HasSubstr("removed or moved"));
  EXPECT_FALSE(std::filesystem::exists(journal()));
}

TEST_F(JournalCommand, ThatIsRemovedIsDoneWithoutIfTheWorkingMemoryIsToGoOn) {
  Process castor{command(
    {"run", journaled("CPP UM ticker Ticker\n", "full --journal-failure continue"), "--trace"})};
  ASSERT_TRUE(castor.wait_for_output("v1\n"));
  std::filesystem::remove_all(folder / "journals");
  ASSERT_TRUE(castor.wait_for_output("removed or moved"));
  ASSERT_TRUE(castor.wait_for_output("v40\n"));
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
}

TEST_F(JournalCommand, ShowsWhatAFilterAsksFor) {
  EXPECT_EQ(ask({"run", journaled("CPP UM clock Clock --status 0\n")}).status, 0);
  auto changes =
    objects({"journal", "show", journal(), "overwritten", "Tick", "where", "number > 1", "--json"});
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[1]["value"]["number"], 3);
  EXPECT_EQ(changes[1]["component"], "clock");
  EXPECT_THAT(ask({"journal", "show", journal()}).output, HasSubstr("OVERWRITE"));
  EXPECT_THAT(ask({"journal", "ls", (folder / "journals").string()}).output, HasSubstr("clean"));
}

TEST_F(JournalCommand, SaysWhichLineTheJournalIsOfThatCannotBeOpened) {
  std::filesystem::create_directories(folder / "journals");
  write("journals/a.castor-journal", "something else");
  auto answer = ask({"run", journaled("CPP UM clock Clock\n")});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, HasSubstr("journaled.cast:3"));
  EXPECT_THAT(answer.errors, HasSubstr(journal()));
  answer =
    ask({"run", journaled("CPP UM clock Clock --status 0\n", "full --journal-failure continue")});
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.errors, HasSubstr(".corrupt-1"));
}

TEST_F(JournalCommand, ReplaysIntoASystemWithoutItsSensors) {
  EXPECT_EQ(ask({"run", journaled("CPP UM clock Clock --status 0\n")}).status, 0);
  auto other = write("other.cast", "HOST localhost\nSUBARCHITECTURE a\n"
                                   "CPP WM SubarchitectureWorkingMemory\n"
                                   "CPP TM AlwaysPositiveTaskManager\n"
                                   "CPP UM clock Clock --count 100\n"
                                   "CPP UM pair Broken --restart temporary\n");
  auto answer = ask({"journal", "replay", journal(), "--config", other, "--speed", "max"});
  // A component has failed.
  EXPECT_EQ(answer.status, 1) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("4 writes replayed, 0 skipped"));
  // The clock is left out, the other component is not.
  EXPECT_THAT(answer.output, testing::Not(HasSubstr("a.clock")));
  EXPECT_THAT(answer.output, HasSubstr("a.pair"));
}

TEST_F(JournalCommand, ReplaysIntoARunningSystem) {
  EXPECT_EQ(ask({"run", journaled("CPP UM clock Clock --status 0\n")}).status, 0);
  Process target{command({"run", system("CPP UM ticker Ticker\n"), "--trace"})};
  ASSERT_TRUE(target.wait_for_output("v1\n"));
  auto answer = ask({"journal", "replay", journal(), "--into", "system", "--speed", "1"});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("4 writes replayed"));
  EXPECT_TRUE(target.wait_for_output(" clock  "));
}

TEST_F(JournalCommand, ExportsWhatOthersCanRead) {
  EXPECT_EQ(ask({"run", journaled("CPP UM pair Pair\nCPP UM clock Clock\n")}).status, 0);
  auto mcap = (folder / "out.mcap").string();
  auto jsonl = (folder / "out.jsonl").string();
  auto answer = ask({"journal", "export", journal(), "--mcap", mcap, "--jsonl", jsonl});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  std::istringstream lines{read(jsonl)};
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_EQ(json::parse(line)["type"], "Tick");
  EXPECT_GE(count, 2);
  auto written = json_lines(
    ask({"journal", "export", journal(), "--mcap", mcap, "--jsonl", jsonl, "--json"}).output);
  ASSERT_EQ(written.size(), 2U);
  EXPECT_EQ(written[0], (json{{"file", mcap},
                              {"format", "mcap"},
                              {"changes", count},
                              {"values", 0},
                              {"bytes", std::filesystem::file_size(mcap)}}));
  EXPECT_EQ(written[1]["file"], jsonl);
  // What is exported stands alone on standard output.
  EXPECT_EQ(
    json_lines(ask({"journal", "export", journal(), "--jsonl", "-", "--json"}).output).size(),
    static_cast<std::size_t>(count));
  Process probe{{"node", "-e", "require('@mcap/core')"}};
  if (probe.wait() != 0)
    GTEST_SKIP() << "node does not find @mcap/core (npm install @mcap/core; NODE_PATH)";
  Process reader{{"node", CASTOR_READ_MCAP, mcap}};
  EXPECT_EQ(reader.wait(), 0) << reader.errors();
  EXPECT_THAT(reader.output(), HasSubstr(std::to_string(count) + " messages, 1 topics"));
  EXPECT_THAT(reader.output(), HasSubstr(std::to_string(count) + " of Tick on /a/Tick"));
}

} // namespace

} // namespace castor::test
