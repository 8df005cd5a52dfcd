#include "castor/tests/tools/cli/nodes_fixture.hpp"

#include "castor/tests/support/relay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// What `Judge` ends a system with.
constexpr int all_done = 7;

/// Systems that lose processes and get them back.
class SupervisedSystems : public Nodes {
protected:
  /// `castor run`, with the hosts one and two on this machine. It ends after a while even if the
  /// system does not do what the test waits for.
  std::vector<std::string> run(const std::string& system,
                               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{
      "run",
      write("system.cast", "HOSTNAME one one.test\nHOSTNAME two two.test\n" + system),
      "--local-nodes",
      "--open-access",
      "--for",
      "60s"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return command(arguments);
  }

  /// A subarchitecture with a ticker, somebody who hears it, and a judge who waits for both.
  static std::string witnesses(int done, const std::string& where = "a") {
    return subarchitecture("a", "localhost") + "CPP UM judge Judge --count " +
           std::to_string(done) + "\nCPP UM witness Witness --where " + where + "\n";
  }

  /// The same over nodes that nobody starts again, and that are soon given up.
  std::vector<std::string> run_over(const std::vector<const Node*>& nodes,
                                    const std::string& system) {
    auto result = run_on(nodes, system, {"--lost-after", "300ms"});
    std::erase(result, "--no-restarts");
    return result;
  }

  /// For `WM` lines: every node can see it.
  std::string shared_journal() const {
    return "--journal full --journal-shared --journal-dir " + (folder / "journals").string();
  }

  static bool is_in_reach(const std::string& node) {
    Process ps{command({"ps", "--json"})};
    if (ps.wait() != 0)
      return false;
    auto report = json::parse(ps.output());
    return std::ranges::any_of(report["nodes"],
                               [&](auto& x) { return x["name"] == node && x["state"] == "up"; });
  }

  static std::optional<json> component_in_ps(const std::string& name) {
    Process ps{command({"ps", "--json"})};
    if (ps.wait() != 0)
      return std::nullopt;
    auto report = json::parse(ps.output());
    for (auto& x : report["components"])
      if (x["name"] == name)
        return x;
    return std::nullopt;
  }
};

/// The ways in which a component can end its process, or keep it for itself.
class Isolated : public SupervisedSystems, public testing::WithParamInterface<const char*> {};

TEST_P(Isolated, AComponentIsBackAndTheOthersHaveGoneOn) {
  Process castor{run(witnesses(2) +
                     "CPP UM ticker Ticker\nCPP UM shaky Shaky --isolate "
                     "--failures 2 --budget 300ms --memory-limit 100 --how " +
                     GetParam() + '\n')};
  EXPECT_EQ(castor.wait(), all_done) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("begins life 3"));
  EXPECT_THAT(castor.errors(), HasSubstr("is back after"));
  EXPECT_THAT(castor.output(), ContainsRegex("a\\.ticker +stopped +0 "));
}

INSTANTIATE_TEST_SUITE_P(SupervisedSystems, Isolated,
                         testing::Values("null", "abort", "allocate", "loop", "throw"),
                         [](auto& x) { return std::string{x.param}; });

TEST_F(SupervisedSystems, WhatANodeRanIsBackWithIt) {
  Process castor{run(witnesses(3, "b") + "CPP UM visitor Visitor\n" + subarchitecture("b", "one") +
                     "CPP UM ticker Ticker\nCPP UM shaky Shaky --how kill --diary a\n")};
  EXPECT_EQ(castor.wait(), all_done) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("was killed by signal 9"));
}

TEST_F(SupervisedSystems, WithAJournalItsEntriesAreBackToo) {
  // One whose diary is lost never gets beyond its first life.
  Process castor{run(
    subarchitecture("a", "localhost") + "CPP UM judge Judge\n" +
    subarchitecture("b", "one", "--journal full --journal-dir " + (folder / "journals").string()) +
    "CPP UM shaky Shaky --how kill --failures 2\n")};
  EXPECT_EQ(castor.wait(), all_done) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("begins life 3"));
}

TEST_F(SupervisedSystems, AComponentGoesWhereItsFailoverSays) {
  Process castor{run("FAILOVER shaky TO [two]\n" + subarchitecture("a", "localhost") +
                     "CPP UM ticker Ticker\n[one] CPP UM shaky Shaky --how kill\n")};
  ASSERT_TRUE(castor.wait_for_output("begins life 2")) << castor.errors();
  std::optional<json> shaky;
  EXPECT_TRUE(eventually([&] {
    shaky = component_in_ps("shaky");
    return shaky && (*shaky)["state"] == "running";
  }));
  EXPECT_EQ((*shaky)["node"], "two") << *shaky;
  EXPECT_EQ((*shaky)["restarts"], 1) << *shaky;
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
}

TEST_F(SupervisedSystems, AComponentGoesElsewhereThoughItsNodeStaysAway) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_over(
    {&one, &two},
    "FAILOVER shaky TO [two]\n" + subarchitecture("a", "localhost") +
      "CPP UM judge Judge\n[one] CPP UM shaky Shaky --how kill\n[one] CPP UM ticker Ticker\n")};
  EXPECT_EQ(castor.wait(), all_done) << castor.errors();
  EXPECT_TRUE(two.process->wait_for_output("begins life 2"));
  EXPECT_THAT(castor.errors(), HasSubstr("node one is lost: it could not be reached for 0.3 s"));
}

TEST_F(SupervisedSystems, AWorkingMemoryGoesToWhereItsJournalIsToo) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_over({&one, &two},
                          "FAILOVER b TO [two]\n" + subarchitecture("a", "localhost") +
                            "CPP UM judge Judge\n" + subarchitecture("b", "one", shared_journal()) +
                            "CPP UM shaky Shaky --how kill\n")};
  EXPECT_EQ(castor.wait(), all_done) << castor.errors();
  EXPECT_TRUE(two.process->wait_for_output("begins life 2")) << castor.errors();
}

TEST_F(SupervisedSystems, WhatIsCutOffGoesElsewhereWithAllThatWasAcknowledged) {
  const std::vector<std::string> witness{CASTOR_EXECUTABLE, "--plugin", CASTOR_WITNESS_PLUGIN};
  auto node = witness;
  node.emplace_back("node");
  auto one = start_node("one", node, {"--insecure"});
  auto two = start_node("two", node, {"--insecure"});
  Relay relay{one.port()};
  Node to_one{"one", nullptr, "127.0.0.1:" + std::to_string(relay.port())};
  auto acknowledged = (folder / "acknowledged").string();
  auto arguments = run_over(
    {&to_one, &two}, "FAILOVER b TO [two] [one]\n" + subarchitecture("b", "one", shared_journal()) +
                       "CPP UM witness Witness --kills 2 --file " + acknowledged + '\n');
  std::copy(witness.begin(), witness.end(), arguments.begin());
  arguments.emplace_back("--insecure");
  Process castor{std::move(arguments)};
  ASSERT_TRUE(eventually([&] { return read(acknowledged).size() > 500; })) << castor.errors();
  // It goes on writing, and noting what is acknowledged, for as long as it can.
  relay.refuse(true);
  ASSERT_TRUE(two.process->wait_for_output("life 2: 20 slots")) << castor.errors();
  ASSERT_TRUE(one.process->wait_for_output(" leaves system")) << one.process->errors();
  relay.refuse(false);
  ASSERT_TRUE(eventually([&] { return is_in_reach("one"); })) << castor.errors();
  two.process->send_signal(SIGKILL);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("all is there after 2 kills"));
  EXPECT_TRUE(one.process->wait_for_output("life 3: 20 slots"));
}

TEST_F(SupervisedSystems, OneThatNeverWorksEndsTheSystemWithItsReason) {
  Process castor{run("SUPERVISE * RESTARTS 2 IN 1min DELAY 1ms TO 2ms\n"
                     "SUPERVISE SYSTEM RESTARTS 1 IN 1min DELAY 1ms TO 2ms\n" +
                     subarchitecture("a", "localhost") + "CPP UM broken Broken\n" +
                     subarchitecture("b", "localhost") + "CPP UM ticker Ticker\n")};
  EXPECT_EQ(castor.wait(), 1) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("ended by the supervisor: broken has failed, and 2 "
                                         "restarts in 60s were allowed in a; so a has failed as a "
                                         "whole, and 1 restart in 60s were allowed in the system; "
                                         "broken failed in run(): the spring is gone"));
  EXPECT_THAT(castor.output(), ContainsRegex("a\\.broken +failed +5 "));
  EXPECT_THAT(castor.output(), HasSubstr("the spring is gone"));
  EXPECT_THAT(castor.output(), ContainsRegex("b\\.ticker +stopped +0 "));
}

TEST_F(SupervisedSystems, OneThatAlwaysCrashesEndsTheSystemToo) {
  Process castor{run("SUPERVISE * RESTARTS 1 IN 1min DELAY 1ms TO 2ms\n"
                     "SUPERVISE SYSTEM RESTARTS 1 IN 1min DELAY 1ms TO 2ms\n" +
                     subarchitecture("a", "localhost") +
                     "CPP UM shaky Shaky --isolate --how abort --failures 1000 --diary b\n" +
                     subarchitecture("b", "localhost"))};
  EXPECT_EQ(castor.wait(), 1) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("begins life 4"));
  EXPECT_THAT(castor.errors(), Not(HasSubstr("begins life 5")));
  EXPECT_THAT(castor.errors(), HasSubstr("a has failed as a whole"));
}

TEST_F(SupervisedSystems, AnInterruptIsNotHeldUpByARestart) {
  Process castor{run("SUPERVISE a RESTARTS 100 IN 1min DELAY 50s TO 50s\n" +
                     subarchitecture("a", "localhost") +
                     "CPP UM ticker Ticker\nCPP UM broken Broken\n")};
  // At once the first time, then after the delay.
  ASSERT_TRUE(eventually([] {
    auto broken = component_in_ps("broken");
    return broken && (*broken)["restarts"] == 1 && (*broken)["state"] == "restarting";
  }))
    << castor.errors();
  auto begin = std::chrono::steady_clock::now();
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 1) << castor.errors();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
  EXPECT_THAT(castor.errors(), HasSubstr("stopped, in this order: ticker, a_tm"));
  EXPECT_THAT(castor.output(), ContainsRegex("a\\.broken +failed +1 "));
}

TEST_F(SupervisedSystems, AnInterruptIsNotHeldUpByALostProcess) {
  Process castor{run(subarchitecture("a", "localhost") + "CPP UM ticker Ticker\n" +
                     "CPP UM shaky Shaky --isolate --how kill --failures 1000\n")};
  ASSERT_TRUE(castor.wait_for_output("begins life 2")) << castor.errors();
  castor.send_signal(SIGINT);
  castor.wait();
  EXPECT_THAT(castor.errors(), HasSubstr("ticker, a_tm"));
  EXPECT_THAT(castor.output(), ContainsRegex("a\\.ticker +stopped +0 "));
}

TEST_F(SupervisedSystems, WithoutRestartsEverybodyStaysDown) {
  Process castor{run(subarchitecture("a", "localhost") +
                       "CPP UM ticker Ticker\nCPP UM broken Broken\n"
                       "CPP UM shaky Shaky --isolate --how abort\n",
                     {"--no-restarts"})};
  ASSERT_TRUE(eventually([] {
    auto broken = component_in_ps("broken");
    auto shaky = component_in_ps("shaky");
    return broken && (*broken)["state"] == "failed" && shaky && (*shaky)["state"] == "failed";
  }))
    << castor.errors();
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 1) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("was killed by signal 6"));
  EXPECT_THAT(castor.errors(), Not(HasSubstr("begins life 2")));
  EXPECT_THAT(castor.output(), ContainsRegex("a\\.broken +failed +0 "));
  EXPECT_THAT(castor.output(), ContainsRegex("a\\.ticker +stopped +0 "));
}

} // namespace

} // namespace castor::test
