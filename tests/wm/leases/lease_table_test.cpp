#include "castor/wm/leases/lease_table.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;
using Result = SettledWait::Result;
using Verdict = LeaseTable::Verdict;

class Leases : public testing::Test {
protected:
  static ClientPtr client(const std::string& name, std::uint64_t incarnation = 1) {
    return std::make_shared<const Client>(Client{name, "a", incarnation});
  }

  LeaseToken lock_now(const ClientPtr& who, LockLevel level) {
    auto lease = table.try_lock("x", who, level, ++numbers, now);
    return lease ? lease->token : 0;
  }

  /// The number of the wait.
  WaitNumber queue_lock(const ClientPtr& who, LockLevel level, Timestamp patience = 10s) {
    EXPECT_FALSE(table.lock("x", who, level, ++numbers, now, now + patience));
    return numbers;
  }

  WaitNumber queue_read(const ClientPtr& who, Timestamp patience = 10s) {
    table.wait_to_read("x", who, ++numbers, now + patience);
    return numbers;
  }

  /// What has become of waits, in order: "granted ann", "readable bob".
  std::vector<std::string> settled() {
    static constexpr const char* names[] = {"granted", "readable", "timed out", "deleted"};
    std::vector<std::string> result;
    for (auto& x : table.take_settled())
      result.push_back(std::string{names[static_cast<int>(x.result)]} + ' ' + x.client->component);
    return result;
  }

  using Strings = std::vector<std::string>;

  LeaseTable table{{.duration = 2s}};
  Timestamp now{0};
  WaitNumber numbers = 0;
  ClientPtr ann = client("ann"), bob = client("bob"), cid = client("cid"), dan = client("dan");
};

TEST_F(Leases, AFreeEntryIsLeasedAtOnce) {
  EXPECT_NE(lock_now(ann, LockLevel::o), 0u);
  EXPECT_EQ(table.holding("x")->holder->component, "ann");
  EXPECT_EQ(table.holding("x")->lease.expires, 2s);
}

TEST_F(Leases, NobodyElseGetsItMeanwhile) {
  lock_now(ann, LockLevel::o);
  EXPECT_EQ(lock_now(bob, LockLevel::o), 0u);
  EXPECT_EQ(lock_now(bob, LockLevel::odr), 0u);
  EXPECT_EQ(table.size(), 1u);
}

TEST_F(Leases, TokensRise) {
  LeaseToken last = 0;
  for (int i = 0; i < 5; ++i) {
    auto token = lock_now(i % 2 ? ann : bob, LockLevel::o);
    EXPECT_GT(token, last);
    last = token;
    EXPECT_TRUE(table.unlock("x", i % 2 ? *ann : *bob, token, now));
  }
}

TEST_F(Leases, ATableThatTakesOverStartsAboveItsPredecessor) {
  auto old = lock_now(ann, LockLevel::o);
  LeaseTable successor{{.duration = 2s, .first_token = 1000}};
  EXPECT_EQ(successor.check("x", *ann, Operation::overwrite, old), Verdict::stale);
  EXPECT_EQ(successor.try_lock("x", ann, LockLevel::o, 1, now)->token, 1000u);
}

TEST_F(Leases, EachLevelForbidsOthersWhatItSays) {
  struct {
    LockLevel level;
    Verdict overwrite, remove;
    bool read;
  } rows[] = {{LockLevel::o, Verdict::leased, Verdict::permitted, true},
              {LockLevel::od, Verdict::leased, Verdict::leased, true},
              {LockLevel::odr, Verdict::leased, Verdict::leased, false}};
  for (auto& row : rows) {
    auto token = lock_now(ann, row.level);
    EXPECT_EQ(table.check("x", *bob, Operation::overwrite, 0), row.overwrite);
    EXPECT_EQ(table.check("x", *bob, Operation::remove, 0), row.remove);
    EXPECT_EQ(table.may_read("x", *bob), row.read);
    EXPECT_EQ(table.check("x", *ann, Operation::overwrite, token), Verdict::permitted);
    EXPECT_EQ(table.check("x", *ann, Operation::remove, token), Verdict::permitted);
    EXPECT_TRUE(table.may_read("x", *ann));
    table.unlock("x", *ann, token, now);
  }
  EXPECT_TRUE(table.empty());
}

TEST_F(Leases, AWriteOfTheHolderNeedsItsToken) {
  lock_now(ann, LockLevel::o);
  EXPECT_EQ(table.check("x", *ann, Operation::overwrite, 0), Verdict::leased);
}

TEST_F(Leases, AStaleTokenIsRefusedEvenWhereNobodyHoldsALease) {
  auto token = lock_now(ann, LockLevel::o);
  table.unlock("x", *ann, token, now);
  EXPECT_EQ(table.check("x", *ann, Operation::overwrite, token), Verdict::stale);
  EXPECT_EQ(table.check("x", *ann, Operation::overwrite, 0), Verdict::permitted);
}

TEST_F(Leases, ATokenIsOfNoUseToAnotherClientOrALaterLife) {
  auto token = lock_now(ann, LockLevel::o);
  EXPECT_EQ(table.check("x", *bob, Operation::overwrite, token), Verdict::stale);
  EXPECT_EQ(table.check("x", *client("ann", 2), Operation::overwrite, token), Verdict::stale);
  EXPECT_FALSE(table.unlock("x", *client("ann", 2), token, now));
  EXPECT_FALSE(table.renew("x", *bob, token, now));
}

TEST_F(Leases, TheHolderLocksAgainWithTheSameTokenAndUnlocksAsOften) {
  auto token = lock_now(ann, LockLevel::o);
  EXPECT_EQ(lock_now(ann, LockLevel::odr), token);
  EXPECT_EQ(table.holding("x")->lease.level, LockLevel::odr);
  EXPECT_TRUE(table.unlock("x", *ann, token, now));
  EXPECT_EQ(table.holding("x")->lease.level, LockLevel::o);
  EXPECT_EQ(lock_now(bob, LockLevel::o), 0u);
  EXPECT_TRUE(table.unlock("x", *ann, token, now));
  EXPECT_NE(lock_now(bob, LockLevel::o), 0u);
}

TEST_F(Leases, ReadersGoOnWhenTheHolderSteppedDownFromOdr) {
  auto token = lock_now(ann, LockLevel::o);
  lock_now(ann, LockLevel::odr);
  queue_lock(cid, LockLevel::o);
  queue_read(bob);
  table.unlock("x", *ann, token, now);
  EXPECT_EQ(settled(), Strings{"readable bob"});
}

TEST_F(Leases, WaitersAreServedInTheOrderOfTheirArrival) {
  auto token = lock_now(ann, LockLevel::o);
  queue_lock(bob, LockLevel::od);
  queue_lock(cid, LockLevel::o);
  table.unlock("x", *ann, token, now);
  EXPECT_EQ(settled(), Strings{"granted bob"});
  EXPECT_EQ(lock_now(dan, LockLevel::o), 0u);
  table.unlock("x", *bob, table.holding("x")->lease.token, now);
  EXPECT_EQ(settled(), Strings{"granted cid"});
}

TEST_F(Leases, ReadsAreServedUpToTheNextOdrLock) {
  auto token = lock_now(ann, LockLevel::odr);
  queue_read(bob);
  queue_lock(cid, LockLevel::odr);
  queue_read(dan);
  table.unlock("x", *ann, token, now);
  EXPECT_EQ(settled(), (Strings{"readable bob", "granted cid"}));
  table.unlock("x", *cid, table.holding("x")->lease.token, now);
  EXPECT_EQ(settled(), Strings{"readable dan"});
}

TEST_F(Leases, ReadsBehindALockThatAllowsReadingAreServedWithIt) {
  auto token = lock_now(ann, LockLevel::odr);
  queue_lock(bob, LockLevel::od);
  queue_lock(cid, LockLevel::odr);
  queue_read(dan);
  table.unlock("x", *ann, token, now);
  EXPECT_EQ(settled(), (Strings{"granted bob", "readable dan"}));
}

TEST_F(Leases, ALeaseThatIsNotRenewedExpires) {
  auto token = lock_now(ann, LockLevel::o);
  queue_lock(bob, LockLevel::o);
  table.expire(now + 2s - 1us);
  EXPECT_EQ(settled(), Strings{});
  table.expire(now + 2s);
  EXPECT_EQ(settled(), Strings{"granted bob"});
  EXPECT_EQ(table.check("x", *ann, Operation::overwrite, token), Verdict::stale);
  EXPECT_FALSE(table.renew("x", *ann, token, now + 2s));
}

TEST_F(Leases, ARenewalCountsFromTheMomentItArrives) {
  auto token = lock_now(ann, LockLevel::o);
  EXPECT_TRUE(table.renew("x", *ann, token, now + 1500ms));
  EXPECT_EQ(table.next_deadline(), Timestamp{3500ms});
  table.expire(now + 3s);
  EXPECT_EQ(table.check("x", *ann, Operation::overwrite, token), Verdict::permitted);
}

TEST_F(Leases, WhatWasLockedAfterTheClockWasPutBackEndsBeforeWhatWasLockedBefore) {
  now = 10s;
  lock_now(ann, LockLevel::o);
  now = 5s;
  auto second = table.try_lock("y", bob, LockLevel::o, ++numbers, now);
  ASSERT_TRUE(second);
  EXPECT_EQ(table.next_deadline(), Timestamp{7s});
  table.expire(7s);
  EXPECT_EQ(table.holding("y"), nullptr);
  EXPECT_NE(table.holding("x"), nullptr);
  table.expire(12s);
  EXPECT_EQ(table.holding("x"), nullptr);
}

TEST_F(Leases, WhatWasRenewedAfterTheClockWasPutBackEndsBeforeWhatWasLockedBefore) {
  now = 10s;
  auto token = lock_now(ann, LockLevel::o);
  ASSERT_TRUE(table.try_lock("y", bob, LockLevel::o, ++numbers, now));
  EXPECT_TRUE(table.renew("x", *ann, token, 5s));
  EXPECT_EQ(table.next_deadline(), Timestamp{7s});
  table.expire(7s);
  EXPECT_EQ(table.holding("x"), nullptr);
  EXPECT_NE(table.holding("y"), nullptr);
}

TEST_F(Leases, AWaitEndsAtItsDeadline) {
  lock_now(ann, LockLevel::odr);
  queue_lock(bob, LockLevel::o, 500ms);
  queue_read(cid, 300ms);
  EXPECT_EQ(table.next_deadline(), Timestamp{300ms});
  table.expire(now + 500ms);
  EXPECT_EQ(settled(), (Strings{"timed out cid", "timed out bob"}));
  EXPECT_EQ(table.waiting("x"), nullptr);
}

TEST_F(Leases, AWaitWhoseTimeIsOverGetsNoLeaseThatEndsAtTheSameMoment) {
  lock_now(ann, LockLevel::o);
  queue_lock(bob, LockLevel::o, 2s);
  table.expire(now + 2s);
  EXPECT_EQ(settled(), Strings{"timed out bob"});
  EXPECT_EQ(table.holding("x"), nullptr);
}

TEST_F(Leases, TheEndOfAClientFreesWhatItHeldAndForgetsItsWaits) {
  lock_now(ann, LockLevel::o);
  table.try_lock("y", bob, LockLevel::o, ++numbers, now);
  queue_lock(bob, LockLevel::o);
  queue_lock(cid, LockLevel::o);
  table.drop(*bob, now);
  EXPECT_EQ(table.holding("y"), nullptr);
  table.drop(*ann, now);
  EXPECT_EQ(settled(), Strings{"granted cid"});
}

TEST_F(Leases, ALaterLifeOfAComponentKeepsWhatItHolds) {
  auto token = lock_now(client("ann", 2), LockLevel::o);
  table.drop(*ann, now);
  EXPECT_EQ(table.check("x", *client("ann", 2), Operation::overwrite, token), Verdict::permitted);
}

TEST_F(Leases, DeletionTellsEveryWaiter) {
  auto token = lock_now(ann, LockLevel::odr);
  queue_lock(bob, LockLevel::o);
  queue_read(cid);
  table.erase("x");
  EXPECT_EQ(settled(), (Strings{"deleted bob", "deleted cid"}));
  EXPECT_EQ(table.check("x", *ann, Operation::overwrite, token), Verdict::stale);
  EXPECT_TRUE(table.empty());
  EXPECT_FALSE(table.next_deadline());
}

TEST_F(Leases, AWaitThatIsTakenBackLetsTheNextOneGoFirst) {
  auto token = lock_now(ann, LockLevel::o);
  auto wait = queue_lock(bob, LockLevel::o);
  queue_lock(cid, LockLevel::o);
  table.cancel("x", *bob, wait, now);
  table.unlock("x", *ann, token, now);
  EXPECT_EQ(settled(), Strings{"granted cid"});
}

TEST_F(Leases, TakingAWaitBackThatWasGrantedMeanwhileGivesTheLeaseBack) {
  auto token = lock_now(ann, LockLevel::o);
  auto wait = queue_lock(bob, LockLevel::o);
  queue_lock(cid, LockLevel::o);
  table.unlock("x", *ann, token, now);
  table.cancel("x", *bob, wait, now);
  EXPECT_EQ(settled(), (Strings{"granted bob", "granted cid"}));
}

class Offers : public Leases {
protected:
  WaitNumber queue_claimant(const ClientPtr& who, LockLevel level = LockLevel::odr,
                            Timestamp patience = 10s) {
    EXPECT_FALSE(table.lock("x", who, level, ++numbers, now, now + patience, true));
    return numbers;
  }

  void unlock() {
    auto& x = *table.holding("x");
    EXPECT_TRUE(table.unlock("x", *x.holder, x.lease.token, now));
  }

  void pass(Timestamp time) {
    now += time;
    table.expire(now);
  }

  Strings offers() {
    Strings result;
    for (auto& x : table.take_offers())
      result.push_back(x.client->component);
    return result;
  }
};

TEST_F(Offers, AreForTheLongestWaitingClientAndForWhoComesBeforeIt) {
  lock_now(ann, LockLevel::odr);
  auto wait = queue_claimant(bob);
  unlock();
  EXPECT_EQ(offers(), Strings{"bob"});
  EXPECT_EQ(settled(), Strings{});
  EXPECT_EQ(table.holding("x"), nullptr);
  EXPECT_NE(lock_now(ann, LockLevel::odr), 0u) << "overtakes";
  unlock();
  EXPECT_EQ(offers(), Strings{}) << "one is enough to wake bob";
  table.claim("x", *bob, wait, now);
  EXPECT_EQ(settled(), Strings{"granted bob"});
  EXPECT_EQ(lock_now(ann, LockLevel::odr), 0u);
}

TEST_F(Offers, AreNotMadeToClientsThatCannotClaim) {
  lock_now(ann, LockLevel::o);
  queue_lock(bob, LockLevel::o);
  queue_claimant(cid);
  unlock();
  EXPECT_EQ(settled(), Strings{"granted bob"});
  unlock();
  EXPECT_EQ(settled(), Strings{});
  EXPECT_EQ(offers(), Strings{"cid"});
}

TEST_F(Offers, AClientThatClaimsInVainIsNext) {
  lock_now(ann, LockLevel::odr);
  auto wait = queue_claimant(bob);
  unlock();
  lock_now(ann, LockLevel::odr);
  table.claim("x", *bob, wait, now);
  EXPECT_EQ(settled(), Strings{});
  unlock();
  EXPECT_EQ(settled(), Strings{"granted bob"});
  EXPECT_EQ(table.holding("x")->holder->component, "bob");
}

TEST_F(Offers, AFreeLeaseIsGrantedWhenOvertakingEnds) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob);
  unlock();
  EXPECT_EQ(table.next_deadline(), Timestamp{500us});
  pass(499us);
  EXPECT_EQ(settled(), Strings{});
  pass(1us);
  EXPECT_EQ(settled(), Strings{"granted bob"});
  EXPECT_EQ(lock_now(ann, LockLevel::odr), 0u);
}

TEST_F(Offers, NobodyOvertakesForLongerHoweverOftenTheLeaseEnds) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob);
  int overtaken = 0;
  for (; table.holding("x")->holder == ann; ++overtaken) {
    unlock();
    pass(30us);
    lock_now(ann, LockLevel::odr);
    pass(70us);
  }
  EXPECT_EQ(overtaken, 6) << "the last of these at 430 us, and its end is after 500";
  EXPECT_EQ(now, 600us);
  EXPECT_EQ(settled(), Strings{"granted bob"});
}

TEST_F(Offers, OvertakingBeginsAnewForTheNextInTheQueue) {
  lock_now(ann, LockLevel::odr);
  auto wait = queue_claimant(bob);
  queue_claimant(cid);
  unlock();
  pass(400us);
  table.claim("x", *bob, wait, now);
  unlock();
  EXPECT_EQ(offers(), (Strings{"bob", "cid"}));
  pass(499us);
  EXPECT_EQ(settled(), Strings{"granted bob"});
  pass(1us);
  EXPECT_EQ(settled(), Strings{"granted cid"});
}

TEST_F(Offers, OvertakingDoesNotBeginAnewWhenTheFirstInTheQueueGivesUp) {
  lock_now(ann, LockLevel::odr);
  auto wait = queue_claimant(bob);
  queue_claimant(cid);
  unlock();
  pass(400us);
  table.cancel("x", *bob, wait, now);
  EXPECT_EQ(offers(), (Strings{"bob", "cid"}));
  pass(100us);
  EXPECT_EQ(settled(), Strings{"granted cid"});
}

TEST_F(Offers, OvertakingEndsThoughTheClockIsPutBack) {
  now = 10s;
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob);
  unlock();
  lock_now(ann, LockLevel::odr);
  pass(500us);
  now = 5s;
  unlock();
  EXPECT_EQ(settled(), Strings{"granted bob"});
}

TEST_F(Offers, NoClientOvertakesItself) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob);
  queue_claimant(cid);
  unlock();
  EXPECT_EQ(lock_now(cid, LockLevel::o), 0u);
  EXPECT_EQ(settled(), Strings{"granted bob"}) << "nobody waits for an entry that is free";
  queue_claimant(cid);
  EXPECT_EQ(table.waiting("x")->size(), 2u);
}

TEST_F(Offers, ARequestOfTheOneThatWaitsFirstIsNestedInTheLeaseThatItWaitedFor) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob, LockLevel::o);
  unlock();
  auto token = lock_now(bob, LockLevel::od);
  ASSERT_NE(token, 0u) << "the entry is free, and bob is awake";
  EXPECT_EQ(settled(), Strings{"granted bob"});
  EXPECT_EQ(table.holding("x")->lease.token, token);
  EXPECT_EQ(table.holding("x")->levels, (std::vector{LockLevel::o, LockLevel::od}));
  EXPECT_EQ(table.waiting("x"), nullptr);
  pass(500us);
  EXPECT_EQ(settled(), Strings{}) << "overtaking has ended";
}

TEST_F(Offers, AnEntryThatIsOfferedIsFree) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob);
  queue_read(cid);
  unlock();
  EXPECT_EQ(settled(), Strings{"readable cid"});
  EXPECT_TRUE(table.may_read("x", *dan));
  EXPECT_EQ(table.check("x", *dan, Operation::overwrite, 0), Verdict::permitted);
  EXPECT_EQ(table.size(), 0u);
  EXPECT_FALSE(table.empty());
}

TEST_F(Offers, AClaimOfWhoDoesNotWaitAnyMoreHasNoEffect) {
  lock_now(ann, LockLevel::odr);
  auto wait = queue_claimant(bob);
  queue_claimant(cid);
  unlock();
  table.cancel("x", *bob, wait, now);
  table.claim("x", *bob, wait, now);
  table.claim("y", *bob, wait, now);
  EXPECT_EQ(settled(), Strings{});
  EXPECT_EQ(offers(), (Strings{"bob", "cid"}));
}

TEST_F(Offers, TheEndOfTheFirstClientMakesAnOfferToTheNext) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob);
  queue_claimant(cid);
  unlock();
  table.drop(*bob, now);
  EXPECT_EQ(offers(), (Strings{"bob", "cid"}));
  EXPECT_EQ(table.waiting("x")->size(), 1u);
  table.drop(*cid, now);
  EXPECT_TRUE(table.empty());
  EXPECT_FALSE(table.next_deadline());
}

TEST_F(Offers, EndWithTheEntry) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob);
  unlock();
  table.erase("x");
  EXPECT_EQ(settled(), Strings{"deleted bob"});
  EXPECT_TRUE(table.empty());
  EXPECT_FALSE(table.next_deadline());
}

TEST_F(Offers, EndWithThePatienceOfTheClient) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob, LockLevel::o, 300us);
  unlock();
  pass(300us);
  EXPECT_EQ(settled(), Strings{"timed out bob"});
  EXPECT_NE(lock_now(cid, LockLevel::o), 0u);
  pass(300us);
  EXPECT_EQ(table.holding("x")->holder->component, "cid");
  unlock();
  EXPECT_TRUE(table.empty());
  EXPECT_FALSE(table.next_deadline());
}

TEST_F(Offers, LeaveNothingBehindWhenNobodyWaitsAnyMore) {
  lock_now(ann, LockLevel::odr);
  queue_claimant(bob, LockLevel::o, 300us);
  unlock();
  pass(500us);
  EXPECT_EQ(settled(), Strings{"timed out bob"});
  EXPECT_TRUE(table.empty());
}

TEST_F(Leases, NothingIsLeftOfWhatIsOver) {
  for (int i = 0; i < 100; ++i) {
    auto token = lock_now(ann, LockLevel::odr);
    queue_read(bob);
    queue_lock(cid, LockLevel::o);
    table.unlock("x", *ann, token, now);
    table.drop(*cid, now);
  }
  EXPECT_TRUE(table.empty());
  EXPECT_EQ(table.size(), 0u);
  EXPECT_FALSE(table.next_deadline());
}

} // namespace

} // namespace castor
