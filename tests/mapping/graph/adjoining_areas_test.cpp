#include "castor/mapping/graph/adjoining_areas.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

namespace castor::mapping::test {

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Pair = std::pair<std::int64_t, std::int64_t>;

GraphNode place_of_area(std::int64_t id, std::int64_t area) {
  GraphNode result;
  result.id = id;
  result.area = area;
  return result;
}

GraphNode door(std::int64_t id) {
  GraphNode result;
  result.id = id;
  result.kind = NodeKind::gateway;
  return result;
}

TEST(AdjoiningAreas, AreThoseOnBothSidesOfAGatewayAndThoseWithPlacesNextToEachOther) {
  const auto result =
    adjoining_areas({place_of_area(1, 5), door(2), place_of_area(3, 0), place_of_area(4, 0), place_of_area(6, 7), door(8)},
                    {{1, 2, 1}, {2, 3, 1}, {3, 4, 1}, {4, 6, 1}, {6, 8, 1}});
  EXPECT_THAT(result, ElementsAre(Pair{0, 5}, Pair{0, 7}));
}

TEST(AdjoiningAreas, AreNoneWithoutKnownPlaces) {
  EXPECT_THAT(adjoining_areas({place_of_area(1, 0)}, {{1, 2, 1}}), IsEmpty());
  EXPECT_THAT(adjoining_areas({}, {}), IsEmpty());
}

} // namespace

} // namespace castor::mapping::test
