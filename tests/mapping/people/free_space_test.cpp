// Where it was free, so that what is there now has moved.

#include "castor/mapping/people/free_space.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace castor::mapping {

namespace {

/// A wall 5 m ahead, seen through a narrow opening.
std::vector<Point2> wall() {
  std::vector<Point2> result;
  for (double y = -1; y <= 1; y += 0.05)
    result.push_back({5, y});
  return result;
}

} // namespace

TEST(FreeSpace, IsWhereBeamsHavePassed) {
  FreeSpace space{{}};
  EXPECT_FALSE(space.was_free({3, 0})) << "nothing is known yet";
  for (int i = 0; i < 5; ++i)
    space.add({0, 0}, wall(), {});
  EXPECT_TRUE(space.was_free({3, 0}));
  EXPECT_FALSE(space.was_free({5, 0})) << "the wall";
  EXPECT_FALSE(space.was_free({4.92, 0})) << "beside the wall";
  EXPECT_FALSE(space.was_free({5.5, 0})) << "behind it";
  EXPECT_FALSE(space.was_free({3, 3})) << "where no beam was";
}

TEST(FreeSpace, ThingsThatArePutThereAreThingsAfterAWhile) {
  FreeSpace space{{}};
  const std::vector<Point2> thing{{3, 0}};
  for (int i = 0; i < 60; ++i)
    space.add({0, 0}, wall(), {});
  for (int i = 0; i < 50; ++i)
    space.add({0, 0}, thing, {});
  EXPECT_TRUE(space.was_free({3, 0}));
  for (int i = 0; i < 60; ++i)
    space.add({0, 0}, thing, {});
  EXPECT_FALSE(space.was_free({3, 0}));
}

TEST(FreeSpace, PeopleAreNoThingsHoweverLongTheyStand) {
  FreeSpace space{{}};
  const std::vector<Point2> person{{3, 0}};
  for (int i = 0; i < 60; ++i)
    space.add({0, 0}, wall(), {});
  for (int i = 0; i < 1000; ++i)
    space.add({0, 0}, {}, person);
  EXPECT_TRUE(space.was_free({3, 0}));
}

} // namespace castor::mapping
