// The Navigator in a system with a simulated robot, in simulated time.

#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/tests/mapping/movement/drawn_map.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

struct Told {
  Action first;
  Action second;
  Action third;
  BodyStatus body;
  Timestamp asked_at{0};
};

Told& told() {
  static Told instance;
  return instance;
}

/// Goes through a door, turns, and is refused a goal in a wall.
class MovementAsker final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [](auto& x) { told().body = *x; });
  }

  void run() override {
    GoToPlace there;
    there.x = 5;
    there.y = 3;
    told().first = perform("navigation", there).wait(60s);
    TurnTo turn;
    turn.heading = 2;
    told().second = perform("navigation", turn).wait(20s);
    there.x = 3;
    told().third = perform("navigation", there).wait(20s);
    add(Movement{});
  }
};
CASTOR_COMPONENT(MovementAsker, "asks for movements")

/// Two goals, and an urgent stop while the first is under way.
class MovementStopper final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [](auto& x) { told().body = *x; });
  }

  void run() override {
    GoToPlace there;
    there.x = 5;
    there.y = 3;
    auto first = perform("navigation", there);
    auto second = perform("navigation", there);
    while (is_running() && told().body.driven < 0.3)
      sleep_for(50ms);
    auto third = perform("navigation", StopMoving{});
    told().third = third.wait(2s);
    told().first = first.wait(2s);
    told().second = second.wait(2s);
    sleep_for(2s);
    told().body = *pull<BodyStatus>("robot");
    told().asked_at = now();
    add(Movement{});
  }
};
CASTOR_COMPONENT(MovementStopper, "stops the robot")

class NavigatorSystem : public testing::Test {
protected:
  void run(const std::string& asker) {
    told() = {};
    auto map = test::empty_room(6, 4);
    test::fill(map, 2.95, 0, 3.05, 4);
    test::fill(map, 2.95, 1.6, 3.05, 2.4, 0);
    const castor::test::TemporaryFolder folder;
    const auto stem = folder.path() / "rooms";
    write_map_server(map, stem);
    const auto yaml = stem.string() + ".yaml";
    TestSystem system{"COMPONENT CPP robot SimulatedRobot --building " + yaml +
                        " --start \"1 1 heading 90\" --lease navigation/seat\n"
                        "SUBARCHITECTURE navigation\n"
                        "CPP WM SubarchitectureWorkingMemory\n"
                        "CPP TM AlwaysPositiveTaskManager\n"
                        "CPP UM navigator Navigator --map " +
                        yaml +
                        " --pose truth --seat seat\n"
                        "SUBARCHITECTURE asking\n"
                        "CPP WM SubarchitectureWorkingMemory\n"
                        "CPP TM AlwaysPositiveTaskManager\n"
                        "CPP UM asker " +
                        asker + "\n",
                      {.patience = 120s, .simulated_time = true}};
    system.expect_entry("Movement in asking");
  }
};

TEST_F(NavigatorSystem, GoesToPlacesAndSaysWhyItCannot) {
  run("MovementAsker");
  EXPECT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  EXPECT_EQ(told().second.outcome, ActionOutcome::succeeded) << told().second.reason;
  EXPECT_NEAR(told().body.pose.x, 5, 0.15);
  EXPECT_NEAR(told().body.pose.y, 3, 0.15);
  EXPECT_NEAR(told().body.pose.heading, 2, 0.1);
  EXPECT_EQ(told().third.outcome, ActionOutcome::failed);
  EXPECT_EQ(told().third.reason, "the goal is inside an obstacle");
  EXPECT_EQ(told().body.collisions, 0);
}

TEST_F(NavigatorSystem, StopsAtOnceAndClearsTheQueue) {
  run("MovementStopper");
  EXPECT_EQ(told().third.outcome, ActionOutcome::succeeded) << told().third.reason;
  EXPECT_EQ(told().first.outcome, ActionOutcome::cancelled);
  EXPECT_EQ(told().first.reason, "an urgent action has cleared the queue");
  EXPECT_EQ(told().second.outcome, ActionOutcome::cancelled);
  EXPECT_EQ(told().second.reason, "an urgent action has cleared the queue");
  EXPECT_GT(told().body.time, told().asked_at.count() - 100'000);
  EXPECT_EQ(told().body.velocity.forward, 0);
  EXPECT_LT(told().body.driven, 1);
}

} // namespace

} // namespace castor::mapping
