#include "castor/mapping/building/building_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace castor::mapping {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::string_view hut = "wall 0 0 to 8 0 to 8 5 to 0 5 close thickness 0.2\n"
                                 "wall 5 0 to 5 5\n"
                                 "door kitchen-door at 5 2.5 width 85cm\n"
                                 "room kitchen at 6 1\n"
                                 "room office-1 at 2 2 kind office\n"
                                 "start 2.5 2.5 heading 90\n";

/// The problems as "line: message".
std::vector<std::string> problems_of(const std::string& text) {
  std::vector<std::string> result;
  for (auto& x : parse_building(text, "x.building").problems) {
    result.push_back(std::to_string(x.where.line()) + ": " + x.message);
    EXPECT_FALSE(x.remedy.empty()) << x.message;
  }
  return result;
}

std::string with(const std::string& more) {
  return std::string{hut} + more;
}

std::string without(const std::string& line) {
  std::string text{hut};
  auto at = text.find(line);
  return text.erase(at, text.find('\n', at) + 1 - at);
}

} // namespace

TEST(BuildingFile, ReadsRoomsDoorsAndStart) {
  auto read = parse_building(hut, "hut.building");
  EXPECT_THAT(read.problems, IsEmpty()) << render(read.problems);
  auto& x = read.building;
  ASSERT_THAT(x.rooms, SizeIs(2));
  EXPECT_EQ(x.rooms[0].kind, "kitchen");
  EXPECT_NEAR(x.rooms[0].area, 15, 1e-9);
  EXPECT_EQ(x.rooms[1].kind, "office");
  EXPECT_NEAR(x.rooms[1].area, 25, 1e-9);
  ASSERT_THAT(x.doors, SizeIs(1));
  EXPECT_TRUE(x.doors[0].is_open);
  EXPECT_NEAR(length(x.doors[0].opening), 0.85, 1e-9);
  EXPECT_NEAR(x.doors[0].opening.from.x, 5, 1e-9);
  EXPECT_NEAR(x.start.heading, std::numbers::pi / 2, 1e-9);
  EXPECT_EQ(room_at(x, {7, 4}), &x.rooms[0]);
  EXPECT_EQ(room_at(x, {9, 4}), nullptr);
}

TEST(BuildingFile, ReadsFurnitureObjectsAndPeople) {
  auto read =
    parse_building(with("furniture desk at 1 1 box 1.6 80cm 0.75 turned 90 colour #0a0B0c\n"
                        "furniture desk at 1 4 box 1 0.5 0.7 legs\n"
                        "object mug at 1 1 on 0.75 size 0.08 0.1 colour red name=red-mug\n"
                        "person ann route 1 2.5 to 7 2.5 loop speed 0.5 pause 3\n"),
                   "hut.building");
  EXPECT_THAT(read.problems, IsEmpty()) << render(read.problems);
  auto& x = read.building;
  ASSERT_THAT(x.furniture, SizeIs(2));
  EXPECT_EQ(x.furniture[0].name, "desk-1");
  EXPECT_EQ(x.furniture[1].name, "desk-2");
  EXPECT_TRUE(x.furniture[1].has_legs);
  EXPECT_EQ(x.furniture[0].body.colour, (Colour{10, 11, 12}));
  EXPECT_DOUBLE_EQ(x.furniture[0].body.width, 0.8);
  ASSERT_THAT(x.objects, SizeIs(1));
  EXPECT_EQ(x.objects[0].name, "red-mug");
  EXPECT_DOUBLE_EQ(x.objects[0].body.bottom, 0.75);
  EXPECT_DOUBLE_EQ(x.objects[0].body.top, 0.85);
  ASSERT_THAT(x.people, SizeIs(1));
  EXPECT_TRUE(x.people[0].is_loop);
  EXPECT_DOUBLE_EQ(round_length(x.people[0]), 12);
  EXPECT_DOUBLE_EQ(x.people[0].pause, 3);
}

TEST(Walkers, ReachThePointsOfTheirRouteAgainAndAgain) {
  Walker x;
  x.route = {{0, 0}, {2, 0}, {2, 1}};
  EXPECT_EQ(points_reached(x, 1.9), 0);
  EXPECT_EQ(points_reached(x, 2.1), 1);
  EXPECT_EQ(points_reached(x, 3.1), 2);
  EXPECT_EQ(points_reached(x, 4.1), 3) << "on the way back";
  EXPECT_EQ(points_reached(x, 6.1), 4) << "where it began";
  EXPECT_EQ(points_reached(x, 8.1), 5);
  EXPECT_EQ(points_reached(x, -0.1), -1);
  x.is_loop = true;
  EXPECT_EQ(points_reached(x, 3.1), 2);
  EXPECT_EQ(points_reached(x, round_length(x) + 0.1), 3);
}

TEST(BuildingFile, NamesAnOpenWall) {
  std::string text{hut};
  text.replace(text.find("wall 5 0 to 5 5"), 15, "wall 5 0 to 5 4");
  EXPECT_THAT(problems_of(text),
              ElementsAre("5: no wall is between room office-1 and room kitchen, of line 4"));
  text = "wall 0 0 to 8 0 to 8 5 to 0 5\nroom hall at 2 2\nstart 2 2\n";
  EXPECT_THAT(problems_of(text),
              testing::Contains("2: room hall is not closed: there is an open wall"));
  EXPECT_THAT(parse_building(text, "").problems[0].remedy, HasSubstr("0 0"));
}

TEST(BuildingFile, ClosesAWallThatIsClosedAlready) {
  auto read = parse_building("wall 0 0 to 4 0 to 4 3 to 0 0 close\nroom a at 3 1\nstart 3 1\n", "");
  EXPECT_THAT(read.problems, IsEmpty()) << render(read.problems);
  EXPECT_THAT(read.building.walls, SizeIs(3));
}

TEST(BuildingFile, NamesADoorInNoWall) {
  EXPECT_THAT(problems_of(with("door other at 3 3\n")),
              ElementsAre("7: door other is in no wall: the nearest one, of line 1, is 2 m away"));
  EXPECT_THAT(problems_of(with("door other at 8 4.8\n")),
              ElementsAre("7: door other reaches beyond the end of its wall, of line 1"));
  EXPECT_THAT(problems_of(with("door other at 5 3\n")),
              ElementsAre("7: doors kitchen-door and other overlap"));
}

TEST(BuildingFile, NamesAStartWhereNoRobotFits) {
  auto start = [](const std::string& line) { return problems_of(without("start") + line); };
  EXPECT_THAT(start("start 5 1\n"),
              ElementsAre("6: the start is in a wall, a shut door or furniture"));
  EXPECT_THAT(start("start 5.2 1\n"),
              ElementsAre("6: the start is 0.15 m from the nearest obstacle, and a robot has a "
                          "radius of 0.25 m"));
  EXPECT_THAT(start("start 3 3\nfurniture sofa at 3 3 box 2 1 0.8\n"),
              ElementsAre("6: the start is in a wall, a shut door or furniture"));
  // It drives below what hangs on the wall.
  EXPECT_THAT(start("start 3 3\nfurniture lamp at 3 3 box 2 1 0.8 on 1\n"), IsEmpty());
  EXPECT_THAT(start(""), ElementsAre("0: there is no \"start\" line"));
}

TEST(BuildingFile, ReportsAllProblemsAtOnce) {
  auto found = problems_of("wall 0 0 to 8 0 to 8 5 to 0 5 close\n"
                           "rom kitchen at 2 2\n"
                           "furniture desk at 1 1\n"
                           "furniture desk at 1 1 box 1 1 1 colour gren\n"
                           "object mug at 2 200cm size 80 0.1\n"
                           "person ann route 1 1\n"
                           "start 2 2 2\n");
  EXPECT_THAT(found, SizeIs(6));
  auto text =
    render(parse_building("wall 0 0 to 8 0 to 8 5 to 0 5 close\nrom kitchen at 2 2\n", "x.building")
             .problems);
  EXPECT_THAT(text, HasSubstr("x.building:2"));
  EXPECT_THAT(text, HasSubstr("did you mean 'room'?"));
  EXPECT_THAT(text, HasSubstr("there is no \"start\" line"));
}

TEST(BuildingFile, RefusesNamesThatAreGivenTwice) {
  EXPECT_THAT(problems_of(with("object mug at 2 2 name=kitchen\n")),
              ElementsAre("7: the name \"kitchen\" is given twice"));
  EXPECT_THAT(problems_of(with("start 2 2\n")), ElementsAre("7: \"start\" is given twice"));
}

TEST(BuildingFile, WarnsOfPeopleWhoWalkThroughWalls) {
  EXPECT_THAT(problems_of(with("person ann route 2 1 to 7 1\n")),
              ElementsAre("7: ann walks through an obstacle at 4.95 1"));
  // Through a door, if it is open.
  EXPECT_THAT(problems_of(with("person ann route 2 2.5 to 7 2.5\n")), IsEmpty());
}

TEST(BuildingFile, IsToldOfTheFileThatCannotBeRead) {
  EXPECT_THROW(load_building("/no/such/file.building"), TextFileError);
}

TEST(BuildingFile, OfficeHasRoomsALoopAndObjects) {
  auto read = load_building(CASTOR_CONFIGS "/buildings/office.building");
  EXPECT_THAT(read.problems, IsEmpty()) << render(read.problems);
  auto& x = read.building;
  EXPECT_GE(x.rooms.size(), 6u);
  EXPECT_GE(x.objects.size(), 20u);
  EXPECT_EQ(x.people.size(), 2u);
  double area = 0;
  for (auto& room : x.rooms)
    area += room.area;
  EXPECT_NEAR(area, 18 * 15, 1e-6) << "the rooms are all of the floor";
  auto* corridor = room_at(x, {9, 5});
  ASSERT_NE(corridor, nullptr);
  EXPECT_EQ(corridor->name, "corridor");
  EXPECT_THAT(corridor->holes, SizeIs(1)) << "it goes all around a block of rooms";
}

TEST(PlaceOnRoute, GoesThereAndBackOrAround) {
  Walker x;
  x.route = {{0, 0}, {4, 0}, {4, 3}};
  EXPECT_EQ(place_on_route(x, 0), (Point2{0, 0}));
  EXPECT_EQ(place_on_route(x, 5), (Point2{4, 1}));
  EXPECT_EQ(place_on_route(x, 7), (Point2{4, 3}));
  EXPECT_EQ(place_on_route(x, 9), (Point2{4, 1}));
  EXPECT_EQ(place_on_route(x, 14), (Point2{0, 0}));
  x.is_loop = true;
  EXPECT_DOUBLE_EQ(round_length(x), 12);
  EXPECT_EQ(place_on_route(x, -5), (Point2{4, 3}));
  auto p = place_on_route(x, 12 + 9.5);
  EXPECT_NEAR(p.x, 2, 1e-9);
  EXPECT_NEAR(p.y, 1.5, 1e-9);
}

} // namespace castor::mapping
