#include "castor/mapping/movement/movement_queue.hpp"

#include <gtest/gtest.h>

namespace castor::mapping {

namespace {

const Address first_request{"asking", "1"};
const Address second_request{"asking", "2"};
const Address stop{"asking", "3"};

TEST(MovementQueue, AnUrgentActionClearsWhatRunsAndWhatWaits) {
  MovementQueue x;
  x.arrive(first_request, MovementPriority::normal);
  EXPECT_TRUE(x.begin(first_request));
  x.arrive(second_request, MovementPriority::high);
  EXPECT_FALSE(x.is_cleared());
  x.arrive(stop, MovementPriority::urgent);
  EXPECT_TRUE(x.is_cleared());
  x.end();
  EXPECT_FALSE(x.begin(second_request));
  EXPECT_TRUE(x.begin(stop));
  EXPECT_FALSE(x.is_cleared());
  x.end();
  x.arrive(second_request, MovementPriority::normal);
  EXPECT_TRUE(x.begin(second_request)) << "asked for anew";
}

TEST(MovementQueue, AnUrgentActionThatHasBegunBeforeItIsToldDoesNotClearItself) {
  MovementQueue x;
  EXPECT_TRUE(x.begin(stop));
  x.arrive(stop, MovementPriority::urgent);
  EXPECT_FALSE(x.is_cleared());
}

} // namespace

} // namespace castor::mapping
