#include "castor/tests/tools/cli/nodes_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using Clock = std::chrono::steady_clock;

/// How a process of Castor begins and ends, whatever its components do.
class Lifecycle : public Nodes {
protected:
  std::vector<std::string> run(const std::string& components,
                               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> result{"run", system(components), "--for", "60s"};
    result.insert(result.end(), more.begin(), more.end());
    return command(result);
  }

  std::string fifo() const {
    auto result = (folder / "fifo").string();
    EXPECT_EQ(mkfifo(result.c_str(), 0600), 0);
    return result;
  }

  /// Runs a line of the shell, in which $castor is the command.
  static Answer shell(const std::string& line) {
    std::string castor;
    for (auto& x : command({}))
      castor += x + ' ';
    Process bash{{"bash", "-c", "castor='" + castor + "'; " + line}};
    auto status = bash.wait();
    return {status, bash.output(), bash.errors()};
  }

  static int count(const std::string& in, const std::string& what) {
    int result = 0;
    for (std::size_t at = 0; (at = in.find(what, at)) != in.npos; ++at)
      ++result;
    return result;
  }

  /// Processes that this one has started.
  static std::vector<pid_t> children_of(pid_t parent) {
    std::vector<pid_t> result;
    const std::filesystem::path threads = "/proc/" + std::to_string(parent) + "/task";
    for (auto& thread : std::filesystem::directory_iterator{threads}) {
      std::ifstream in{thread.path() / "children"};
      for (pid_t x = 0; in >> x;)
        result.push_back(x);
    }
    return result;
  }

  /// Of processes whose command line has this text.
  static std::vector<pid_t> processes_with(const std::string& text) {
    std::vector<pid_t> result;
    for (auto& x : std::filesystem::directory_iterator{"/proc"}) {
      auto name = x.path().filename().string();
      if (name.find_first_not_of("0123456789") != name.npos)
        continue;
      std::ifstream in{x.path() / "cmdline"};
      const std::string line{std::istreambuf_iterator<char>{in}, {}};
      if (line.find(text) != line.npos)
        result.push_back(std::stoi(name));
    }
    return result;
  }
};

/// Where a component blocks.
class BlockedIn : public Lifecycle, public testing::WithParamInterface<const char*> {
protected:
  std::string phase() const { return GetParam(); }

  /// Waits until it blocks there.
  void await_block(Process& castor) const {
    if (phase() == "configure" || phase() == "start")
      ASSERT_TRUE(castor.wait_for_output("waiting for blocker to " + phase())) << castor.errors();
    else
      ASSERT_TRUE(castor.wait_for_output("runs")) << castor.errors();
  }
};

TEST_P(BlockedIn, OneInterruptEndsTheSystemAndTheOthersInOrder) {
  Process castor{run("CPP UM ticker Ticker\nCPP UM blocker Blocker --phase " + phase() + "\n")};
  await_block(castor);
  auto begin = Clock::now();
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 1) << castor.errors();
  EXPECT_LT(Clock::now() - begin, 5s);
  EXPECT_THAT(castor.errors(),
              AllOf(HasSubstr("blocker] did not stop"), HasSubstr("ticker, a_tm")));
}

TEST_P(BlockedIn, ASecondSignalEndsTheProcessAtOnce) {
  for (int second : {SIGINT, SIGTERM}) {
    Process castor{run("CPP UM blocker Blocker --phase " + phase() + " --shutdown 50s\n")};
    await_block(castor);
    castor.send_signal(SIGINT);
    ASSERT_TRUE(castor.wait_for_output("interrupted: stopping")) << castor.errors();
    // Two signals that come together are one.
    poll(nullptr, 0, 100);
    auto begin = Clock::now();
    castor.send_signal(second);
    EXPECT_EQ(castor.wait(), 128 + second) << castor.errors();
    EXPECT_LT(Clock::now() - begin, 2s);
    EXPECT_THAT(castor.errors(), HasSubstr("ended by force; still running: a.blocker in "));
  }
}

INSTANTIATE_TEST_SUITE_P(Lifecycle, BlockedIn, testing::Values("configure", "start", "run"),
                         [](auto& x) { return std::string{x.param}; });

TEST_F(Lifecycle, AnIsolatedOneIsKilledByTheSecondSignalToo) {
  Process castor{run("CPP UM blocker Blocker --phase configure --isolate --shutdown 50s\n")};
  ASSERT_TRUE(castor.wait_for_output("waiting for blocker to configure")) << castor.errors();
  auto isolated = children_of(castor.pid());
  ASSERT_FALSE(isolated.empty());
  castor.send_signal(SIGTERM);
  ASSERT_TRUE(castor.wait_for_output("interrupted: stopping")) << castor.errors();
  poll(nullptr, 0, 100);
  castor.send_signal(SIGTERM);
  EXPECT_EQ(castor.wait(), 128 + SIGTERM) << castor.errors();
  EXPECT_TRUE(eventually(
    [&] { return std::ranges::none_of(isolated, [](auto x) { return kill(x, 0) == 0; }); }));
}

TEST_F(Lifecycle, ANodeWithABlockedComponentEnds) {
  auto one = start_node("one");
  Process castor{run_on({&one}, subarchitecture("a", "one") + "CPP UM blocker Blocker\n")};
  ASSERT_TRUE(one.process->wait_for_output("runs")) << one.process->errors();
  one.process->send_signal(SIGINT);
  poll(nullptr, 0, 100);
  auto begin = Clock::now();
  one.process->send_signal(SIGINT);
  EXPECT_EQ(one.process->wait(), 128 + SIGINT);
  EXPECT_LT(Clock::now() - begin, 2s);
  castor.send_signal(SIGINT);
  castor.wait();
}

TEST_F(Lifecycle, CheckNamesADestructorThatBlocks) {
  auto x = ask({"check", system("CPP UM blocker Blocker --phase destructor\n")});
  EXPECT_EQ(x.status, 1);
  EXPECT_THAT(x.errors, AllOf(HasSubstr("system.cast:5: error: Blocker of blocker"),
                              HasSubstr("the destructor does not return within 5 s")));
}

TEST_F(Lifecycle, NamedPipesAreRefusedWhereverAFileIsMeant) {
  auto pipe = fifo();
  const std::vector<std::vector<std::string>> commands{
    {"check", pipe},
    {"run", pipe},
    {"run", CASTOR_CONFIGS "/playmate.cast", "--set", "words=" + pipe},
    {"run", CASTOR_CONFIGS "/playmate.cast", "--set", "calibration=" + pipe},
    {"run", CASTOR_CONFIGS "/playmate.cast", "--set", "source=" + pipe},
    {"run", CASTOR_CONFIGS "/playmate.cast", "--set", "source=scene:" + pipe},
    {"run", CASTOR_CONFIGS "/playmate.cast", "--set", "background=" + pipe},
    {"journal", "show", pipe},
    {"journal", "replay", pipe, "--config", CASTOR_CONFIGS "/playmate.cast"},
    {"journal", "export", pipe, "--jsonl", "-"},
    {"chaos", CASTOR_CONFIGS "/playmate.cast", "--plan", pipe},
    {"--plugin", pipe, "components"},
  };
  for (auto& x : commands) {
    auto begin = Clock::now();
    auto answer = ask(x);
    EXPECT_THAT(answer.status, testing::AnyOf(1, 2)) << testing::PrintToString(x);
    EXPECT_LT(Clock::now() - begin, 20s) << testing::PrintToString(x);
    EXPECT_THAT(answer.errors,
                testing::AnyOf(HasSubstr("named pipe"), HasSubstr("neither a file nor a folder")))
      << testing::PrintToString(x);
  }
}

TEST_F(Lifecycle, AnIsolatedComponentThatDoesNotStopIsKilledAndStartedAgainWithTheOthers) {
  // The blocker never stops of itself, and the other one takes it along whenever it fails.
  Process castor{command(
    {"run",
     write("system.cast", "SUPERVISE a one_for_all RESTARTS 100 IN 1s DELAY 1ms TO 2ms\n"
                          "SUBARCHITECTURE a localhost\nCPP WM SubarchitectureWorkingMemory\n"
                          "CPP TM AlwaysPositiveTaskManager\n"
                          "CPP UM blocker Blocker --isolate --shutdown 500ms --budget 1h\n"
                          "CPP UM thrower Blocker --phase late --how throw\n"),
     "--for", "60s"})};
  ASSERT_TRUE(castor.wait_for_output("blocker] did not stop: it has not returned from its own "
                                     "code; its process is killed"))
    << castor.errors();
  ASSERT_TRUE(eventually([&] { return count(castor.errors(), "a.blocker] runs") >= 3; }))
    << castor.errors();
  EXPECT_THAT(castor.errors(), Not(HasSubstr("is not started again")));
  castor.send_signal(SIGINT);
  // In the end it has to be killed once more.
  EXPECT_EQ(castor.wait(), 1) << castor.errors();
}

TEST_F(Lifecycle, TheStatusTellsOfAnIsolatedComponentThatHadToBeKilled) {
  auto x =
    ask({"run", system("CPP UM blocker Blocker --isolate --shutdown 300ms\n"), "--for", "1s"});
  EXPECT_EQ(x.status, 1) << x.errors;
  EXPECT_THAT(x.errors, HasSubstr("its process is killed"));
}

/// What an isolated component can do to its process so that it neither answers nor ends.
class Unreachable : public Lifecycle, public testing::WithParamInterface<const char*> {};

TEST_P(Unreachable, ItsProcessIsKilledAndAnotherTakesItsPlace) {
  Process castor{
    command({"run",
             write("system.cast",
                   "SUPERVISE a RESTARTS 100 IN 1s\n" + subarchitecture("a", "localhost") +
                     "CPP UM blocker Blocker --isolate --how " + std::string{GetParam()} + "\n"),
             "--for", "60s", "--lost-after", "1s"})};
  ASSERT_TRUE(castor.wait_for_output("blocker] does not answer; its process is killed"))
    << castor.errors();
  EXPECT_TRUE(castor.wait_for_output("blocker] is back after")) << castor.errors();
  castor.send_signal(SIGINT);
  castor.wait();
}

INSTANTIATE_TEST_SUITE_P(Lifecycle, Unreachable, testing::Values("stop", "close"),
                         [](auto& x) { return std::string{x.param}; });

TEST_F(Lifecycle, ALocalNodeThatIsStoppedIsKilledAndBack) {
  auto arguments =
    command({"run",
             write("system.cast", "HOSTNAME one one.test\n" + subarchitecture("a", "one") +
                                    "CPP UM blocker Blocker --phase never\n"),
             "--local-nodes", "--lost-after", "1s", "--for", "60s"});
  Process castor{std::move(arguments)};
  ASSERT_TRUE(castor.wait_for_output("a.blocker] runs")) << castor.errors();
  for (auto x : children_of(castor.pid()))
    kill(x, SIGSTOP);
  ASSERT_TRUE(castor.wait_for_output("blocker] is back after")) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("one] does not answer; its process is killed"));
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
}

TEST_F(Lifecycle, AnOutputThatNobodyReadsEndsTheSystemInOrder) {
  auto file = system("CPP UM ticker Ticker\n");
  auto x = shell("$castor run " + file + " --trace --for 60s | head -1; exit ${PIPESTATUS[0]}");
  EXPECT_EQ(x.status, 0) << x.errors;
  EXPECT_THAT(x.errors, AllOf(HasSubstr("nobody reads the output any more: stopping"),
                              HasSubstr("stopped, in this order: ticker, a_tm")));
}

TEST_F(Lifecycle, AShortCommandEndsWithItsOutputAsUsual) {
  auto x = shell("$castor components --json | true; exit ${PIPESTATUS[0]}");
  EXPECT_THAT(x.status, testing::AnyOf(0, 128 + SIGPIPE));
  EXPECT_EQ(x.errors, "");
}

TEST_F(Lifecycle, WithoutStandardDescriptorsASystemRuns) {
  auto file = system("CPP UM ticker Ticker\nCPP UM listener Listener --count 3 --isolate\n");
  for (std::string closed : {">&-", "2>&-", "<&-", ">&- 2>&- <&-"}) {
    auto x = shell("$castor run " + file + " --for 2s " + closed);
    EXPECT_EQ(x.status, 0) << closed << x.errors;
  }
}

/// Ways for a component to end the process.
class ExitBy : public Lifecycle, public testing::WithParamInterface<const char*> {};

TEST_P(ExitBy, TheComponentIsNamedAndTheStatusIsNotZero) {
  auto x = ask({"run", system("CPP UM blocker Blocker --how " + std::string{GetParam()} + "\n"),
                "--for", "60s"});
  EXPECT_EQ(x.status, 1);
  EXPECT_THAT(x.errors, AllOf(HasSubstr("in component a.blocker (class Blocker, "),
                              HasSubstr("system.cast:5), in run()"), HasSubstr("--isolate")));
}

INSTANTIATE_TEST_SUITE_P(Lifecycle, ExitBy, testing::Values("exit", "quick_exit", "_exit"),
                         [](auto& x) {
                           std::string name{x.param};
                           return name == "_exit" ? "underscore_exit" : name;
                         });

TEST_F(Lifecycle, WhatAnIsolatedComponentHasStartedEndsWithIt) {
  // A number of seconds that nobody else sleeps.
  auto seconds = std::to_string(100'000 + getpid());
  Process castor{run("CPP UM blocker Blocker --isolate --how daemon --seconds " + seconds + "\n")};
  ASSERT_TRUE(eventually([&] {
    auto all = processes_with(seconds);
    return std::ranges::any_of(all, [](auto x) { return getpgid(x) == getsid(x); }) && !all.empty();
  }))
    << castor.errors();
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_TRUE(eventually([&] { return shell("pgrep -f '^sleep " + seconds + "'").status != 0; }));
}

TEST_F(Lifecycle, WhoPullsFromACameraThatIsStartedAgainWaitsForIt) {
  auto file =
    write("system.cast",
          "SUPERVISE SYSTEM RESTARTS 100 IN 1s DELAY 1s TO 1s\n"
          "COMPONENT CPP provider Provider --isolate\n"
          "SUBARCHITECTURE a localhost\nCPP WM SubarchitectureWorkingMemory\n"
          "CPP TM AlwaysPositiveTaskManager\nCPP UM puller Puller --from provider --count 300\n");
  Process castor{command({"run", file, "--for", "60s"})};
  for (int kills = 0; kills < 3; ++kills) {
    ASSERT_TRUE(eventually([&] { return count(castor.errors(), "provider] provides") > kills; }))
      << castor.errors();
    for (auto x : children_of(castor.pid()))
      kill(x, SIGKILL);
  }
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_THAT(castor.errors(),
              AllOf(HasSubstr("has pulled enough"), Not(HasSubstr("COMPONENT line")),
                    Not(HasSubstr("puller] failed"))));
}

} // namespace

} // namespace castor::test
