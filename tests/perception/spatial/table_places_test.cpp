#include "castor/perception/spatial/table_places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::spatial {

namespace {

constexpr GroundPoint seat{0, -0.62};

/// A ball at the left, a box in the middle, a disc behind it.
const std::vector<TableObject> three{
  {{-0.2, 0}, 0.03, false}, {{0, 0}, 0.04, true}, {{0, 0.11}, 0.05, true}};

constexpr std::size_t red_ball = 0;
constexpr std::size_t blue_box = 1;
constexpr std::size_t flat_disc = 2;

GroundPoint place_of(const TablePlaces& table, std::size_t object, const PlaceWanted& wanted) {
  const auto found = table.find(object, std::vector{wanted});
  EXPECT_EQ(found.targets.size(), 1U) << wanted.relation << ": " << found.reason;
  return found.targets.empty() ? GroundPoint{} : found.targets.front().position;
}

} // namespace

TEST(TablePlaces, DirectionsAreThoseOfTheViewer) {
  const TablePlaces table{three, seat};
  EXPECT_GT(place_of(table, red_ball, {"right", {blue_box}}).x, 0.04);
  EXPECT_LT(place_of(table, flat_disc, {"left", {blue_box}}).x, -0.04);
  EXPECT_LT(place_of(table, red_ball, {"front", {blue_box}}).y, -0.04);
  EXPECT_GT(place_of(table, red_ball, {"back", {flat_disc}}).y, 0.19);
  EXPECT_TRUE(table.holds({"left", {blue_box}}, red_ball));
  EXPECT_FALSE(table.holds({"right", {blue_box}}, red_ball));
}

/// To a viewer who is near, what is in front of a thing at a side seems to be beside it.
TEST(TablePlaces, DirectionsAreThoseOfTheTableAsWell) {
  constexpr GroundPoint near_seat{0, -0.34};
  for (const double side : {-1.0, 1.0}) {
    const std::vector<TableObject> objects{{{side * 0.20, -0.24}, 0.03},
                                           {{side * 0.16, -0.09}, 0.03}};
    const TablePlaces table{objects, near_seat};
    const PlaceWanted beside{side < 0 ? "left" : "right", {1}};
    EXPECT_GT(angle_fit(side < 0 ? SpatialRelation::left : SpatialRelation::right,
                        objects[0].centre, objects[1].centre, near_seat),
              0.5);
    EXPECT_FALSE(table.holds(beside, 0));
    const auto at = place_of(table, 0, beside);
    EXPECT_GT(side * at.x - 0.16, std::abs(at.y + 0.09));
  }
}

TEST(TablePlaces, NothingIsPutWhereAnotherThingStands) {
  const TablePlaces table{three, seat};
  for (const auto* relation : {"left", "right", "front", "back", "near"}) {
    const auto found = table.find(red_ball, std::vector{PlaceWanted{relation, {blue_box}}}, 3);
    ASSERT_FALSE(found.targets.empty()) << relation;
    for (const auto& target : found.targets) {
      EXPECT_GE(distance(target.position, three[blue_box].centre), 0.03 + 0.04 + 0.02);
      EXPECT_GE(distance(target.position, three[flat_disc].centre), 0.03 + 0.05 + 0.02);
      EXPECT_GT(target.value, 0);
    }
  }
}

TEST(TablePlaces, BetweenTwoIsInTheMiddleOfThem) {
  const std::vector<TableObject> objects{{{-0.1, 0}, 0.03}, {{0.1, 0}, 0.03}, {{0, 0.2}, 0.03}};
  const auto at = place_of(TablePlaces{objects, seat}, 2, {"between", {0, 1}});
  EXPECT_NEAR(at.x, 0, 0.011);
  EXPECT_NEAR(at.y, 0, 0.011);
}

TEST(TablePlaces, BetweenTwoThatTouchThereIsNoRoom) {
  const std::vector<TableObject> objects{{{-0.03, 0}, 0.03}, {{0.03, 0}, 0.03}, {{0, 0.2}, 0.03}};
  const auto found =
    TablePlaces{objects, seat}.find(2, std::vector{PlaceWanted{"between", {0, 1}}});
  EXPECT_TRUE(found.targets.empty());
  EXPECT_EQ(found.reason, "there is no room");
}

TEST(TablePlaces, OnAFlatThingOnly) {
  const TablePlaces table{three, seat};
  const auto found = table.find(red_ball, std::vector{PlaceWanted{"on", {blue_box}}});
  ASSERT_EQ(found.targets.size(), 1U);
  EXPECT_EQ(found.on, blue_box);
  EXPECT_EQ(found.targets.front().position, three[blue_box].centre);
  EXPECT_EQ(table.find(blue_box, std::vector{PlaceWanted{"on", {red_ball}}}).reason,
            "it would fall off: the top is not flat");
  EXPECT_EQ(table.find(blue_box, std::vector{PlaceWanted{"on", {blue_box}}}).reason,
            "nothing can stand on itself");
}

TEST(TablePlaces, OnATowerButNotOnWhatIsBelow) {
  const std::vector<TableObject> objects{{{0, 0}, 0.03, true, 0, 0.05},
                                         {{0, 0}, 0.03, true, 0.05, 0.1},
                                         {{0.2, 0}, 0.03, true, 0, 0.05}};
  const TablePlaces table{objects, seat};
  EXPECT_EQ(table.find(2, std::vector{PlaceWanted{"on", {1}}}).on, 1U);
  EXPECT_EQ(table.find(2, std::vector{PlaceWanted{"on", {0}}}).reason,
            "something stands on it already");
}

TEST(TablePlaces, PartsOfTheTable) {
  const TablePlaces table{three, seat};
  EXPECT_LT(place_of(table, blue_box, {"left-edge", {}}).x, -0.30 + 0.04 + edge_width);
  EXPECT_GT(place_of(table, blue_box, {"right", {}}).x, 0.04 - 1e-9);
  EXPECT_LT(distance(place_of(table, red_ball, {"centre", {}}), {}), 0.15);
  const auto corner = place_of(table, red_ball, {"back-right-corner", {}});
  EXPECT_GT(corner.x, 0.30 - 0.03 - edge_width);
  EXPECT_GT(corner.y, 0.26 - 0.03 - edge_width);
  EXPECT_GE(distance(place_of(table, red_ball, {"elsewhere", {}}), three[red_ball].centre), 0.12);
  const auto strip = place_of(table, red_ball, {"strip-3-of-3", {}});
  EXPECT_GT(strip.x, 0.10);
  EXPECT_THROW(table.find(red_ball, std::vector{PlaceWanted{"attic", {}}}), std::invalid_argument);
}

TEST(TablePlaces, TheMiddleOfASideIsThereAndNotAtTheTablesMiddle) {
  const TablePlaces table{three, seat};
  for (const double side : {-1.0, 1.0}) {
    const auto across = place_of(table, blue_box, {side < 0 ? "front-middle" : "back-middle", {}});
    EXPECT_GT(side * across.y, 0.06);
    EXPECT_LT(std::abs(across.x), 0.06);
    const auto along = place_of(table, blue_box, {side < 0 ? "left-middle" : "right-middle", {}});
    EXPECT_GT(side * along.x, 0.06);
    EXPECT_LT(std::abs(along.y), 0.06);
  }
  const auto edge = place_of(table, red_ball, {"front-edge-middle", {}});
  EXPECT_LT(edge.y, -0.26 + 0.03 + edge_width);
  EXPECT_LT(std::abs(edge.x), 0.05);
  EXPECT_FALSE(table.holds({"front-middle", {}}, blue_box));
  EXPECT_FALSE(table.holds({"left-edge-middle", {}}, red_ball));
  EXPECT_TRUE(table.holds({"left-middle", {}}, red_ball));
  EXPECT_THROW(table.find(red_ball, std::vector{PlaceWanted{"attic-middle", {}}}),
               std::invalid_argument);
}

/// As near to the middle of the front edge as the arm reaches.
TEST(TablePlaces, AtHandIsBeforeWhoSitsThere) {
  const std::vector<TableObject> objects{{{-0.16, 0.05}, 0.03}};
  const PlaceWanted at_hand{"at-hand", {}};
  const auto anywhere = place_of(TablePlaces{objects, seat}, 0, at_hand);
  EXPECT_LT(std::abs(anywhere.x), 0.05);
  EXPECT_LT(anywhere.y, -0.15);
  // An arm that stands there does not reach what is right before it.
  PlacingOptions options;
  options.reach = [](const GroundPoint& x) {
    return distance(x, {0, -0.26}) > 0.15 ? Reach::direct : Reach::none;
  };
  const auto reached = place_of(TablePlaces{objects, seat, options}, 0, at_hand);
  EXPECT_LT(distance(reached, {0, -0.26}), 0.18);
}

/// It goes straight to the side, as far as there is room, and clearly onto it.
TEST(TablePlaces, ToASideOfTheTableIsStraightThere) {
  const std::vector<TableObject> objects{
    {{-0.12, 0.06}, 0.0275}, {{-0.16, -0.09}, 0.03}, {{0.02, -0.02}, 0.03}, {{0.2, -0.06}, 0.03}};
  const TablePlaces table{objects, seat};
  const auto front = place_of(table, 0, {"front", {}});
  EXPECT_LT(front.y, -0.10);
  EXPECT_LT(std::abs(front.x + 0.12), 0.08);
  const auto right = place_of(table, 2, {"right", {}});
  EXPECT_GT(right.x, 0.10);
  EXPECT_LT(std::abs(right.y + 0.02), 0.08);
  const auto left_edge = place_of(table, 3, {"left-edge", {}});
  EXPECT_LT(left_edge.x, -0.30 + 0.03 + edge_width);
  EXPECT_LT(std::abs(left_edge.y + 0.06), 0.08);
}

TEST(TablePlaces, WhatIsBeyondTheEdgeIsOnThatSideOfTheTable) {
  const std::vector<TableObject> beyond{{{-0.29, -0.1}, 0.03}};
  const TablePlaces table{beyond, seat};
  for (const auto* part : {"left", "left-edge", "edge", "front", "strip-1-of-3", "table"})
    EXPECT_TRUE(table.holds({part, {}}, 0)) << part;
  for (const auto* part : {"right", "right-edge", "centre", "back"})
    EXPECT_FALSE(table.holds({part, {}}, 0)) << part;
}

TEST(TablePlaces, AllThatIsWantedHolds) {
  const TablePlaces table{three, seat};
  const std::vector<PlaceWanted> wanted{PlaceWanted{"right", {blue_box}},
                                        PlaceWanted{"front-edge", {}}};
  const auto found = table.find(red_ball, wanted);
  ASSERT_EQ(found.targets.size(), 1U);
  for (const auto& x : wanted)
    EXPECT_GT(table.fit(x, red_ball, found.targets.front().position), 0);
  const std::vector<PlaceWanted> both_edges{PlaceWanted{"left-edge", {}},
                                            PlaceWanted{"right-edge", {}}};
  EXPECT_EQ(table.find(red_ball, both_edges).reason, "there is no such place on the table");
}

/// Behind what stands there is only a strip, on either side of the table.
TEST(TablePlaces, NarrowStripAtTheEdge) {
  for (const double side : {-1.0, 1.0}) {
    const std::vector<TableObject> objects{{{side * 0.245, -0.17}, 0.028}, {{0, -0.1}, 0.028}};
    const TablePlaces table{objects, {0, -0.34}};
    const auto at = place_of(table, 1, {"back", {0}});
    EXPECT_NEAR(side * at.x, 0.272, 1e-9);
    EXPECT_GT(at.y, -0.11);
  }
}

/// Where it cannot be put directly, the best place is not passed over for one that is possible
/// neither directly nor with a stop, and what is beside it is tried as well.
TEST(TablePlaces, PlacesWithAStopBetweenAreCloseAndBeforeThoseThatAreUncertain) {
  PlacingOptions options;
  const auto is_in_front = [](const GroundPoint& at) { return at.y < -0.06 && at.y > -0.12; };
  options.reach = [&](const GroundPoint& at) {
    return is_in_front(at) ? Reach::by_stop : Reach::perhaps;
  };
  const TablePlaces table{three, seat, options};
  const std::vector<PlaceWanted> wanted{PlaceWanted{"front", {blue_box}}};
  const auto found = table.find(red_ball, wanted, 3);
  ASSERT_EQ(found.targets.size(), 3U);
  for (const auto& x : found.targets) {
    EXPECT_GT(x.position.y, -0.12);
    EXPECT_LT(distance(x.position, found.targets.front().position), 0.09);
  }
  // One by one, those that it can be put at directly are farther apart.
  options.reach = [&](const GroundPoint& at) {
    return is_in_front(at) ? Reach::direct : Reach::perhaps;
  };
  const auto direct = TablePlaces{three, seat, options}.find(red_ball, wanted, 2);
  ASSERT_EQ(direct.targets.size(), 2U);
  EXPECT_GE(distance(direct.targets[0].position, direct.targets[1].position),
            options.likely_apart - 1e-9);
  // Then come those beside them, and only then those that are uncertain.
  const auto more = TablePlaces{three, seat, options}.find(red_ball, wanted, 12).targets;
  const auto is_direct = [&](const auto& x) { return is_in_front(x.position); };
  const auto uncertain = std::ranges::find_if_not(more, is_direct);
  EXPECT_NE(uncertain, more.end());
  EXPECT_TRUE(std::none_of(uncertain, more.end(), is_direct));
  EXPECT_TRUE(std::any_of(more.begin() + 1, uncertain, [&](const auto& x) {
    return distance(x.position, more.front().position) < options.likely_apart;
  }));
}

TEST(TablePlaces, BesideAThingIsNotFarFromIt) {
  // The first is left of the second, and far from it.
  const std::vector<TableObject> two{{{-0.24, 0.0}, 0.03}, {{0.14, 0.02}, 0.03}};
  const TablePlaces table{two, seat};
  for (const auto* relation : {"left", "right", "front", "back"}) {
    const auto at = place_of(table, 0, {relation, {1}});
    EXPECT_LT(distance(at, two[1].centre) - 0.06, 0.075) << relation;
  }
  const std::vector<std::string> none;
  const auto is_close = [&](double x, const std::string& relation, double y = 0.02) {
    const std::vector<TableObject> objects{{{x, y}, 0.03}, {{0.14, 0.02}, 0.03}};
    for (const auto& held : TablePlaces{objects, seat}.all_held(none))
      if (held.object == 0 && held.place.relation == relation)
        return held.is_close;
    return false;
  };
  EXPECT_FALSE(is_close(-0.1, "left"));
  EXPECT_TRUE(is_close(0.0, "left"));
  EXPECT_FALSE(is_close(0.01, "near"));
  EXPECT_TRUE(is_close(0.03, "near"));
  // Whoever asks for the left does not want it left of it and in front.
  EXPECT_TRUE(is_close(0.02, "left", 0.03));
  EXPECT_FALSE(is_close(0.02, "left", -0.06));
}

TEST(TablePlaces, WhatIsGivenIsAtTheMiddleHalfOfTheFrontEdge) {
  for (const double side : {-1.0, 1.0}) {
    const std::vector<TableObject> one{{{side * 0.22, 0.1}, 0.03}};
    PlacingOptions options;
    // Where it takes a stop on the way.
    options.reach = [](const GroundPoint& at) {
      return at.y < -0.05 ? Reach::by_stop : Reach::direct;
    };
    const auto at = place_of(TablePlaces{one, seat, options}, 0, {"at-hand", {}});
    EXPECT_LT(at.y, -0.2);
    EXPECT_LE(std::abs(at.x), 0.16);
  }
}

TEST(TablePlaces, InFrontOfAThingIsClearlySoThoughItTakesAStop) {
  const std::vector<TableObject> two{{{0.2, 0.1}, 0.03}, {{0.0, 0.0}, 0.03}};
  PlacingOptions options;
  options.reach = [](const GroundPoint& at) {
    return std::abs(at.x) < 0.05 ? Reach::by_stop : Reach::direct;
  };
  const auto at = place_of(TablePlaces{two, seat, options}, 0, {"front", {1}});
  EXPECT_LT(at.y, -0.05);
  EXPECT_LT(std::abs(at.x), 0.5 * std::abs(at.y));
}

TEST(TablePlaces, AQuarterOfTheTableIsTheBetterTheNearerToItsCorner) {
  const std::vector<TableObject> one{{{0, 0}, 0.03}};
  PlacingOptions options;
  options.reach = [](const GroundPoint& at) { return at.y < 0.12 ? Reach::direct : Reach::none; };
  const TablePlaces table{one, seat, options};
  const auto at = place_of(table, 0, {"back-left", {}});
  EXPECT_LT(at.x, -0.2);
  EXPECT_GT(at.y, 0.08);
  EXPECT_EQ(table.fit({"back-left", {}}, 0, {0.1, 0.1}), 0);
  EXPECT_EQ(table.fit({"back-left", {}}, 0, {-0.1, -0.1}), 0);
}

/// Whatever is found is on the table, fits, and is free.
TEST(TablePlaces, RandomTables) {
  std::mt19937 random{7};
  std::uniform_real_distribution<double> x{-0.26, 0.26};
  std::uniform_real_distribution<double> y{-0.22, 0.22};
  std::size_t found_targets = 0;
  for (int round = 0; round < 100; ++round) {
    std::vector<TableObject> objects;
    while (objects.size() < 6) {
      const TableObject next{{x(random), y(random)}, 0.03, true};
      bool is_apart = true;
      for (const auto& other : objects)
        is_apart = is_apart && distance(next.centre, other.centre) > 0.08;
      if (is_apart)
        objects.push_back(next);
    }
    const TablePlaces table{objects, seat};
    for (const auto* relation : {"left", "right", "front", "back", "near"}) {
      const PlaceWanted wanted{relation, {1}};
      for (const auto& target : table.find(0, std::vector{wanted}, 2).targets) {
        ++found_targets;
        EXPECT_GT(table.fit(wanted, 0, target.position), 0);
        EXPECT_LE(std::abs(target.position.x), 0.27 + 1e-9);
        EXPECT_LE(std::abs(target.position.y), 0.23 + 1e-9);
        for (std::size_t i = 1; i < objects.size(); ++i)
          EXPECT_GE(distance(target.position, objects[i].centre), 0.08 - 1e-9);
      }
    }
  }
  EXPECT_GT(found_targets, 700U);
}

/// What is near to a corner only with a stop on the way is put there all the same, and what is held
/// is put where it would be from the table.
TEST(TablePlaces, AsNearToACornerAsIsReached) {
  PlacingOptions options;
  options.reach = [](const GroundPoint& at) {
    return std::hypot(at.x, at.y) > 0.27   ? Reach::none
           : std::hypot(at.x, at.y) > 0.12 ? Reach::by_stop
                                           : Reach::direct;
  };
  const std::vector<TableObject> objects{{{0, 0}, 0.03, true}, {{100, 100}, 0.03, true}};
  const TablePlaces table{objects, seat, options};
  for (const std::size_t object : {0, 1})
    for (const double side : {-1.0, 1.0}) {
      const auto at = place_of(table, object, {side < 0 ? "back-left" : "back-right", {}});
      EXPECT_GT(std::hypot(at.x, at.y), 0.2);
      EXPECT_GT(side * at.x, 0.1);
    }
  // Elsewhere there is no reason for a stop.
  const auto back = place_of(table, 0, {"back", {}});
  EXPECT_LE(std::hypot(back.x, back.y), 0.12);
}

/// It does not matter where nothing is.
TEST(TablePlaces, WhatIsHeldIsNotNearerToOneSide) {
  const std::vector<TableObject> held{{{100, 100}, 0.03, true}};
  const std::vector<TableObject> other{{{-100, -100}, 0.03, true}};
  for (const auto* part : {"left", "front", "table"}) {
    const auto a = place_of(TablePlaces{held, seat}, 0, {part, {}});
    const auto b = place_of(TablePlaces{other, seat}, 0, {part, {}});
    EXPECT_EQ(a, b) << part;
  }
}

} // namespace castor::spatial
