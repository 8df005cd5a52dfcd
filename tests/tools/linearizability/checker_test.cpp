#include "castor/tests/tools/linearizability/records.hpp"
#include "castor/tools/linearizability/checker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// What the checker makes of operations that overlap.
namespace castor::linearizability {

namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr Client a = 1, b = 2, c = 3, d = 4;

bool accepted(const History& history) {
  return Checker{}.check(history).ok();
}

const OperationRecord added = add(a, 10, {1, 2}, at_version(0));
const OperationRecord locked = lock(a, odr, {3, 4}, obtained(1));

} // namespace

TEST(Checker, AcceptsNothingAtAll) {
  EXPECT_TRUE(accepted({}));
}

TEST(Checker, AnOperationHappensBetweenItsInvocationAndItsReturn) {
  History history{added, overwrite(a, 11, 0, {10, 20}, at_version(1))};
  for (auto& result : {saw(0, 10), saw(1, 11)})
    EXPECT_TRUE(accepted(with(history, read(b, {15, 25}, result))));
  EXPECT_TRUE(accepted(with(history, read(b, {5, 9}, saw(0, 10)))));
  EXPECT_FALSE(accepted(with(history, read(b, {5, 9}, saw(1, 11)))));
  EXPECT_TRUE(accepted(with(history, read(b, {21, 25}, saw(1, 11)))));
  EXPECT_FALSE(accepted(with(history, read(b, {21, 25}, saw(0, 10)))));
}

TEST(Checker, ReadsDoNotGoBack) {
  History history{added, overwrite(a, 11, 0, {10, 40}, at_version(1))};
  EXPECT_TRUE(
    accepted(with(with(history, read(b, {15, 20}, saw(0, 10))), read(c, {21, 25}, saw(1, 11)))));
  EXPECT_FALSE(
    accepted(with(with(history, read(b, {15, 20}, saw(1, 11))), read(c, {21, 25}, saw(0, 10)))));
}

TEST(Checker, AnUpdateIsNotLost) {
  History history{added, overwrite(a, 11, 0, {10, 20}, at_version(1))};
  EXPECT_TRUE(accepted(with(history, overwrite(b, 12, 0, {10, 20}, failed(Status::inconsistent)))));
  EXPECT_FALSE(accepted(with(history, overwrite(b, 12, 0, {10, 20}, at_version(1)))));
  EXPECT_FALSE(accepted(with(history, overwrite(b, 12, 0, {10, 20}, at_version(2)))));
}

TEST(Checker, NothingOutlivesTheLossOfItsWorkingMemory) {
  History history{added, loss(100, 50, {10, 12})};
  EXPECT_TRUE(accepted(with(history, read(b, {5, 9}, saw(0, 10)))));
  EXPECT_TRUE(accepted(with(history, read(b, {9, 13}, saw(0, 10)))));
  EXPECT_FALSE(accepted(with(history, read(b, {13, 15}, saw(0, 10)))));
  EXPECT_TRUE(accepted(with(history, read(b, {13, 15}, failed(Status::does_not_exist)))));
  EXPECT_FALSE(accepted(with(history, read(b, {5, 9}, failed(Status::does_not_exist)))));
  // What was under way may have been done before, after, or not at all.
  EXPECT_TRUE(accepted(with(history, overwrite(b, 11, 0, {9, never}))));
  auto again = with(history, add(b, 12, {9, never}));
  EXPECT_TRUE(accepted(with(again, read(c, {13, 15}, saw(100, 12)))));
  EXPECT_FALSE(accepted(with(again, read(c, {13, 15}, saw(0, 12)))));
}

TEST(Checker, AfterALossVersionsAndTokensAreHigherThanEverBefore) {
  History history{added, lock(a, o, {3, 4}, obtained(1)), loss(100, 50, {10, 12})};
  EXPECT_FALSE(accepted(with(history, add(b, 11, {13, 14}, at_version(1)))));
  history = with(history, add(b, 11, {13, 14}, at_version(100)));
  EXPECT_TRUE(accepted(with(history, overwrite(b, 12, 100, {15, 16}, at_version(101)))));
  // Nobody has a lease any more.
  EXPECT_TRUE(
    accepted(with(history, overwrite(a, 12, 100, {15, 16}, failed(Status::stale), Token{1}))));
  EXPECT_FALSE(accepted(with(history, overwrite(a, 12, 100, {15, 16}, at_version(101), Token{1}))));
  EXPECT_TRUE(accepted(with(history, lock(b, o, {15, 16}, obtained(51)))));
  EXPECT_FALSE(accepted(with(history, lock(b, o, {15, 16}, obtained(2)))));
}

TEST(Checker, WhoWaitsWhenItsWorkingMemoryIsLostIsNeverAnswered) {
  History history{added, locked, loss(100, 50, {10, 12})};
  EXPECT_TRUE(accepted(with(history, read(b, {5, never}))));
  EXPECT_TRUE(accepted(with(history, lock(b, o, {5, never}))));
  EXPECT_FALSE(accepted(with(history, read(b, {5, 20}, saw(0, 10)))));
}

TEST(Checker, AWorkingMemoryMayBeginWithWhatIsLeftOfTheEntry) {
  History history{added, overwrite(a, 11, 0, {3, 4}, at_version(1)),
                  loss({.version = 100, .content = 10}, 50, {10, 12})};
  EXPECT_TRUE(accepted(with(history, read(b, {5, 9}, saw(1, 11)))));
  EXPECT_FALSE(accepted(with(history, read(b, {13, 15}, saw(1, 11)))));
  EXPECT_TRUE(accepted(with(history, read(b, {13, 15}, saw(100, 10)))));
  EXPECT_FALSE(accepted(with(history, read(b, {13, 15}, failed(Status::does_not_exist)))));
  EXPECT_TRUE(accepted(with(history, overwrite(b, 12, 100, {13, 15}, at_version(101)))));
  EXPECT_TRUE(accepted(with(history, overwrite(b, 12, 1, {13, 15}, failed(Status::inconsistent)))));
}

TEST(Checker, AWorkingMemoryMayBeginWithTheVersionOfADeletedEntry) {
  History history{added, loss({.status = Status::does_not_exist, .version = 100}, 50, {10, 12})};
  EXPECT_TRUE(accepted(with(history, read(b, {13, 15}, failed(Status::does_not_exist)))));
  EXPECT_TRUE(accepted(with(history, version(b, {13, 15}, at_version(100)))));
  EXPECT_TRUE(accepted(with(history, add(b, 12, {13, 15}, at_version(101)))));
  EXPECT_FALSE(accepted(with(history, add(b, 12, {13, 15}, at_version(100)))));
}

TEST(Checker, TheOrderOfTheRecordsMeansNothing) {
  EXPECT_TRUE(
    accepted({read(b, {21, 25}, saw(1, 11)), overwrite(a, 11, 0, {10, 20}, at_version(1)), added}));
}

TEST(Checker, EveryEntryIsForItself) {
  History history{on_entry(1, added), on_entry(7, add(a, 20, {1, 2}, at_version(0))),
                  on_entry(1, lock(a, od, {3, 4}, obtained(1))),
                  on_entry(7, lock(b, od, {3, 4}, obtained(1)))};
  EXPECT_TRUE(accepted(history));
  auto verdict = Checker{}.check(with(history, on_entry(7, remove(a, {5, 6}, at_version(0)))));
  EXPECT_EQ(verdict.kind, Verdict::Kind::violation);
  EXPECT_THAT(verdict.report, HasSubstr("entry 7"));
}

TEST(Checker, PendingOperationsMayHaveHappenedOrNot) {
  History history{added, overwrite(a, 11, 0, {10})};
  EXPECT_TRUE(accepted(with(history, read(b, {21, 25}, saw(0, 10)))));
  EXPECT_TRUE(accepted(with(history, read(b, {21, 25}, saw(1, 11)))));
  EXPECT_FALSE(accepted(with(history, read(b, {5, 9}, saw(1, 11)))));
  EXPECT_FALSE(
    accepted(with(with(history, read(b, {21, 25}, saw(1, 11))), read(c, {31, 35}, saw(0, 10)))));
  EXPECT_FALSE(accepted({added, remove(a, {10}), read(b, {21, 25}, saw(1, 11))}));
}

TEST(Checker, APendingLockMayHaveObtainedTheLease) {
  History history{added, lock(b, od, {10})};
  EXPECT_TRUE(accepted(with(history, try_lock(c, o, {20, 21}, obtained(1)))));
  EXPECT_TRUE(accepted(with(history, try_lock(c, o, {20, 21}, failed(Status::busy)))));
  // Its token comes to light when the holder locks again, and others are higher.
  history = with(with(history, try_lock(b, o, {20, 21}, obtained(7))),
                 overwrite(c, 11, 0, {30, 31}, failed(Status::locked)));
  EXPECT_TRUE(accepted(history));
  history.push_back(unlock(b, 7, {40, 41}));
  EXPECT_TRUE(accepted(with(history, try_lock(c, o, {50, 51}, failed(Status::busy)))));
  history.push_back(unlock(b, 7, {60, 61}));
  EXPECT_TRUE(accepted(with(history, try_lock(c, o, {70, 71}, obtained(8)))));
  EXPECT_FALSE(accepted(with(history, try_lock(c, o, {70, 71}, obtained(7)))));
}

TEST(Checker, APendingLockInTheQueueTakesItsTurn) {
  History history{added, locked, lock(b, o, {10}), unlock(a, 1, {30, 31})};
  EXPECT_TRUE(accepted(with(history, try_lock(c, o, {40, 41}, obtained(2)))));
  history.push_back(try_lock(c, o, {40, 41}, failed(Status::busy)));
  EXPECT_TRUE(accepted(history));
  EXPECT_FALSE(accepted(with(history, try_lock(c, o, {70, 71}, obtained(3)))));
  history.push_back(lapse(b, 0, {50, 60}));
  EXPECT_TRUE(accepted(with(history, try_lock(c, o, {70, 71}, obtained(3)))));
}

TEST(Checker, AnotherIsServedAfterAPendingLockWhoseTokenComesToLight) {
  History history{added,
                  locked,
                  lock(b, o, {10}),
                  queued_by(25, lock(c, o, {20, 60}, obtained(8))),
                  unlock(a, 1, {30, 31}),
                  try_lock(b, o, {40, 41}, obtained(7)),
                  unlock(b, 7, {45, 46})};
  EXPECT_TRUE(accepted(with(history, unlock(b, 7, {50, 51}))));
  EXPECT_FALSE(accepted(history));
}

TEST(Checker, NobodyShowsATokenThatNobodyWasTold) {
  History history{added, lock(b, o, {10}), try_lock(c, o, {20, 21}, failed(Status::busy))};
  EXPECT_FALSE(accepted(with(history, unlock(b, 1, {30, 31}))));
  EXPECT_TRUE(accepted(with(history, unlock(b, 1, {30, 31}, failed(Status::stale)))));
}

TEST(Checker, OvertakingIsAViolationOnlyWhereArrivalIsProven) {
  auto first = lock(b, o, {10, 100}, obtained(3));
  auto second = lock(c, o, {20, 90}, obtained(2));
  History history{added, locked, unlock(a, 1, {50, 51}), unlock(c, 2, {91, 92})};
  EXPECT_TRUE(accepted(with(with(history, first), second)));
  EXPECT_TRUE(accepted(with(with(history, queued_by(20, first)), second)));
  EXPECT_FALSE(accepted(with(with(history, queued_by(19, first)), second)));
  EXPECT_TRUE(accepted(with(with(history, queued_by(25, first)), queued_by(40, second))));
}

TEST(Checker, ALockThatArrivedIsNotPassedOverByATryLock) {
  History history{added, locked, queued_by(19, lock(b, o, {10, 100}, obtained(3))),
                  unlock(a, 1, {50, 51})};
  EXPECT_FALSE(
    accepted(with(with(history, try_lock(c, o, {60, 61}, obtained(2))), unlock(c, 2, {62, 63}))));
  EXPECT_TRUE(accepted(with(history, try_lock(c, o, {60, 61}, failed(Status::busy)))));
}

TEST(Checker, AReadThatArrivedBeforeALockSeesNothingOfTheHoldersWork) {
  auto reads = read(c, {10, 100}, saw(1, 11));
  History history{added,
                  locked,
                  lock(b, odr, {20, 60}, obtained(2)),
                  unlock(a, 1, {50, 51}),
                  overwrite(b, 11, 0, {70, 71}, at_version(1), 2),
                  unlock(b, 2, {80, 81})};
  EXPECT_TRUE(accepted(with(history, reads)));
  EXPECT_FALSE(accepted(with(history, queued_by(15, reads))));
  reads.result = saw(0, 10);
  EXPECT_TRUE(accepted(with(history, queued_by(15, reads))));
}

TEST(Checker, NobodyReadsWhatIsLeasedAtOdr) {
  History history{added, locked, overwrite(a, 11, 0, {10, 11}, at_version(1), 1),
                  unlock(a, 1, {30, 40})};
  EXPECT_FALSE(accepted(with(history, read(b, {5, 9}, saw(0, 10)))));
  EXPECT_FALSE(accepted(with(history, read(b, {5, 29}, saw(1, 11)))));
  EXPECT_TRUE(accepted(with(history, read(b, {5, 31}, saw(1, 11)))));
  // It may have come before the lease.
  EXPECT_TRUE(accepted(with(history, read(b, {3, 9}, saw(0, 10)))));
}

TEST(Checker, ThereAreNotTwoHolders) {
  History history{added, locked};
  EXPECT_FALSE(accepted(with(history, lock(b, o, {5, 20}, obtained(2)))));
  EXPECT_FALSE(accepted(with(history, lock(b, o, {3, 20}, obtained(2)))));
  EXPECT_FALSE(accepted(with(history, lock(b, o, {3, 20}, obtained(1)))));
  EXPECT_TRUE(
    accepted(with(with(history, lock(b, o, {5, 20}, obtained(2))), unlock(a, 1, {15, 25}))));
  EXPECT_FALSE(
    accepted(with(with(history, lock(b, o, {5, 20}, obtained(2))), unlock(a, 1, {21, 25}))));
}

TEST(Checker, AnOptionalLapseMayHaveEndedTheLease) {
  History history{added, locked, lapse(a, 1, {10, 20})};
  EXPECT_TRUE(accepted(history));
  EXPECT_TRUE(accepted(with(history, try_lock(b, o, {15, 16}, obtained(2)))));
  EXPECT_TRUE(accepted(with(history, try_lock(b, o, {30, 31}, obtained(2)))));
  EXPECT_TRUE(accepted(with(history, try_lock(b, o, {30, 31}, failed(Status::busy)))));
  EXPECT_FALSE(accepted(with(history, try_lock(b, o, {5, 9}, obtained(2)))));
  // Too late for the lapse.
  EXPECT_FALSE(accepted(with(with(history, try_lock(b, o, {30, 31}, failed(Status::busy))),
                             try_lock(c, o, {40, 41}, obtained(2)))));
}

TEST(Checker, AMandatoryLapseHasEndedTheLease) {
  History history{added, locked, mandatory_lapse(a, 1, {10, 20})};
  EXPECT_TRUE(accepted(history));
  EXPECT_TRUE(accepted(with(history, try_lock(b, o, {30, 31}, obtained(2)))));
  EXPECT_FALSE(accepted(with(history, try_lock(b, o, {30, 31}, failed(Status::busy)))));
  EXPECT_TRUE(accepted(with(history, try_lock(b, o, {15, 31}, failed(Status::busy)))));
  EXPECT_TRUE(accepted(with(history, unlock(a, 1, {5, 6}))));
  EXPECT_TRUE(accepted(with(history, unlock(a, 1, {30, 31}, failed(Status::stale)))));
  EXPECT_FALSE(accepted(with(history, unlock(a, 1, {30, 31}))));
}

TEST(Checker, APausedHolderThatComesBackCannotWrite) {
  History history{added, locked, mandatory_lapse(a, 1, {10, 20}), lock(b, o, {5, 25}, obtained(2))};
  EXPECT_FALSE(accepted(with(history, overwrite(a, 11, 0, {30, 31}, at_version(1), 1))));
  EXPECT_TRUE(accepted(with(history, overwrite(a, 11, 0, {30, 31}, failed(Status::stale), 1))));
  EXPECT_FALSE(accepted(with(history, overwrite(a, 11, 0, {30, 31}, failed(Status::locked), 1))));
}

TEST(Checker, ALapseWithoutATokenEndsWhicheverLeaseTheHolderHas) {
  History history{added, lock(b, o, {5}), mandatory_lapse(b, 0, {20, 30})};
  auto busy = try_lock(c, o, {10, 11}, failed(Status::busy));
  EXPECT_TRUE(accepted(with(with(history, busy), try_lock(c, o, {40, 41}, obtained(9)))));
  EXPECT_TRUE(accepted(with(history, try_lock(c, o, {40, 41}, obtained(9)))));
  EXPECT_FALSE(accepted(with(with(with(history, busy), unlock(b, 1, {12, 13})),
                             try_lock(c, o, {40, 41}, obtained(9)))));
}

TEST(Checker, AWaiterIsWokenByADeletionAndNotBefore) {
  auto gone = failed(Status::does_not_exist);
  History history{added, locked, queued_by(11, lock(b, o, {10, 30}, gone))};
  EXPECT_TRUE(accepted(with(history, remove(a, {20, 40}, at_version(0), 1))));
  EXPECT_FALSE(accepted(with(history, remove(a, {31, 40}, at_version(0), 1))));
  // After the unlocking it was its turn.
  EXPECT_FALSE(
    accepted(with(with(history, unlock(a, 1, {12, 13})), remove(a, {20, 25}, at_version(0)))));
}

TEST(Checker, TellsHowFarItCame) {
  auto verdict = Checker{}.check(
    History{added, locked, queued_by(11, lock(b, o, {10, 30}, obtained(3))),
            queued_by(13, lock(c, o, {12, 30}, obtained(2))), unlock(a, 1, {20, 21}),
            overwrite(d, 11, 0, {15, 16}, failed(Status::locked))});
  EXPECT_EQ(verdict.kind, Verdict::Kind::violation);
  EXPECT_THAT(verdict.report,
              AllOf(HasSubstr("client 1 add content 10 -> version 0 [1, 2]"),
                    HasSubstr("leased at level ODR to client 1, token 1"),
                    HasSubstr("client 2 lock O -> token 3 [10, 30; queued by 11]")));
}

TEST(Checker, TellsWhatWouldHaveBeenRight) {
  auto verdict = Checker{}.check(History{added, read(b, {3, 4}, saw(0, 77))});
  EXPECT_EQ(verdict.report, "entry 0: no order of its operations explains their results\n"
                            "  placed 1 of 2:\n"
                            "    client 1 add content 10 -> version 0 [1, 2]\n"
                            "  then it stands at: version 0, content 10\n"
                            "  waiting:\n"
                            "  none of these can come next:\n"
                            "    client 2 read -> version 0, content 77 [3, 4]\n"
                            "      now: version 0, content 10\n");
}

TEST(Checker, SaysSoWhenItGivesUp) {
  auto verdict = Checker{{.max_states = 1}}.check(History{
    added, overwrite(a, 11, 0, {3, 4}, at_version(1)), overwrite(a, 12, 1, {5, 6}, at_version(2))});
  EXPECT_EQ(verdict.kind, Verdict::Kind::undecided);
  EXPECT_THAT(verdict.report, HasSubstr("no order found in 2 states"));
}

TEST(Checker, AViolationOutweighsWhatCouldNotBeDecided) {
  History history{on_entry(0, added), on_entry(0, locked)};
  for (Client client = 10; client < 10 + EntryState::max_waiting + 1; ++client)
    history.push_back(on_entry(0, queued_by(9, read(client, {8, 100}, saw(0, 10)))));
  auto verdict = Checker{}.check(history);
  EXPECT_EQ(verdict.kind, Verdict::Kind::undecided);
  EXPECT_THAT(verdict.report, HasSubstr("more than 32 operations wait"));
  history.push_back(on_entry(1, read(b, {3, 4}, saw(0, 10))));
  EXPECT_EQ(Checker{}.check(history).kind, Verdict::Kind::violation);
}

TEST(Checker, RefusesRecordsThatEndBeforeTheyBegin) {
  EXPECT_THROW(Checker{}.check(History{read(a, {4, 3})}), std::invalid_argument);
  EXPECT_THROW(Checker{}.check(History{queued_by(3, read(a, {4, 5}))}), std::invalid_argument);
}

TEST(Checker, CanBeUsedAgain) {
  Checker checker;
  History bad{read(b, {3, 4}, saw(0, 77))};
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(checker.check(History{added, locked}).ok());
    EXPECT_FALSE(checker.check(bad).ok());
  }
}

} // namespace castor::linearizability
