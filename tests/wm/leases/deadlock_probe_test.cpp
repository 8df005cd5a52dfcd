#include "castor/wm/leases/deadlock_probe.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace castor {

namespace {

WaitEdge wait(const std::string& who, WaitNumber number, int since = 0) {
  WaitEdge result;
  result.waiter = std::make_shared<const Client>(Client{who, "a", 1});
  result.number = number;
  result.since = std::chrono::microseconds{since};
  result.address = {"a", "of-" + who};
  result.what = "waits to lock " + to_string(result.address);
  return result;
}

/// Sends a probe round two components that wait for each other; `second` is how the first one waits
/// when the probe is back.
ProbeVerdict round_trip(DeadlockProbe& probe, const WaitEdge& other, const WaitEdge& own) {
  probe.path.back().obstacle = 1;
  if (auto verdict = receive_probe(probe, other); verdict != ProbeVerdict::pass_on)
    return verdict;
  probe.path.back().obstacle = 2;
  return receive_probe(probe, own);
}

TEST(DeadlockProbes, GoRoundTwice) {
  auto ann = wait("ann", 1, 20);
  auto bob = wait("bob", 1, 10);
  DeadlockProbe probe{{ann}, 0};
  EXPECT_EQ(round_trip(probe, bob, ann), ProbeVerdict::pass_on);
  EXPECT_EQ(round_trip(probe, bob, ann), ProbeVerdict::deadlock);
  EXPECT_EQ(cycle_of(probe), "ann of a waits to lock a/of-ann, leased by bob of a; "
                             "bob of a waits to lock a/of-bob, leased by ann of a");
}

TEST(DeadlockProbes, OnlyTheYoungestOfACycleGoesOn) {
  auto ann = wait("ann", 1, 10);
  auto bob = wait("bob", 1, 20);
  DeadlockProbe probe{{ann}, 0};
  EXPECT_EQ(round_trip(probe, bob, ann), ProbeVerdict::drop);
}

TEST(DeadlockProbes, EquallyYoungWaitsAreToldApartByName) {
  auto ann = wait("ann", 1);
  auto bob = wait("bob", 1);
  DeadlockProbe of_ann{{ann}, 0};
  DeadlockProbe of_bob{{bob}, 0};
  EXPECT_EQ(round_trip(of_ann, bob, ann), ProbeVerdict::drop);
  EXPECT_EQ(round_trip(of_bob, ann, bob), ProbeVerdict::pass_on);
}

TEST(DeadlockProbes, AreDroppedByOneWhoWaitsForSomethingElseByNow) {
  auto ann = wait("ann", 1, 20);
  auto bob = wait("bob", 1, 10);
  DeadlockProbe probe{{ann}, 0};
  EXPECT_EQ(round_trip(probe, bob, wait("ann", 2, 30)), ProbeVerdict::drop);
}

TEST(DeadlockProbes, AWaitThatChangedBetweenTheRoundsIsNoDeadlock) {
  auto ann = wait("ann", 1, 20);
  DeadlockProbe probe{{ann}, 0};
  EXPECT_EQ(round_trip(probe, wait("bob", 1, 10), ann), ProbeVerdict::pass_on);
  EXPECT_EQ(round_trip(probe, wait("bob", 2, 11), ann), ProbeVerdict::drop);
}

TEST(DeadlockProbes, AnObstacleThatChangedBetweenTheRoundsIsNoDeadlock) {
  auto ann = wait("ann", 1, 20);
  auto bob = wait("bob", 1, 10);
  DeadlockProbe probe{{ann}, 0};
  EXPECT_EQ(round_trip(probe, bob, ann), ProbeVerdict::pass_on);
  probe.path.back().obstacle = 1;
  EXPECT_EQ(receive_probe(probe, bob), ProbeVerdict::pass_on);
  probe.path.back().obstacle = 3;
  EXPECT_EQ(receive_probe(probe, ann), ProbeVerdict::drop);
}

TEST(DeadlockProbes, OneThatRunsIntoACycleOfOthersEnds) {
  DeadlockProbe probe{{wait("out", 1, 99)}, 0};
  EXPECT_EQ(receive_probe(probe, wait("ann", 1)), ProbeVerdict::pass_on);
  EXPECT_EQ(receive_probe(probe, wait("bob", 1)), ProbeVerdict::pass_on);
  EXPECT_EQ(receive_probe(probe, wait("ann", 1)), ProbeVerdict::drop);
}

} // namespace

} // namespace castor
