#include "castor/actors/runtime/served_calls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Address first{"a", "1"};
const Address second{"b", "1"};

TEST(ServedCalls, AreKeptUntilTheyAreBothFinishedAndOver) {
  ServedCalls calls;
  EXPECT_TRUE(calls.begin(first));
  EXPECT_FALSE(calls.begin(first)) << "it is being served";
  calls.finish(first);
  EXPECT_THAT(calls.take_ended(), IsEmpty());
  EXPECT_FALSE(calls.is_over(first));
  calls.deleted(first);
  EXPECT_TRUE(calls.is_over(first));
  EXPECT_THAT(calls.take_ended(), ElementsAre(first));
  EXPECT_THAT(calls.take_ended(), IsEmpty());
}

TEST(ServedCalls, MayBeOverBeforeTheyAreFinished) {
  ServedCalls calls;
  calls.begin(first);
  calls.deleted(first);
  EXPECT_TRUE(calls.is_over(first));
  EXPECT_THAT(calls.take_ended(), IsEmpty());
  calls.finish(first);
  EXPECT_THAT(calls.take_ended(), ElementsAre(first));
}

TEST(ServedCalls, AreOverOnceTheirWorkingMemoryIsLost) {
  ServedCalls calls;
  calls.begin(first);
  calls.begin(second);
  calls.memory_lost("b");
  calls.finish(first);
  calls.finish(second);
  EXPECT_FALSE(calls.is_over(first));
  EXPECT_THAT(calls.take_ended(), ElementsAre(second));
}

TEST(ServedCalls, WhatIsNotServedIsIgnored) {
  ServedCalls calls;
  calls.deleted(first);
  calls.finish(first);
  EXPECT_FALSE(calls.is_over(first));
  calls.begin(first);
  calls.abandon(first);
  calls.deleted(first);
  EXPECT_THAT(calls.take_ended(), IsEmpty());
  EXPECT_TRUE(calls.begin(first));
}

} // namespace

} // namespace castor::test
