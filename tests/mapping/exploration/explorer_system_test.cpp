// The Explorer in a running system, with a pretended robot.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/exploration/types.hpp"
#include "castor/mapping/grid/tile_entries.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/tests/mapping/exploration/scanned_building.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

namespace castor::mapping::test {

namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Three rooms in a row; the door to the last one is shut, and the one in the middle has an opening
/// that is too narrow in the wall above.
const Building& hut() {
  static const Building result =
    parse_building("wall 0 0 to 9 0 to 9 3 to 0 3 close\nwall 3 0 to 3 3\nwall 6 0 to 6 3\n"
                   "wall 3 3 to 3 6 to 6 6 to 6 3\n"
                   "door a at 3 1.5 width 0.9\ndoor b at 6 1.5 width 0.9 shut\n"
                   "door gap at 4.5 3 width 0.4\n"
                   "room left at 1 1\nroom middle at 4 1\nroom right at 7 1\nroom above at 4 5\n"
                   "start 1 1.5\n",
                   "hut.building")
      .building;
  return result;
}

/// Is at once where it was asked to go, and sees.
class PretendedNavigator final : public UnmanagedComponent {
  void start() override {
    on_action<GoToPlace>([this](ActionInProgress& action, const GoToPlace& x) {
      if (!action.sleep_for(300ms))
        return ActionResult::cancelled();
      if (fails_)
        return ActionResult::failed("the wheels are blocked");
      for (double turn : {-0.8, 0.8, 0.0})
        see({x.x, x.y, x.heading + turn});
      return ActionResult::succeeded();
    });
  }

  void run() override {
    for (int i = 0; i < 8; ++i)
      see({1, 1.5, i * 0.8});
  }

  void see(const Pose2& pose) {
    RobotPose robot;
    robot.time = now().count();
    robot.pose = pose;
    robot.state = LocalisationState::tracking;
    put(Address{"slam", "pose"}, robot);
    const auto touched = scanned_.scan(pose);
    for (auto& tile : entries_.changed(scanned_.grid(), touched))
      put(Address{"slam", id_of({tile.column, tile.row})}, tile);
  }

  Option<bool> fails_{this, "fails", false, "it goes nowhere"};
  ScannedBuilding scanned_{hut()};
  TileEntries entries_;
};
CASTOR_COMPONENT(PretendedNavigator, "is at once where it was asked to go")

std::unique_ptr<TestSystem> system_with(const std::string& navigator, const std::string& explorer) {
  return std::make_unique<TestSystem>(
    "SUBARCHITECTURE slam\nCPP WM SubarchitectureWorkingMemory\n"
    "CPP TM AlwaysPositiveTaskManager\n"
    "SUBARCHITECTURE navigation\nCPP WM SubarchitectureWorkingMemory\n"
    "CPP TM AlwaysPositiveTaskManager\n"
    "CPP UM navigator PretendedNavigator " +
      navigator +
      "\n"
      "CPP UM explorer Explorer --grid slam --start true " +
      explorer + "\nSUPERVISE * RESTARTS 10 IN 10s\n",
    TestSystemOptions{.patience = 5min, .open_access = true, .simulated_time = true});
}

} // namespace

TEST(ExplorerSystem, ExploresAndSaysWhatItDidNotReach) {
  auto system = system_with("", "");
  const auto entry = system->expect_entry("ExplorationState in navigation where finished == true");
  const auto state = *entry->value.as<ExplorationState>();
  // Two rooms of 2.9 m x 2.9 m, and what it sees through the gap.
  EXPECT_GT(state.seen, 16);
  EXPECT_GT(state.goals, 0);
  bool says_why = false;
  for (auto& x : state.frontiers) {
    EXPECT_NE(x.state, FrontierState::open);
    EXPECT_NE(x.reason, "");
    says_why |= x.y > 3 && x.reason.find("too narrow") != std::string::npos;
  }
  EXPECT_TRUE(says_why);
}

TEST(ExplorerSystem, EndsWhenTheNavigatorGetsNowhere) {
  auto system = system_with("--fails true", "");
  const auto entry = system->expect_entry("ExplorationState in navigation where finished == true");
  const auto state = *entry->value.as<ExplorationState>();
  bool says_why = false;
  for (auto& x : state.frontiers)
    says_why |= x.state == FrontierState::given_up && x.reason == "the wheels are blocked";
  EXPECT_TRUE(says_why);
}

TEST(ExplorerSystem, GoesOnAfterAFailureWhileTheRobotStands) {
  // Nothing moves the robot before the Explorer asks for it.
  auto system = system_with("--fails true", "");
  system->expect_entry("ExplorationState in navigation where finished == true");
  const auto crashed = system->system().now().count();
  system->inject("crash explorer");
  system->expect_back("explorer");
  system->expect_entry("ExplorationState in navigation where finished == true && time > " +
                       std::to_string(crashed));
}

} // namespace castor::mapping::test
