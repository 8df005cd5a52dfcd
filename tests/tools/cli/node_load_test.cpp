#include "castor/tests/tools/cli/nodes_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <regex>
#include <string>
#include <thread>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// How much of the process is in memory, MB.
int resident(const Process& x) {
  std::ifstream in{"/proc/" + std::to_string(x.pid()) + "/status"};
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("VmRSS:"))
      return std::stoi(line.substr(6)) / 1024;
  return 0;
}

/// The part of the output that the pattern's first group matches.
std::string find(Process& process, const std::string& pattern) {
  std::smatch found;
  auto text = process.errors();
  return std::regex_search(text, found, std::regex{pattern}) ? found[1].str() : "";
}

TEST_P(NodesEitherWay, LargeEntriesDoNotHoldUpSmallOnes) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two},
                        subarchitecture("a", "one") +
                          "CPP UM bulk Bulk --times 2 --deadline 60s\n" +
                          "CPP UM pedestrian Pedestrian\n" + subarchitecture("b", "two"),
                        {"--open-access"})};
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  std::cout << find(castor, "(the longest of .*)\n") << '\n';
  EXPECT_EQ(castor.errors().find("out of reach"), std::string::npos) << castor.errors();
}

TEST_F(Nodes, AnEntryThatIsLargerThanItsWorkingMemoryTakesIsRefused) {
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two},
                        subarchitecture("a", "one") +
                          "CPP UM judge Judge\nCPP UM bulk Bulk --megabytes 2\n" +
                          subarchitecture("b", "two", "--largest-entry 1"),
                        {"--open-access"})};
  EXPECT_EQ(castor.wait(), 7) << castor.errors();
  auto refusal = find(*one.process, "is refused: (.*)\n");
  for (auto part : {"b/bulk-0", "2097", "--largest-entry"})
    EXPECT_NE(refusal.find(part), std::string::npos) << refusal;
}

/// A flood from node one to node two, which is stopped meanwhile. By default 3 s;
/// CASTOR_FLOOD_SECONDS makes it longer.
class NodesUnderFlood : public NodesEitherWay {
protected:
  static std::chrono::seconds duration() {
    auto* wanted = std::getenv("CASTOR_FLOOD_SECONDS");
    return std::chrono::seconds{wanted ? std::atoi(wanted) : 3};
  }

  /// An option of what makes the flood: it goes on for longer than anybody is stopped.
  static std::string time() {
    return " --time " + std::to_string((duration() + 1s).count()) + "s\n";
  }

  void run(const std::string& system) {
    auto before_one = resident(*one.process);
    castor = std::make_unique<Process>(run_on({&one, &two}, system));
    ASSERT_TRUE(two.process->wait_for_output("hears the flood")) << castor->errors();
    auto before_castor = resident(*castor);
    int most_one = 0;
    int most_castor = 0;
    // After 30 s of silence a node would be given up.
    constexpr auto longest_stop = 20s;
    auto begin = Clock::now();
    for (auto i = 0s; i < duration(); ++i) {
      two.process->send_signal(i % (longest_stop + 1s) == longest_stop ? SIGCONT : SIGSTOP);
      std::this_thread::sleep_until(begin + i + 1s);
      most_one = std::max(most_one, resident(*one.process));
      most_castor = std::max(most_castor, resident(*castor));
      std::cout << (i + 1s).count() << " s: one " << resident(*one.process) << " MB, two "
                << resident(*two.process) << " MB, castor run " << resident(*castor) << " MB\n";
    }
    two.process->send_signal(SIGCONT);
    EXPECT_EQ(castor->wait(), 0) << castor->errors();
    std::cout << find(*one.process, "(made .* changes)") << ", " << find(*castor, "(heard .*)\n")
              << '\n';
    constexpr int allowed = 64;
    EXPECT_LT(most_one - before_one, allowed);
    EXPECT_LT(most_castor - before_castor, allowed);
  }

  Node one;
  Node two;
  std::unique_ptr<Process> castor;

private:
  void SetUp() override {
    NodesEitherWay::SetUp();
    one = start_node("one");
    two = start_node("two");
  }
};

TEST_P(NodesUnderFlood, EventsForAStoppedNodeCostNobodysMemory) {
  run(subarchitecture("a", "one") + "CPP UM flood Flood" + time() + subarchitecture("b", "two") +
      "CPP UM drain Drain --deadline 30s\n");
}

TEST_P(NodesUnderFlood, PushesToAStoppedNodeCostNobodysMemory) {
  run("COMPONENT [one] CPP flood PushFlood" + time() + subarchitecture("b", "two") +
      "CPP UM drain PushDrain\n");
  auto log = one.process->errors();
  auto said = log.find("b.drain does not keep up");
  EXPECT_NE(said, std::string::npos) << log;
  EXPECT_EQ(log.find("does not keep up", said + 10), std::string::npos) << log;
  EXPECT_NE(castor->output().find("of its pushes were dropped"), std::string::npos)
    << castor->output();
}

INSTANTIATE_TEST_SUITE_P(Nodes, NodesUnderFlood, testing::Bool(), encryption);

} // namespace

} // namespace castor::test
