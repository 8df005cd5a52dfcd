// Localisation in a given map as a component of a system, in simulated time.

#include "castor/actors/system/system.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/mapping/map_components/types.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/tests/mapping/localisation/room_maps.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class LocalisationSystem : public ::testing::Test {
protected:
  LocalisationSystem() { write_map_server(furnished_map(), folder / "room"); }

  /// A robot that drives around the block in the middle of the room.
  std::string cast(const std::string& start, const std::string& robot_options = {},
                   const std::string& pose_source = "localisation") const {
    const auto map = (folder / "room.yaml").string();
    return "COMPONENT CPP robot SimulatedRobot --building " + map +
           " --start \"2 1.7 heading 0\" --odometry-start zero " + robot_options +
           "\n"
           "SUBARCHITECTURE navigation\n"
           "CPP WM SubarchitectureWorkingMemory\n"
           "CPP TM AlwaysPositiveTaskManager\n"
           "CPP UM driver PathDriver --path \"2 1.7, 8 1.7, 8 6.2, 2 6.2, 2 2\" --pose " +
           pose_source +
           " --localisation slam --rounds 9\n"
           "SUBARCHITECTURE slam\n"
           "CPP WM SubarchitectureWorkingMemory\n"
           "CPP TM AlwaysPositiveTaskManager\n"
           "CPP UM localiser MapLocaliser --map " +
           map + " --start " + start +
           "\n"
           "CPP UM evaluator PoseEvaluator --period 1s\n";
  }

  static TestSystemOptions simulated() {
    TestSystemOptions result;
    result.simulated_time = true;
    result.patience = 300s;
    return result;
  }

  template <class T>
  static std::vector<T> all(TestSystem& system) {
    std::vector<T> result;
    for (auto& entry : system.system().entries("slam"))
      if (auto x = entry->value.as<T>())
        result.push_back(*x);
    return result;
  }

  static LocalisationState state(TestSystem& system) {
    auto poses = all<RobotPose>(system);
    return poses.empty() ? LocalisationState::starting : poses[0].state;
  }

  static PoseError error(TestSystem& system) {
    auto errors = all<PoseError>(system);
    return errors.empty() ? PoseError{} : errors[0];
  }

  const castor::test::TemporaryFolder folder;
};

TEST_F(LocalisationSystem, DrivesByAMapFromAKnownStart) {
  TestSystem system{cast("2,1.7,0"), simulated()};
  system.wait_until("some way", [&] { return error(system).time > 60'000'000; });
  auto x = error(system);
  EXPECT_GT(x.tracking, x.poses * 9 / 10);
  EXPECT_LT(x.median, 0.1);
  EXPECT_LT(x.most, 0.3);
  EXPECT_EQ(x.lost, 0);
  // The odometry begins at zero, and the map does not.
  auto frames = all<geometry::Transform>(system);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].frame, "odometry");
  EXPECT_NEAR(frames[0].pose.position.x, 2, 1);
  system.expect_nobody_else_down();
}

TEST_F(LocalisationSystem, SaysWhenTheRobotWasCarriedAway) {
  TestSystem system{
    cast("2,1.7,0", "--kidnap-after 20s --kidnap-to \"8.4 6.6 heading 250\"", "truth"),
    simulated()};
  system.wait_until("loss", [&] { return state(system) == LocalisationState::lost; });
  auto lost = all<RobotPose>(system).at(0);
  EXPECT_GT(lost.time, 20'000'000);
  EXPECT_LT(lost.time, 24'000'000);
  EXPECT_THAT(lost.reason, HasSubstr("lost: the map explained"));
  system.wait_until("recovery", [&] { return error(system).last_found > error(system).last_lost; });
  auto before = error(system);
  EXPECT_LT(before.last_found, 60'000'000);
  auto pose = all<RobotPose>(system).at(0);
  EXPECT_EQ(pose.frame, "map");
}

TEST_F(LocalisationSystem, ALocaliserThatFailsGoesOnWhereItWas) {
  TestSystem system{cast("2,1.7,0"), simulated()};
  system.wait_until("some way", [&] { return error(system).time > 20'000'000; });
  system.inject("crash localiser");
  system.expect_back("localiser");
  system.wait_until("more way", [&] { return error(system).time > 50'000'000; });
  EXPECT_EQ(error(system).lost, 0);
  EXPECT_LT(error(system).most, 0.3);
}

} // namespace

} // namespace castor::mapping::test
