#include "castor/tests/tools/linearizability/brute_force.hpp"
#include "castor/tests/tools/linearizability/random_history.hpp"
#include "castor/tools/linearizability/checker.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <iostream>

namespace castor::linearizability {

namespace {

std::string lines(const History& history) {
  std::string result;
  for (auto& x : history)
    result += to_string(x) + "\n";
  return result;
}

} // namespace

TEST(CheckerProperties, HistoriesOfTheModelPass) {
  Checker checker;
  int undecided = 0;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    Random random{seed};
    RandomHistoryOptions options;
    options.clients = 2 + seed % 15;
    options.entries = 1 + seed % 4;
    options.operations = 20 + seed % 120;
    options.width = seed % 7 * 20;
    options.overlaps = unsigned(seed % 3);
    auto verdict = checker.check(random_history(options, random));
    ASSERT_NE(verdict.kind, Verdict::Kind::violation) << "seed " << seed << "\n" << verdict.report;
    undecided += !verdict.ok();
  }
  // Many at once in many queues take long.
  EXPECT_LT(undecided, 10);
}

TEST(CheckerProperties, AgreesWithTryingEveryOrder) {
  Checker checker;
  int good = 0;
  int bad = 0;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
    Random random{seed};
    RandomHistoryOptions options;
    options.clients = 2 + seed % 3;
    options.entries = 1;
    options.operations = 7;
    options.width = seed % 4 * 25;
    options.overlaps = unsigned(seed % 5 * 15);
    options.deaths = options.lapses = options.time_outs = 6;
    auto history = random_history(options, random);
    if (history.empty() || history.size() > 7)
      continue;
    for (auto changes = seed % 3; changes > 0; --changes)
      falsify(history, random);
    auto verdict = checker.check(history);
    ASSERT_NE(verdict.kind, Verdict::Kind::undecided);
    ASSERT_EQ(verdict.ok(), linearizable_by_brute_force(history))
      << "seed " << seed << "\n"
      << lines(history) << verdict.report;
    ++(verdict.ok() ? good : bad);
  }
  EXPECT_GT(good, 20'000);
  EXPECT_GT(bad, 20'000);
  RecordProperty("good", good);
  RecordProperty("bad", bad);
}

/// Not a test: how long a history of a hundred operations takes.
TEST(CheckerProperties, DISABLED_Cost) {
  for (std::size_t clients : {4, 8, 16})
    for (std::size_t entries : {1, 3})
      for (bool wrong : {false, true}) {
        std::vector<History> histories;
        for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
          Random random{seed};
          histories.push_back(random_history({.clients = clients, .entries = entries}, random));
          if (wrong)
            falsify(histories.back(), random);
        }
        Checker checker;
        std::uint64_t states = 0;
        std::uint64_t most = 0;
        std::size_t operations = 0;
        std::size_t bad = 0;
        auto begin = std::chrono::steady_clock::now();
        for (auto& history : histories) {
          bad += !checker.check(history).ok();
          operations += history.size();
          states += checker.states();
          most = std::max(most, checker.states());
        }
        std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
        std::cout << clients << " clients, " << entries << " entries, "
                  << operations / histories.size()
                  << " operations: " << time.count() / double(histories.size()) << " us, "
                  << states / histories.size() << " states (at most " << most << "), " << bad
                  << " violations in " << histories.size() << "\n";
      }
}

} // namespace castor::linearizability
