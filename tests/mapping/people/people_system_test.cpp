// A tracker in a system with a simulated robot and people.

#include "castor/mapping/body/types.hpp"
#include "castor/mapping/people/types.hpp"
#include "castor/mapping/slam/types.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <string>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Knows where the robot is; says nothing while it stands.
class TruePose final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [this](auto& x) {
      if (x->time % 200'000 != 0 || x->pose == told_)
        return;
      told_ = x->pose;
      RobotPose pose;
      pose.time = x->time;
      pose.frame = "map";
      pose.pose = x->pose;
      pose.state = LocalisationState::tracking;
      put(here("pose"), pose);
    });
  }

  std::optional<Pose2> told_;
};
CASTOR_COMPONENT(TruePose, "says where the robot is")

std::string cast_in(const test::TemporaryFolder& folder) {
  std::ofstream{folder.path() / "hall.building"}
    << "wall 0 0 to 10 0 to 10 8 to 0 8 close\n"
       "wall 7 8 to 7 4\n"
       // Behind the wall she is out of sight.
       "person ann route 5 6 to 5 2 to 9 2 to 9 7 speed 0.8\n"
       "start 2 2 heading 30\n";
  return "COMPONENT CPP robot SimulatedRobot --building hall.building --people true --legs true "
         "--beams-per-degree 2 --base " +
         folder.path().string() +
         "\n"
         "SUPERVISE * RESTARTS 10 IN 10s\n"
         "SUBARCHITECTURE slam\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM pose TruePose\n"
         "SUBARCHITECTURE people\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM tracker PersonTracker\n";
}

} // namespace

TEST(PeopleSystem, APersonIsAnEntryAsLongAsSheIsThere) {
  const test::TemporaryFolder folder;
  TestSystemOptions options;
  options.simulated_time = true;
  TestSystem system{cast_in(folder), options};
  const auto entry = system.expect_entry("Person in people where speed > 0.4", 60s);
  const auto x = *entry->value.as<Person>();
  EXPECT_EQ(x.id, 1);
  EXPECT_EQ(entry->address.id, "person-1");
  EXPECT_GT(x.y, 1.5);
  EXPECT_LT(x.y, 6.5);
  system.expect_no_entry("Person in people", 60s);
  system.expect_nobody_else_down();
}

TEST(PeopleSystem, ATrackerThatIsRestartedGivesNewIds) {
  const test::TemporaryFolder folder;
  TestSystemOptions options;
  options.simulated_time = true;
  TestSystem system{cast_in(folder), options};
  system.expect_entry("Person in people where id == 1", 60s);
  system.inject("crash tracker");
  system.expect_back("tracker");
  system.expect_no_entry("Person in people where id == 1", 10s);
  system.expect_entry("Person in people where id == 2", 120s);
}

} // namespace castor::mapping
