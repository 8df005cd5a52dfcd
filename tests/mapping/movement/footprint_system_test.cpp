// Robots that are no discs go to places in configs/explorer.cast, with the guard, in a map that was
// made before. In simulated time.

#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/tests/mapping/movement/footprint_world.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace castor::mapping::test {

/// Entry: how the way there and back has ended.
struct WayEnd {
  /// Why a place was not reached.
  std::string problem;
  std::int64_t collisions = 0;
  Pose2 robot;
};
CASTOR_REFLECT(WayEnd, problem, collisions, robot)

namespace {

using namespace std::chrono_literals;

/// Through the door to face the way it came, and back.
class WayAsker final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot",
                        [this](const std::shared_ptr<const BodyStatus>& x) { status_ = x; });
  }

  void run() override {
    WayEnd end;
    for (const Pose2& place : {Pose2{4.8, 2.5, 3.14}, Pose2{1.2, 1.5, 0}}) {
      GoToPlace what;
      what.x = place.x;
      what.y = place.y;
      what.heading = place.heading;
      what.has_heading = true;
      const auto over = perform("navigation", what).wait(300s);
      if (over.outcome != ActionOutcome::succeeded)
        end.problem += over.reason + '\n';
    }
    // The last BodyStatus arrives meanwhile.
    sleep_for(200ms);
    end.collisions = status_->collisions;
    end.robot = status_->pose;
    add(end);
  }

  std::shared_ptr<const BodyStatus> status_;
};
CASTOR_COMPONENT(WayAsker, "asks for a way there and back")

class FootprintSystem : public testing::Test {
protected:
  static void expect_way(std::map<std::string, std::string> variables) {
    const castor::test::TemporaryFolder folder;
    const auto stem = folder.path() / "rooms";
    write_map_server(two_rooms(0.9), stem);
    const auto yaml = stem.string() + ".yaml";
    TestSystemOptions options;
    options.file = CASTOR_CONFIGS "/explorer.cast";
    options.simulated_time = true;
    options.patience = 300s;
    options.variables = std::move(variables);
    options.variables.insert({{"building", yaml},
                              {"map", yaml},
                              {"drive", "goals"},
                              // Where it is.
                              {"goals", "1 1"},
                              {"after", "stay"},
                              {"start", "1 1 heading 90"},
                              {"localisation", "map"},
                              {"map_start", "1,1,90"},
                              {"pictures", "0s"}});
    TestSystem system{load_text(options.file) + "\nSUBARCHITECTURE asking\n"
                                                "CPP WM SubarchitectureWorkingMemory\n"
                                                "CPP TM AlwaysPositiveTaskManager\n"
                                                "CPP UM asker WayAsker\n",
                      options};
    const auto end = system.expect_entry("WayEnd in asking")->value.as<WayEnd>();
    EXPECT_EQ(end->problem, "");
    EXPECT_EQ(end->collisions, 0);
    EXPECT_NEAR(end->robot.x, 1.2, 0.2);
    EXPECT_NEAR(end->robot.y, 1.5, 0.2);
    system.expect_nobody_else_down();
  }
};

} // namespace

TEST_F(FootprintSystem, LongRobotGoesThroughADoorAndBack) {
  expect_way(
    {{"planner", "footprint"}, {"footprint", "0.6 0.25, -0.6 0.25, -0.6 -0.25, 0.6 -0.25"}});
}

TEST_F(FootprintSystem, CarGoesThroughADoorAndBack) {
  expect_way({{"planner", "reeds_shepp"},
              {"turning_radius", "0.5"},
              {"footprint", "0.55 0.22, -0.15 0.22, -0.15 -0.22, 0.55 -0.22"}});
}

} // namespace castor::mapping::test
