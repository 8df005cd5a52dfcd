#include "castor/tests/tools/linearizability/records.hpp"
#include "castor/tools/linearizability/checker.hpp"

#include <gtest/gtest.h>

// What an entry promises when one operation follows the other.
namespace castor::linearizability {

namespace {

/// Gives the operations moments of their own, one after the other; those that must wait overlap
/// with all that follows.
class EntryRules : public testing::Test {
protected:
  /// Whether the operations could have gone like this.
  bool possible(History history) {
    Tick now = 0;
    for (auto& x : history) {
      x.invoked = ++now;
      x.queued_by = ++now;
      x.returned = x.returned == waits_ ? waits_ : now;
    }
    return Checker{}.check(history).ok();
  }

  static constexpr Tick waits_ = 1000;
  static constexpr Span waits{0, waits_};
  static constexpr Span at_once{0, 0};
  static constexpr Client a = 1, b = 2, c = 3;
};

} // namespace

TEST_F(EntryRules, AnAddedEntryHasVersionZeroAndItsContent) {
  EXPECT_TRUE(possible({add(a, 10, at_once, at_version(0)), read(b, at_once, saw(0, 10))}));
  EXPECT_FALSE(possible({add(a, 10, at_once, at_version(1))}));
  EXPECT_FALSE(possible({add(a, 10, at_once, at_version(0)), read(b, at_once, saw(0, 11))}));
}

TEST_F(EntryRules, AnEntryIsAddedOnce) {
  EXPECT_TRUE(
    possible({add(a, 10, at_once, at_version(0)),
              add(b, 11, at_once, failed(Status::already_exists)), read(b, at_once, saw(0, 10))}));
  EXPECT_FALSE(possible({add(a, 10, at_once, at_version(0)), add(b, 11, at_once, at_version(0))}));
  EXPECT_FALSE(possible({add(b, 11, at_once, failed(Status::already_exists))}));
}

TEST_F(EntryRules, WithoutTheEntryOperationsFail) {
  for (auto& x :
       {overwrite(a, 10, 0, at_once), remove(a, at_once), read(a, at_once), exists(a, at_once),
        lock(a, o, at_once), try_lock(a, o, at_once), unlock(a, 1, at_once),
        overwrite(a, 10, 0, at_once, {}, 1), remove(a, at_once, {}, 1)}) {
    SCOPED_TRACE(to_string(x));
    auto fails = x;
    fails.result = failed(Status::does_not_exist);
    EXPECT_TRUE(possible({fails}));
    EXPECT_FALSE(possible({x}));
    auto before = add(b, 1, at_once, at_version(0));
    auto between = remove(b, at_once, at_version(0));
    EXPECT_TRUE(possible({before, between, fails}));
    EXPECT_FALSE(possible({before, fails}));
  }
}

TEST_F(EntryRules, VersionsRiseByOne) {
  auto added = add(a, 10, at_once, at_version(0));
  EXPECT_TRUE(possible({added, overwrite(a, 11, 0, at_once, at_version(1)),
                        overwrite(a, 12, 1, at_once, at_version(2)), read(b, at_once, saw(2, 12)),
                        version(b, at_once, at_version(2))}));
  EXPECT_FALSE(possible({added, overwrite(a, 11, 0, at_once, at_version(2))}));
  EXPECT_FALSE(possible({added, overwrite(a, 11, 0, at_once, at_version(0))}));
}

TEST_F(EntryRules, AnOverwriteNeedsTheVersionThatIsThere) {
  auto added = add(a, 10, at_once, at_version(0));
  auto overwritten = overwrite(a, 11, 0, at_once, at_version(1));
  auto inconsistent = failed(Status::inconsistent);
  EXPECT_TRUE(possible({added, overwritten, overwrite(b, 12, 0, at_once, inconsistent),
                        overwrite(b, 12, std::nullopt, at_once, inconsistent),
                        overwrite(b, 12, 2, at_once, inconsistent),
                        overwrite(b, 12, 1, at_once, at_version(2))}));
  EXPECT_FALSE(possible({added, overwritten, overwrite(b, 12, 0, at_once, at_version(2))}));
  EXPECT_FALSE(
    possible({added, overwritten, overwrite(b, 12, std::nullopt, at_once, at_version(2))}));
  EXPECT_FALSE(possible({added, overwrite(b, 12, 0, at_once, inconsistent)}));
}

TEST_F(EntryRules, VersionsSurviveDeletion) {
  History history{add(a, 10, at_once, at_version(0)), overwrite(a, 11, 0, at_once, at_version(1)),
                  remove(b, at_once, at_version(1)), version(c, at_once, at_version(1)),
                  exists(c, at_once, failed(Status::does_not_exist))};
  EXPECT_TRUE(possible(history));
  EXPECT_TRUE(possible(with(history, add(c, 12, at_once, at_version(2)))));
  EXPECT_FALSE(possible(with(history, add(c, 12, at_once, at_version(1)))));
  EXPECT_FALSE(possible(with(history, add(c, 12, at_once, at_version(0)))));
}

TEST_F(EntryRules, OnlyWhatNeverExistedHasNoVersion) {
  auto nothing = version(b, at_once, failed(Status::never_existed));
  auto added = add(a, 10, at_once, at_version(0));
  EXPECT_TRUE(possible({nothing, added}));
  EXPECT_FALSE(possible({added, nothing}));
  EXPECT_FALSE(possible({added, remove(a, at_once, at_version(0)), nothing}));
}

TEST_F(EntryRules, ALeaseHasOneHolder) {
  auto added = add(a, 10, at_once, at_version(0));
  auto locked = lock(a, o, at_once, obtained(1));
  EXPECT_TRUE(possible({added, locked, try_lock(b, o, at_once, failed(Status::busy)),
                        unlock(a, 1, at_once), try_lock(b, o, at_once, obtained(2))}));
  EXPECT_FALSE(possible({added, locked, try_lock(b, o, at_once, obtained(2))}));
  EXPECT_FALSE(possible({added, locked, lock(b, o, at_once, obtained(2))}));
  EXPECT_FALSE(possible({added, try_lock(b, o, at_once, failed(Status::busy))}));
}

TEST_F(EntryRules, TokensRise) {
  History history{add(a, 10, at_once, at_version(0)), lock(a, o, at_once, obtained(5)),
                  unlock(a, 5, at_once)};
  for (Token token : {6, 7, 100})
    EXPECT_TRUE(possible(with(history, lock(b, o, at_once, obtained(token))))) << token;
  for (Token token : {5, 4, 0})
    EXPECT_FALSE(possible(with(history, lock(b, o, at_once, obtained(token))))) << token;
}

TEST_F(EntryRules, TokensRiseAcrossDeletion) {
  History history{add(a, 10, at_once, at_version(0)), lock(a, o, at_once, obtained(5)),
                  remove(a, at_once, at_version(0), 5), add(a, 10, at_once, at_version(1))};
  EXPECT_TRUE(possible(with(history, lock(a, o, at_once, obtained(6)))));
  EXPECT_FALSE(possible(with(history, lock(a, o, at_once, obtained(5)))));
}

TEST_F(EntryRules, WritesWithoutATokenAreStoppedByTheLevel) {
  auto added = add(a, 10, at_once, at_version(0));
  auto locked = failed(Status::locked);
  for (auto level : {o, od, odr})
    for (Client client : {a, b}) {
      SCOPED_TRACE(to_string(level) + ", client " + std::to_string(client));
      auto leased = lock(a, level, at_once, obtained(1));
      EXPECT_TRUE(possible({added, leased, overwrite(client, 11, 0, at_once, locked)}));
      EXPECT_FALSE(possible({added, leased, overwrite(client, 11, 0, at_once, at_version(1))}));
      EXPECT_EQ(possible({added, leased, remove(client, at_once, locked)}), level != o);
      EXPECT_EQ(possible({added, leased, remove(client, at_once, at_version(0))}), level == o);
    }
}

TEST_F(EntryRules, WritesWithTheTokenPass) {
  auto added = add(a, 10, at_once, at_version(0));
  for (auto level : {o, od, odr}) {
    auto leased = lock(a, level, at_once, obtained(1));
    EXPECT_TRUE(possible({added, leased, overwrite(a, 11, 0, at_once, at_version(1), 1),
                          remove(a, at_once, at_version(1), 1)}));
    EXPECT_TRUE(
      possible({added, leased, overwrite(a, 11, 7, at_once, failed(Status::inconsistent), 1)}));
  }
}

TEST_F(EntryRules, StaleTokensAreRefused) {
  History over{add(a, 10, at_once, at_version(0)), lock(a, o, at_once, obtained(1)),
               unlock(a, 1, at_once)};
  for (auto& history : {over, with(over, lock(a, o, at_once, obtained(2))),
                        with(over, lock(b, odr, at_once, obtained(2)))})
    for (auto x : {overwrite(a, 11, 0, at_once, at_version(1), 1),
                   remove(a, at_once, at_version(0), 1), unlock(a, 1, at_once)}) {
      SCOPED_TRACE(to_string(x));
      EXPECT_FALSE(possible(with(history, x)));
      x.result = failed(Status::locked);
      EXPECT_FALSE(possible(with(history, x)));
      x.result = failed(Status::stale);
      EXPECT_TRUE(possible(with(history, x)));
    }
}

TEST_F(EntryRules, ATokenIsOfNoUseToAnother) {
  History history{add(a, 10, at_once, at_version(0)), lock(a, o, at_once, obtained(1))};
  EXPECT_FALSE(possible(with(history, overwrite(b, 11, 0, at_once, at_version(1), 1))));
  EXPECT_TRUE(possible(with(history, overwrite(b, 11, 0, at_once, failed(Status::stale), 1))));
}

TEST_F(EntryRules, LockingAgainNests) {
  auto added = add(a, 10, at_once, at_version(0));
  auto locked = lock(a, o, at_once, obtained(1));
  auto unlocked = unlock(a, 1, at_once);
  auto stronger = lock(a, od, at_once, obtained(1));
  auto obtains = try_lock(b, o, at_once, obtained(2));
  EXPECT_FALSE(possible({added, locked, lock(a, o, at_once, obtained(2))}));
  EXPECT_FALSE(possible({added, locked, stronger, unlocked, obtains}));
  EXPECT_TRUE(possible({added, locked, stronger, unlocked, unlocked, obtains}));
  // Given back once, it is still leased, at the weaker level.
  EXPECT_TRUE(possible({added, locked, stronger, unlocked,
                        overwrite(b, 11, 0, at_once, failed(Status::locked)),
                        remove(b, at_once, at_version(0))}));
}

TEST_F(EntryRules, TheStrongestLevelCounts) {
  History history{add(a, 10, at_once, at_version(0)), lock(a, odr, at_once, obtained(1)),
                  try_lock(a, o, at_once, obtained(1))};
  EXPECT_TRUE(possible(with(history, remove(b, at_once, failed(Status::locked)))));
  EXPECT_FALSE(possible(with(history, remove(b, at_once, at_version(0)))));
}

TEST_F(EntryRules, ReadsWaitForAnOdrLease) {
  auto added = add(a, 10, at_once, at_version(0));
  EXPECT_FALSE(possible({added, lock(a, odr, at_once, obtained(1)), read(b, at_once, saw(0, 10))}));
  EXPECT_TRUE(possible({added, lock(a, odr, at_once, obtained(1)), read(a, at_once, saw(0, 10)),
                        exists(b, at_once), version(b, at_once, at_version(0))}));
  for (auto level : {o, od})
    EXPECT_TRUE(
      possible({added, lock(a, level, at_once, obtained(1)), read(b, at_once, saw(0, 10))}));
  EXPECT_TRUE(possible({added, lock(a, odr, at_once, obtained(1)), read(b, waits, saw(1, 11)),
                        overwrite(a, 11, 0, at_once, at_version(1), 1), unlock(a, 1, at_once)}));
  EXPECT_FALSE(possible({added, lock(a, odr, at_once, obtained(1)), read(b, waits, saw(0, 10)),
                         overwrite(a, 11, 0, at_once, at_version(1), 1), unlock(a, 1, at_once)}));
}

TEST_F(EntryRules, AWeakenedLeaseLetsReadsPass) {
  History history{add(a, 10, at_once, at_version(0)),
                  lock(a, o, at_once, obtained(1)),
                  lock(a, odr, at_once, obtained(1)),
                  lock(b, odr, waits, obtained(2)),
                  read(c, waits, saw(0, 10)),
                  unlock(a, 1, at_once),
                  overwrite(a, 11, 0, at_once, at_version(1), 1),
                  unlock(a, 1, at_once)};
  EXPECT_TRUE(possible(history));
  history[4].result = saw(1, 11);
  EXPECT_FALSE(possible(history));
}

TEST_F(EntryRules, TheQueueIsServedInOrder) {
  History history{add(a, 10, at_once, at_version(0)),
                  lock(a, o, at_once, obtained(1)),
                  lock(b, o, waits, obtained(2)),
                  lock(c, o, waits, obtained(3)),
                  unlock(a, 1, at_once),
                  unlock(b, 2, at_once)};
  EXPECT_TRUE(possible(history));
  std::swap(history[2].result, history[3].result);
  EXPECT_FALSE(possible(history));
}

TEST_F(EntryRules, ReadsBehindAnOdrLockWaitOn) {
  // The second read stands behind the lock of b and sees what b writes, the first one does not.
  History history{add(a, 10, at_once, at_version(0)),
                  lock(a, odr, at_once, obtained(1)),
                  read(c, waits, saw(0, 10)),
                  lock(b, odr, waits, obtained(2)),
                  read(4, waits, saw(1, 11)),
                  unlock(a, 1, at_once),
                  overwrite(b, 11, 0, at_once, at_version(1), 2),
                  unlock(b, 2, at_once)};
  EXPECT_TRUE(possible(history));
  std::swap(history[2].result, history[4].result);
  EXPECT_FALSE(possible(history));
  history[2].result = saw(1, 11);
  EXPECT_FALSE(possible(history));
}

TEST_F(EntryRules, TheNewHoldersOwnReadsAreServedWithItsLock) {
  History history{add(a, 10, at_once, at_version(0)),
                  lock(a, odr, at_once, obtained(1)),
                  lock(b, odr, waits, obtained(2)),
                  read(b, waits, saw(0, 10)),
                  unlock(a, 1, at_once),
                  overwrite(b, 11, 0, at_once, at_version(1), 2),
                  unlock(b, 2, at_once)};
  EXPECT_TRUE(possible(history));
  history[3].result = saw(1, 11);
  EXPECT_FALSE(possible(history));
}

TEST_F(EntryRules, ReadsBehindAWeakerLockAreServedWithIt) {
  History history{add(a, 10, at_once, at_version(0)),
                  lock(a, odr, at_once, obtained(1)),
                  lock(b, od, waits, obtained(2)),
                  lock(c, odr, waits, obtained(3)),
                  read(4, waits, saw(0, 10)),
                  unlock(a, 1, at_once),
                  overwrite(b, 11, 0, at_once, at_version(1), 2),
                  unlock(b, 2, at_once),
                  unlock(c, 3, at_once)};
  EXPECT_TRUE(possible(history));
  history[4].result = saw(1, 11);
  EXPECT_FALSE(possible(history));
}

TEST_F(EntryRules, DeletionFailsAllThatWait) {
  auto gone = failed(Status::does_not_exist);
  History history{add(a, 10, at_once, at_version(0)), lock(a, odr, at_once, obtained(1)),
                  lock(b, o, waits, gone), read(c, waits, gone),
                  remove(a, at_once, at_version(0), 1)};
  EXPECT_TRUE(possible(history));
  history[2].result = obtained(2);
  EXPECT_FALSE(possible(history));
  history[2].result = gone;
  history[3].result = saw(0, 10);
  EXPECT_FALSE(possible(history));
}

TEST_F(EntryRules, NobodyIsToldOfADeletionThatDidNotHappen) {
  EXPECT_FALSE(
    possible({add(a, 10, at_once, at_version(0)), lock(a, odr, at_once, obtained(1)),
              lock(b, o, waits, failed(Status::does_not_exist)), unlock(a, 1, at_once)}));
}

TEST_F(EntryRules, OnlyWhoWaitedTimesOut) {
  auto added = add(a, 10, at_once, at_version(0));
  auto timed_out = failed(Status::timed_out);
  EXPECT_TRUE(possible({added, lock(a, o, at_once, obtained(1)), lock(b, o, waits, timed_out)}));
  EXPECT_TRUE(possible({added, lock(a, odr, at_once, obtained(1)), read(b, waits, timed_out)}));
  EXPECT_FALSE(possible({added, lock(b, o, waits, timed_out)}));
  EXPECT_FALSE(possible({added, lock(a, o, at_once, obtained(1)), read(b, waits, timed_out)}));
  EXPECT_FALSE(possible({added, lock(a, o, at_once, obtained(1)), lock(a, o, waits, timed_out)}));
}

} // namespace castor::linearizability
