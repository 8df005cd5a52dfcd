#include "castor/planning/tabletop/things_in_way.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::planning {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

bool any(const std::string&) {
  return true;
}

} // namespace

TEST(ThingsInWay, AreToBeMovedBefore) {
  ThingsInWay things;
  things.refused("ball", {"box", "can"});
  EXPECT_THAT(things.facts(any), ElementsAre("(in-way box ball)", "(in-way can ball)"));
  // One of them alone does not help.
  EXPECT_THAT(things.facts([](const auto& x) { return x == "box"; }), IsEmpty());
  things.moved("can");
  EXPECT_THAT(things.facts(any), IsEmpty());
}

TEST(ThingsInWay, WhatWasMovedIsNotHinderedAnyMore) {
  ThingsInWay things;
  things.refused("ball", {"box"});
  things.moved("ball");
  EXPECT_THAT(things.facts(any), IsEmpty());
}

/// Or it would be moved back and forth for ever.
TEST(ThingsInWay, WhatIsStillInTheWayAfterItWasMovedTwiceIsLeftThere) {
  ThingsInWay things;
  for (int i = 0; i < 2; ++i) {
    things.refused("ball", {"box"});
    EXPECT_THAT(things.facts(any), ElementsAre("(in-way box ball)"));
    things.moved("box");
  }
  things.refused("ball", {"box"});
  EXPECT_THAT(things.facts(any), IsEmpty());
  things.refused("can", {"box"});
  EXPECT_THAT(things.facts(any), ElementsAre("(in-way box can)"));
  things.clear();
  things.refused("ball", {"box"});
  EXPECT_THAT(things.facts(any), ElementsAre("(in-way box ball)"));
}

TEST(ThingsInWay, OneOfThemIsTheFirst) {
  ThingsInWay things;
  things.refused("ball", {"box"});
  things.refused("box", {"ball"});
  things.refused("can", {"can"});
  things.refused("cup", {});
  EXPECT_THAT(things.facts(any), ElementsAre("(in-way box ball)"));
}

} // namespace castor::planning
