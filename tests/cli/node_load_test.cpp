#include "nodes_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
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

/// By default 3 s; CASTOR_FLOOD_SECONDS makes it longer.
TEST_P(NodesEitherWay, AFloodAgainstAStoppedNodeCostsNobodysMemory) {
  auto* wanted = std::getenv("CASTOR_FLOOD_SECONDS");
  auto seconds = wanted ? std::atoi(wanted) : 3;
  auto one = start_node("one");
  auto two = start_node("two");
  Process castor{run_on({&one, &two}, subarchitecture("a", "one") + "CPP UM flood Flood --time " +
                                        std::to_string(seconds + 1) + "s\n" +
                                        subarchitecture("b", "two") +
                                        "CPP UM drain Drain --deadline 30s\n")};
  ASSERT_TRUE(two.process->wait_for_output("hears the flood")) << castor.errors();
  auto begin = Clock::now();
  auto before_one = resident(*one.process);
  auto before_castor = resident(castor);
  int most_one = 0;
  int most_castor = 0;
  // After 30 s of silence a node would be given up.
  constexpr auto longest_stop = 20s;
  for (auto i = 0s; i < std::chrono::seconds{seconds}; ++i) {
    two.process->send_signal(i % (longest_stop + 1s) == longest_stop ? SIGCONT : SIGSTOP);
    std::this_thread::sleep_until(begin + i + 1s);
    most_one = std::max(most_one, resident(*one.process));
    most_castor = std::max(most_castor, resident(castor));
    std::cout << (i + 1s).count() << " s: one " << resident(*one.process) << " MB, two "
              << resident(*two.process) << " MB, castor run " << resident(castor) << " MB\n";
  }
  two.process->send_signal(SIGCONT);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
  std::cout << find(*one.process, "(made .* changes)") << ", " << find(castor, "(heard .* merged)")
            << '\n';
  constexpr int allowed = 32;
  EXPECT_LT(most_one - before_one, allowed);
  EXPECT_LT(most_castor - before_castor, allowed);
}

} // namespace

} // namespace castor::test
