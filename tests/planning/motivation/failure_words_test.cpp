#include "castor/planning/motivation/failure_words.hpp"

#include <gtest/gtest.h>

namespace castor::planning {

TEST(FailureWords, NameNoStepsThingsOrPlacesOfPlans) {
  EXPECT_EQ(failure_in_words("it failed 2 times in a row without a step that succeeded, the last "
                             "time because 'move robot vision/object/4:b place-9' failed: the cup "
                             "slipped out of the gripper"),
            "the cup slipped out of the gripper");
  EXPECT_EQ(failure_in_words("'take robot x' failed: it is not seen any more"),
            "it is not seen any more");
  EXPECT_EQ(failure_in_words("it failed 3 times in a row without a step that succeeded, the last "
                             "time because 'move robot a place-2' is not possible any more"),
            "things have changed meanwhile");
  EXPECT_EQ(failure_in_words("vision/object/3 is not at place-1"),
            "something has gone wrong that I cannot put into words");
  EXPECT_EQ(failure_in_words("there is no room"), "there is no room");
}

} // namespace castor::planning
