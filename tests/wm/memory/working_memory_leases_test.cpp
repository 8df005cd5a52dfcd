#include "castor/tests/wm/memory/working_memories.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A stand-in for a component that locks and reads, and keeps what it was answered.
struct Claimant {
  caf::actor actor;
  ClientPtr client;
  std::vector<Outcome<Lease>> leases;
  std::vector<Outcome<EntryPtr>> reads;
  std::vector<Outcome<std::vector<EntryPtr>>> queries;
  std::vector<Outcome<Acknowledged>> unlocks;
  std::vector<Outcome<Version>> writes;
  std::vector<DeadlockProbe> probes;
  std::vector<LeaseOffer> offers;
  WaitNumber numbers = 0;
};

class WorkingMemoryLeases : public WorkingMemories {
protected:
  ~WorkingMemoryLeases() override {
    for (auto& x : claimants)
      caf::anon_send_exit(x->actor, caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  Claimant& claimant(const std::string& name, const std::string& of = "a") {
    auto& result = *claimants.emplace_back(std::make_unique<Claimant>());
    result.client = std::make_shared<const Client>(Client{name, of, 1});
    result.actor = system.spawn([&result](caf::event_based_actor*) -> caf::behavior {
      return {[&](const Outcome<Lease>& x) { result.leases.push_back(x); },
              [&](const Outcome<EntryPtr>& x) { result.reads.push_back(x); },
              [&](const Outcome<std::vector<EntryPtr>>& x) { result.queries.push_back(x); },
              [&](const Outcome<Acknowledged>& x) { result.unlocks.push_back(x); },
              [&](const Outcome<Version>& x) { result.writes.push_back(x); },
              [&](const DeadlockProbe& x) { result.probes.push_back(x); },
              [&](const LeaseOffer& x) { result.offers.push_back(x); }};
    });
    return result;
  }

  template <class Request>
  void tell(Claimant& who, const Request& request, const std::string& via = "a") {
    caf::send_as(who.actor, wm.at(via), request);
    scheduler.run();
  }

  Patience patience(Claimant& who, Timestamp at_most = 10s) {
    return {who.client, ++who.numbers, at_most};
  }

  void lock(Claimant& who, LockLevel level, Timestamp at_most = 10s, const Address& at = {"a", "x"},
            const std::string& via = "a") {
    tell(who, LockRequest{at, level, patience(who, at_most)}, via);
  }

  void lock_by_claim(Claimant& who, const std::string& via = "a") {
    tell(who, LockRequest{{"a", "x"}, LockLevel::odr, patience(who), true}, via);
  }

  void claim(Claimant& who, const std::string& via = "a") {
    tell(who, ClaimLease{who.offers.back().address, who.client, who.offers.back().number}, via);
  }

  /// The token of the last lease that was granted.
  static LeaseToken token(const Claimant& who) { return (*who.leases.back()).token; }

  void unlock(Claimant& who, const Address& at = {"a", "x"}) {
    tell(who, UnlockRequest{at, who.client, token(who)});
  }

  void read(Claimant& who, const std::string& via = "a") {
    tell(who, ReadRequest{{"a", "x"}, patience(who)}, via);
  }

  /// The failure, if the write was refused.
  std::optional<Failure> overwrite_as(Claimant& who, Version last_seen, LeaseToken with) {
    tell(who, WriteRequest{
                Operation::overwrite, {"a", "x"}, Value::of(Item{7}), last_seen, who.client, with});
    auto& outcome = who.writes.back();
    return outcome ? std::nullopt : std::optional{outcome.failure()};
  }

  void let_pass(Timestamp time) {
    scheduler.advance_time(time);
    scheduler.run();
  }

  std::vector<std::unique_ptr<Claimant>> claimants;
};

TEST_F(WorkingMemoryLeases, AreGrantedInTurn) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::o);
  lock(bob, LockLevel::o);
  ASSERT_EQ(ann.leases.size(), 1u);
  EXPECT_EQ(bob.leases.size(), 0u);
  unlock(ann);
  ASSERT_EQ(bob.leases.size(), 1u);
  EXPECT_GT(token(bob), token(ann));
}

TEST_F(WorkingMemoryLeases, AreAskedForAndGrantedThroughAnyWorkingMemory) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob", "c");
  lock(ann, LockLevel::odr);
  lock(bob, LockLevel::o, 10s, {"a", "x"}, "c");
  EXPECT_EQ(bob.leases.size(), 0u);
  unlock(ann);
  EXPECT_EQ(bob.leases.size(), 1u);
}

TEST_F(WorkingMemoryLeases, AreOfferedToClientsThatClaimThemThroughAnyWorkingMemory) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob", "c");
  lock(ann, LockLevel::odr);
  lock_by_claim(bob, "c");
  unlock(ann);
  ASSERT_EQ(bob.offers.size(), 1u);
  EXPECT_EQ(bob.leases.size(), 0u);
  lock(ann, LockLevel::odr);
  ASSERT_EQ(ann.leases.size(), 2u) << "ann overtakes bob, who is not awake";
  unlock(ann);
  claim(bob, "c");
  ASSERT_EQ(bob.leases.size(), 1u);
  EXPECT_GT(token(bob), token(ann));
  EXPECT_EQ(bob.offers.size(), 1u);
}

TEST_F(WorkingMemoryLeases, AreGrantedToWhoWasOvertakenForHalfAMillisecond) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::odr);
  lock_by_claim(bob);
  unlock(ann);
  let_pass(499us);
  lock(ann, LockLevel::odr);
  EXPECT_EQ(ann.leases.size(), 2u);
  unlock(ann);
  EXPECT_EQ(bob.leases.size(), 0u);
  let_pass(1us);
  EXPECT_EQ(bob.leases.size(), 1u) << "by the working memory's own alarm";
  lock(ann, LockLevel::odr);
  EXPECT_EQ(ann.leases.size(), 2u);
}

TEST_F(WorkingMemoryLeases, AreGrantedTogetherToWhoAsksAgainForAFreeEntry) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::o);
  lock_by_claim(bob);
  unlock(ann);
  EXPECT_EQ(bob.leases.size(), 0u) << "bob was only offered it";
  lock(bob, LockLevel::od, 100us);
  let_pass(100us);
  ASSERT_EQ(bob.leases.size(), 2u);
  ASSERT_TRUE(bob.leases[0] && bob.leases[1]) << "no wait for an entry that is free times out";
  EXPECT_EQ(bob.leases[0]->token, bob.leases[1]->token);
}

TEST_F(WorkingMemoryLeases, AreGrantedToTheFirstWhenOneBehindAsksAgainForAFreeEntry) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  auto& cid = claimant("cid");
  lock(ann, LockLevel::o);
  lock_by_claim(bob);
  lock_by_claim(cid);
  unlock(ann);
  lock(cid, LockLevel::od, 0s);
  ASSERT_EQ(cid.leases.size(), 1u);
  EXPECT_THAT(cid.leases[0].failure().message, HasSubstr("bob of a holds a lease"));
  ASSERT_EQ(bob.leases.size(), 1u);
  EXPECT_TRUE(bob.leases[0]);
}

TEST_F(WorkingMemoryLeases, ATryIsRefusedAtOnceAndSaysWhoHoldsIt) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::od);
  lock(bob, LockLevel::o, 0s);
  ASSERT_EQ(bob.leases.size(), 1u);
  EXPECT_EQ(bob.leases[0].failure().kind, FailureKind::leased);
  EXPECT_THAT(bob.leases[0].failure().message,
              HasSubstr("ann of a holds a lease of level OD on it"));
}

TEST_F(WorkingMemoryLeases, NobodyLocksWhatIsNotThere) {
  auto& ann = claimant("ann");
  lock(ann, LockLevel::o);
  EXPECT_EQ(ann.leases.at(0).failure().kind, FailureKind::does_not_exist);
}

TEST_F(WorkingMemoryLeases, KeepOthersFromWriting) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::o);
  auto refused = overwrite_as(bob, 0, 0);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->kind, FailureKind::leased);
  EXPECT_THAT(refused->message, AllOf(HasSubstr("bob of a cannot overwrite a/x"),
                                      HasSubstr("ann of a holds a lease of level O")));
  EXPECT_FALSE(overwrite_as(ann, 0, token(ann)));
}

TEST_F(WorkingMemoryLeases, AStaleTokenIsRefusedAfterExpiry) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  lock(ann, LockLevel::o);
  let_pass(2s);
  auto refused = overwrite_as(ann, 0, token(ann));
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->kind, FailureKind::lease_lost);
  EXPECT_THAT(refused->message, HasSubstr("nobody holds one"));
}

TEST_F(WorkingMemoryLeases, ExpiryIsSeenEvenBeforeTheAlarmClockRings) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::o);
  // The write is in the mailbox before the alarm is.
  caf::send_as(bob.actor, wm.at("a"),
               WriteRequest{Operation::overwrite, {"a", "x"}, Value::of(Item{7}), 0, bob.client});
  scheduler.advance_time(3s);
  scheduler.run();
  EXPECT_TRUE(bob.writes.at(0));
}

TEST_F(WorkingMemoryLeases, RenewalKeepsThem) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  lock(ann, LockLevel::o);
  for (int i = 0; i < 5; ++i) {
    let_pass(1500ms);
    EXPECT_TRUE(
      ask<RenewReply>(wm.at("a"), RenewRequest{ann.client, {{"x", token(ann)}}}).lost.empty());
  }
  EXPECT_FALSE(overwrite_as(ann, 0, token(ann)));
  let_pass(2s);
  EXPECT_EQ(ask<RenewReply>(wm.at("a"), RenewRequest{ann.client, {{"x", token(ann)}}}).lost.size(),
            1u);
}

TEST_F(WorkingMemoryLeases, EndWithTheirHolder) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::odr);
  lock(bob, LockLevel::o);
  caf::anon_send_exit(ann.actor, caf::exit_reason::kill);
  scheduler.run();
  ASSERT_EQ(bob.leases.size(), 1u);
  EXPECT_TRUE(bob.leases[0]);
}

TEST_F(WorkingMemoryLeases, AReaderGoesOnWhenTheOnlyHolderDies) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::odr);
  read(bob);
  caf::anon_send_exit(ann.actor, caf::exit_reason::kill);
  scheduler.run();
  EXPECT_EQ(bob.reads.size(), 1u);
}

TEST_F(WorkingMemoryLeases, AWaiterThatDiedIsPassedOver) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  auto& cid = claimant("cid");
  lock(ann, LockLevel::o);
  lock(bob, LockLevel::o);
  lock(cid, LockLevel::o);
  caf::anon_send_exit(bob.actor, caf::exit_reason::kill);
  scheduler.run();
  EXPECT_EQ(status("a").waiting, 1u);
  unlock(ann);
  ASSERT_EQ(ann.unlocks.size(), 1u);
  EXPECT_TRUE(ann.unlocks[0]);
  EXPECT_EQ(status("a").waiting, 0u);
  EXPECT_EQ(cid.leases.size(), 1u);
}

TEST_F(WorkingMemoryLeases, AReaderWaitsForAnOdrLease) {
  ASSERT_TRUE(add({"a", "x"}, 5));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob", "c");
  lock(ann, LockLevel::odr);
  read(bob, "c");
  read(ann);
  EXPECT_EQ(bob.reads.size(), 0u);
  EXPECT_EQ(ann.reads.size(), 1u) << "the holder reads on";
  overwrite_as(ann, 0, token(ann));
  unlock(ann);
  ASSERT_EQ(bob.reads.size(), 1u);
  EXPECT_EQ((*bob.reads[0])->version, 1u);
}

TEST_F(WorkingMemoryLeases, AReaderGivesUpAtItsDeadline) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::odr);
  tell(bob, ReadRequest{{"a", "x"}, patience(bob, 1s)});
  let_pass(1s);
  ASSERT_EQ(bob.reads.size(), 1u);
  EXPECT_EQ(bob.reads[0].failure().kind, FailureKind::no_answer);
  EXPECT_THAT(bob.reads[0].failure().message, HasSubstr("ann of a holds a lease of level ODR"));
}

TEST_F(WorkingMemoryLeases, AQueryWaitsUntilItMayReadAllAtOnce) {
  ASSERT_TRUE(add({"a", "x"}));
  ASSERT_TRUE(add({"a", "y"}));
  ASSERT_TRUE(add({"a", "z"}));
  auto& ann = claimant("ann");
  auto& eve = claimant("eve");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::odr);
  lock(eve, LockLevel::odr, 10s, {"a", "y"});
  tell(bob, QueryRequest{{"a", "Item", 0, false}, patience(bob)});
  unlock(ann);
  EXPECT_EQ(bob.queries.size(), 0u);
  EXPECT_EQ(status("a").waiting, 1u);
  tell(eve, WriteRequest{Operation::remove, {"a", "y"}, {}, {}, eve.client, token(eve)});
  ASSERT_EQ(bob.queries.size(), 1u);
  EXPECT_EQ((*bob.queries[0]).size(), 2u);
}

TEST_F(WorkingMemoryLeases, DeletionTellsThoseWhoWait) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  auto& cid = claimant("cid");
  lock(ann, LockLevel::odr);
  lock(bob, LockLevel::o);
  read(cid);
  tell(ann, WriteRequest{Operation::remove, {"a", "x"}, {}, {}, ann.client, token(ann)});
  ASSERT_EQ(bob.leases.size(), 1u);
  EXPECT_EQ(bob.leases[0].failure().kind, FailureKind::does_not_exist);
  EXPECT_THAT(bob.leases[0].failure().message,
              HasSubstr("a/x was deleted while bob of a waited to lock it"));
  EXPECT_EQ(cid.reads.at(0).failure().kind, FailureKind::does_not_exist);
  EXPECT_EQ(status("a").leases, 0u);
}

TEST_F(WorkingMemoryLeases, OthersMayDeleteUnderAnOLeaseOnly) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  lock(ann, LockLevel::od);
  EXPECT_EQ(remove({"a", "x"}).failure().kind, FailureKind::leased);
  unlock(ann);
  lock(ann, LockLevel::o);
  EXPECT_TRUE(remove({"a", "x"}));
  unlock(ann);
  EXPECT_EQ(ann.unlocks.back().failure().kind, FailureKind::does_not_exist);
}

TEST_F(WorkingMemoryLeases, ATokenOfADeletedEntryDoesNotFitItsSuccessor) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  lock(ann, LockLevel::o);
  ASSERT_TRUE(remove({"a", "x"}));
  ASSERT_TRUE(add({"a", "x"}));
  EXPECT_EQ(overwrite_as(ann, 1, token(ann))->kind, FailureKind::lease_lost);
}

TEST_F(WorkingMemoryLeases, ACancelledWaitIsGone) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  auto& cid = claimant("cid");
  lock(ann, LockLevel::o);
  lock(bob, LockLevel::o);
  lock(cid, LockLevel::o);
  tell(bob, CancelWait{{"a", "x"}, bob.client, bob.numbers});
  unlock(ann);
  EXPECT_EQ(bob.leases.size(), 0u);
  EXPECT_EQ(cid.leases.size(), 1u);
}

TEST_F(WorkingMemoryLeases, ALeaseGrantedToOneWhoWaitsNoLongerIsFreedAgain) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  lock(ann, LockLevel::o);
  tell(ann, CancelWait{{"a", "x"}, ann.client, ann.numbers});
  lock(bob, LockLevel::o, 0s);
  EXPECT_TRUE(bob.leases.at(0));
}

TEST_F(WorkingMemoryLeases, AStepOfAnAtomicWriteThatALeaseForbidsForbidsAll) {
  ASSERT_TRUE(add({"a", "x"}));
  ASSERT_TRUE(add({"a", "y"}));
  auto& ann = claimant("ann");
  lock(ann, LockLevel::o);
  auto tester = std::make_shared<const Client>(Client{"tester", "a"});
  BatchRequest batch{"a",
                     {{Operation::overwrite, {"a", "y"}, Value::of(Item{1}), 0, tester},
                      {Operation::overwrite, {"a", "x"}, Value::of(Item{1}), 0, tester}}};
  auto outcome = ask<Outcome<std::vector<Version>>>(wm.at("a"), batch);
  EXPECT_EQ(outcome.failure().kind, FailureKind::leased);
  EXPECT_EQ((*ask<Outcome<EntryPtr>>(wm.at("a"), ReadRequest{{"a", "y"}, {}}))->version, 0u);
}

TEST_F(WorkingMemoryLeases, AnAtomicWriteHappensAtOnce) {
  ASSERT_TRUE(add({"a", "x"}));
  ASSERT_TRUE(add({"a", "y"}));
  auto& all = listen();
  subscribe(all, "a", 1, any_change());
  auto tester = std::make_shared<const Client>(Client{"tester", "a"});
  BatchRequest batch{"a",
                     {{Operation::overwrite, {"a", "x"}, Value::of(Item{1}), 0, tester},
                      {Operation::remove, {"a", "y"}, {}, {}, tester},
                      {Operation::add, {"a", "z"}, Value::of(Item{1}), {}, tester}}};
  auto outcome = ask<Outcome<std::vector<Version>>>(wm.at("c"), batch);
  ASSERT_TRUE(outcome) << outcome.failure().message;
  EXPECT_EQ(*outcome, (std::vector<Version>{1, 0, 0}));
  EXPECT_EQ(told(all), (Told{"OVERWRITE a/x", "DELETE a/y", "ADD a/z"}));
  EXPECT_EQ(all.batches, 1);
}

TEST_F(WorkingMemoryLeases, AnAtomicWriteStaysWithinOneWorkingMemory) {
  auto tester = std::make_shared<const Client>(Client{"tester", "a"});
  BatchRequest batch{"a",
                     {{Operation::add, {"a", "x"}, Value::of(Item{1}), {}, tester},
                      {Operation::add, {"b", "y"}, Value::of(Item{1}), {}, tester}}};
  auto outcome = ask<Outcome<std::vector<Version>>>(wm.at("a"), batch);
  EXPECT_EQ(outcome.failure().kind, FailureKind::not_atomic);
  EXPECT_THAT(outcome.failure().message, HasSubstr("an atomic write stays within one working "
                                                   "memory"));
  EXPECT_EQ(status("a").entries, 0u);
}

TEST_F(WorkingMemoryLeases, AnEntryIsForgottenWhenItsTimeIsOver) {
  auto& all = listen();
  subscribe(all, "a", 1, deleted<Item>());
  auto at = Address{"a", "x"};
  ASSERT_TRUE(write("a", {Operation::add, at, Value::of(Item{}), {}, {}, 0, EntryLife{3s}}));
  let_pass(2s);
  ASSERT_TRUE(overwrite(at, 0)) << "which begins its time anew";
  let_pass(2s);
  EXPECT_TRUE(all.notices.empty());
  let_pass(1s);
  ASSERT_EQ(told(all), Told{"DELETE a/x"});
  EXPECT_EQ(all.notices[0].event->source, expiry_source);
  EXPECT_EQ(all.notices[0].event->version, 1u);
}

TEST_F(WorkingMemoryLeases, WhatOthersMayNotDeleteIsNotForgottenEither) {
  auto at = Address{"a", "x"};
  ASSERT_TRUE(write("a", {Operation::add, at, Value::of(Item{}), {}, {}, 0, EntryLife{1s}}));
  auto& ann = claimant("ann");
  lock(ann, LockLevel::od);
  let_pass(1500ms);
  EXPECT_EQ(status("a").entries, 1u);
  let_pass(500ms);
  EXPECT_EQ(status("a").entries, 0u) << "the lease has expired";
}

TEST_F(WorkingMemoryLeases, AnEphemeralEntryGoesWithItsOwner) {
  auto& all = listen();
  subscribe(all, "a", 1, deleted<Item>());
  auto& ann = claimant("ann");
  tell(ann, WriteRequest{Operation::add,
                         {"a", "x"},
                         Value::of(Item{}),
                         {},
                         ann.client,
                         0,
                         EntryLife{.ephemeral = true}});
  ASSERT_TRUE(overwrite({"a", "x"}, 0)) << "by somebody else, which makes no difference";
  caf::anon_send_exit(ann.actor, caf::exit_reason::kill);
  scheduler.run();
  ASSERT_EQ(told(all), Told{"DELETE a/x"});
  EXPECT_EQ(all.notices[0].event->source, owner_ended_source);
}

TEST_F(WorkingMemoryLeases, ALastWillIsFulfilledWhenItsClientEnds) {
  auto& all = listen();
  subscribe(all, "a", 1, changed<Item>());
  auto& ann = claimant("ann");
  Address at{"a", "x"};
  // Whoever made the entry.
  ASSERT_TRUE(add(at, 1));
  WriteRequest request{Operation::overwrite, at, Value::of(Item{2}), 0, ann.client};
  request.last_will = LastWill{Value::of(Item{3}), {.time_to_live = 1s}};
  tell(ann, request);
  ASSERT_TRUE(overwrite(at, 1, 4)) << "which keeps the will";
  caf::anon_send_exit(ann.actor, caf::exit_reason::kill);
  scheduler.run();
  EXPECT_EQ(told(all), (Told{"ADD a/x", "OVERWRITE a/x", "OVERWRITE a/x", "OVERWRITE a/x"}));
  EXPECT_EQ(all.notices.back().event->source, last_will_source);
  auto entry = *ask<Outcome<EntryPtr>>(wm.at("a"), ReadRequest{at, {}});
  EXPECT_EQ(entry->value.as<Item>()->number, 3);
  EXPECT_EQ(entry->version, 3u);
  EXPECT_EQ(entry->writer, "ann");
  let_pass(999ms);
  EXPECT_EQ(status("a").entries, 1u);
  let_pass(1ms);
  EXPECT_EQ(status("a").entries, 0u) << "the will says how long it stays";
}

TEST_F(WorkingMemoryLeases, ALastWillCanBeReplacedAndWithdrawn) {
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  Address at{"a", "x"};
  WriteRequest request{Operation::add, at, Value::of(Item{1}), {}, ann.client};
  request.last_will = LastWill{Value::of(Item{2}), {}};
  tell(ann, request);
  request = {Operation::overwrite, at, Value::of(Item{3}), 0, bob.client};
  request.last_will = LastWill{Value::of(Item{4}), {}};
  tell(bob, request);
  caf::anon_send_exit(ann.actor, caf::exit_reason::kill);
  scheduler.run();
  EXPECT_EQ(ask<Outcome<EntryPtr>>(wm.at("a"), ReadRequest{at, {}})->get()->version, 1u)
    << "the will is bob's by now";
  request = {Operation::overwrite, at, Value::of(Item{5}), 1, bob.client};
  request.last_will = LastWill{};
  tell(bob, request);
  caf::anon_send_exit(bob.actor, caf::exit_reason::kill);
  scheduler.run();
  EXPECT_EQ(ask<Outcome<EntryPtr>>(wm.at("a"), ReadRequest{at, {}})->get()->version, 2u);
}

TEST_F(WorkingMemoryLeases, SayWhoHoldsThem) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob");
  auto free = *ask<Outcome<LockStatus>>(wm.at("c"), LockQuery{{"a", "x"}});
  EXPECT_FALSE(free.level);
  lock(ann, LockLevel::odr);
  lock(bob, LockLevel::o);
  auto held = *ask<Outcome<LockStatus>>(wm.at("c"), LockQuery{{"a", "x"}});
  EXPECT_EQ(held.level, LockLevel::odr);
  EXPECT_EQ(held.holder->component, "ann");
  EXPECT_EQ(held.waiting, 1u);
}

TEST_F(WorkingMemoryLeases, AProbeGoesToWhoeverHoldsTheLease) {
  ASSERT_TRUE(add({"a", "x"}));
  auto& ann = claimant("ann");
  auto& bob = claimant("bob", "c");
  lock(ann, LockLevel::o);
  lock(bob, LockLevel::o, 10s, {"a", "x"}, "c");
  WaitEdge edge;
  edge.waiter = bob.client;
  edge.number = bob.numbers;
  edge.address = {"a", "x"};
  tell(bob, DeadlockProbe{{edge}, 0}, "c");
  ASSERT_EQ(ann.probes.size(), 1u);
  EXPECT_EQ(ann.probes[0].path.back().obstacle, token(ann));
  edge.number = 99;
  tell(bob, DeadlockProbe{{edge}, 0}, "c");
  EXPECT_EQ(ann.probes.size(), 1u) << "nobody waits like that";
}

} // namespace

} // namespace castor::test
