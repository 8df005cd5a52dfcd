// People in the scans of a simulated robot.

#include "castor/mapping/people/person_detector.hpp"

#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/people/person_tracks.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace castor::mapping {

namespace {

/// Those who are known as people after that time, in a hall with somebody and a table with legs.
/// The robot drives at that velocity.
std::vector<PersonTracks::Track> people_after(double seconds, const std::string& person,
                                              const Twist2& velocity) {
  BodyOptions options;
  options.people = true;
  options.legs = true;
  options.laser.beams_per_degree = 2;
  const auto hall = parse_building("wall 0 0 to 14 0 to 14 6 to 0 6 close\n"
                                   "furniture table at 6 4.5 box 1.6 0.8 0.74 legs\n"
                                   "furniture table at 9 1.5 box 1.2 0.8 0.74 legs\n"
                                   "start 1 3\n" +
                                     person,
                                   "hall");
  SimulatedBody body{surroundings_in(hall.building, options), options};
  PersonDetector detector{{}};
  PersonTracks tracks{{}};
  body.command(velocity);
  while (body.steps() < static_cast<std::int64_t>(seconds * 100)) {
    body.step();
    if (body.steps() % 10 != 0)
      continue;
    const auto scan = body.scan();
    const auto robot = body.odometry().pose;
    tracks.add(detector.detect(scan, robot, tracks.expected(scan.time)), ScanView{scan, robot},
               scan.time);
  }
  return tracks.people();
}

} // namespace

TEST(PersonDetector, FindsSomebodyWhoCrosses) {
  EXPECT_EQ(people_after(4, "person ann route 4 1 to 4 5 speed 0.7\n", {}).size(), 1u);
}

TEST(PersonDetector, FindsSomebodyWhoWalksStraightAway) {
  // Ahead of her it was never seen to be free.
  EXPECT_EQ(people_after(4, "person ann route 2.5 3 to 12 3 speed 0.5\n", {}).size(), 1u);
}

TEST(PersonDetector, FindsNobodyAmongFurnitureWhileTheRobotDrives) {
  EXPECT_TRUE(people_after(20, "", {0.5, 0}).empty());
  EXPECT_TRUE(people_after(20, "", {0.2, 0.5}).empty());
}

} // namespace castor::mapping
