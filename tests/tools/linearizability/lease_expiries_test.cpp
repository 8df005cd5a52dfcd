#include "castor/tools/linearizability/lease_expiries.hpp"

#include "castor/tests/tools/linearizability/records.hpp"
#include "castor/tools/linearizability/checker.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace castor::linearizability {

namespace {

constexpr Tick duration = 100;
constexpr Tick end = 1000;

/// Two clients lock one entry, the second while nobody has given it back.
History two_locks(Tick second) {
  return {add(1, 7, {1, 2}, at_version(0)), lock(1, LockLevel::o, {10, 20}, obtained(1)),
          lock(2, LockLevel::o, {second, second + 5}, obtained(2))};
}

Verdict::Kind verdict(History history, const std::map<Client, Tick>& ends = {}) {
  std::ranges::copy(possible_lease_expiries(history, duration, ends, end),
                    std::back_inserter(history));
  return Checker{}.check(history).kind;
}

} // namespace

TEST(PossibleLapses, LetALeaseRunOutNoSoonerThanItCan) {
  EXPECT_EQ(verdict(two_locks(104)), Verdict::Kind::violation);
  EXPECT_EQ(verdict(two_locks(106)), Verdict::Kind::ok);
}

TEST(PossibleLapses, EndLeasesOfThoseWhoLeft) {
  EXPECT_EQ(verdict(two_locks(50), {{1, 60}}), Verdict::Kind::violation);
  EXPECT_EQ(verdict(two_locks(50), {{1, 50}}), Verdict::Kind::ok);
}

TEST(PossibleLapses, EndWhatNobodyKnowsToHaveBeenObtained) {
  auto history = two_locks(50);
  history[1].returned = never;
  EXPECT_EQ(verdict(history), Verdict::Kind::ok);
}

TEST(PossibleLapses, CountFromTheFirstOfSeveralLocks) {
  auto history = two_locks(104);
  history.push_back(lock(1, LockLevel::o, {30, 40}, obtained(1)));
  EXPECT_EQ(verdict(history), Verdict::Kind::violation);
  EXPECT_EQ(possible_lease_expiries(history, duration, {}, end).size(), 2u);
}

TEST(PossibleLapses, DoNotComeAfterTheEnd) {
  EXPECT_TRUE(possible_lease_expiries(two_locks(end), duration, {}, 50).empty());
}

} // namespace castor::linearizability
