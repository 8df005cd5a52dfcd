#include "castor/wm/store/lifetimes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

namespace castor::test {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StrEq;

namespace {

const ClientPtr ann = std::make_shared<const Client>(Client{"ann", "a", 1});
const ClientPtr bob = std::make_shared<const Client>(Client{"bob", "a", 1});

} // namespace

TEST(Lifetimes, EndSoLongAfterTheLastWrite) {
  Lifetimes x;
  x.add("a", 10ms, nullptr, 0ms);
  EXPECT_EQ(x.next_due(), Timestamp{10ms});
  x.restart("a", 10ms, 5ms);
  EXPECT_THAT(x.due(14ms), IsEmpty());
  EXPECT_THAT(x.due(15ms), ElementsAre("a"));
  EXPECT_THAT(x.source("a"), StrEq(expiry_source));
  x.restart("a", 0ms, 6ms);
  EXPECT_FALSE(x.next_due()) << "it ends no more";
}

TEST(Lifetimes, EndWithTheOwner) {
  Lifetimes x;
  x.add("a", 0ms, ann, 0ms);
  x.add("b", 0ms, bob, 0ms);
  EXPECT_EQ(x.owner("a"), ann);
  EXPECT_FALSE(x.next_due());
  x.end_owner(*ann, 7ms);
  EXPECT_THAT(x.due(7ms), ElementsAre("a"));
  EXPECT_THAT(x.source("a"), StrEq(owner_ended_source));
}

TEST(Lifetimes, AWriteDoesNotSaveAnEntryWhoseOwnerHasEnded) {
  Lifetimes x;
  x.add("a", 10ms, ann, 0ms);
  x.end_owner(*ann, 1ms);
  x.restart("a", 10ms, 2ms);
  EXPECT_THAT(x.due(2ms), ElementsAre("a"));
}

TEST(Lifetimes, AnOrphanIsDueAtOnce) {
  Lifetimes x;
  x.add("a", 10ms, nullptr, 0ms);
  x.orphan("a", 3ms);
  EXPECT_EQ(x.next_due(), Timestamp{3ms});
  EXPECT_THAT(x.source("a"), StrEq(owner_ended_source));
}

TEST(Lifetimes, APostponedEntryIsDueLaterForTheSameReason) {
  Lifetimes x;
  x.add("a", 0ms, ann, 0ms);
  x.end_owner(*ann, 1ms);
  x.postpone("a", 9ms);
  EXPECT_THAT(x.due(8ms), IsEmpty());
  EXPECT_THAT(x.due(9ms), ElementsAre("a"));
  EXPECT_THAT(x.source("a"), StrEq(owner_ended_source));
}

TEST(Lifetimes, AWillIsDueWhenItsClientEnds) {
  Lifetimes x;
  x.add("a", 0ms, nullptr, 0ms);
  x.set_will("a", ann, {Value::of(Address{}), {}});
  EXPECT_EQ(x.owner("a"), ann);
  x.end_owner(*bob, 1ms);
  EXPECT_FALSE(x.next_due());
  x.end_owner(*ann, 2ms);
  EXPECT_THAT(x.due(2ms), ElementsAre("a"));
  EXPECT_THAT(x.source("a"), StrEq(last_will_source));
  ASSERT_TRUE(x.due_will("a"));
  x.fulfil("a", 10ms, 2ms);
  EXPECT_EQ(x.owner("a"), nullptr);
  EXPECT_EQ(x.next_due(), Timestamp{12ms});
  EXPECT_THAT(x.source("a"), StrEq(expiry_source));
  EXPECT_FALSE(x.due_will("a"));
}

TEST(Lifetimes, AnEmptyWillWithdrawsTheFormer) {
  Lifetimes x;
  x.add("a", 0ms, nullptr, 0ms);
  x.set_will("a", ann, {Value::of(Address{}), {}});
  x.set_will("a", bob, {});
  x.end_owner(*ann, 1ms);
  x.end_owner(*bob, 1ms);
  EXPECT_FALSE(x.next_due());
}

TEST(Lifetimes, AnOwnersEndDeletesAnEntryWhateverItsWill) {
  Lifetimes x;
  x.add("a", 0ms, ann, 0ms);
  x.set_will("a", ann, {Value::of(Address{}), {}});
  x.end_owner(*ann, 1ms);
  EXPECT_THAT(x.source("a"), StrEq(owner_ended_source));
  EXPECT_FALSE(x.due_will("a"));
}

TEST(Lifetimes, TheLongestDueComeFirstAndTheDeletedNotAtAll) {
  Lifetimes x;
  x.add("a", 30ms, nullptr, 0ms);
  x.add("b", 10ms, nullptr, 0ms);
  x.add("c", 20ms, ann, 0ms);
  x.erase("c");
  x.end_owner(*ann, 0ms);
  EXPECT_THAT(x.due(1s), ElementsAre("b", "a"));
  EXPECT_EQ(x.owner("c"), nullptr);
}

} // namespace castor::test
