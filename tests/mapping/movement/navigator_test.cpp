// The Navigator in a system with a simulated robot, in simulated time.

#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/tests/mapping/movement/drawn_map.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
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
  /// Greatest y of the robot so far, and when its first action was over.
  double highest = 0;
  double passed = 0;
};

Told& told() {
  static Told instance;
  return instance;
}

/// Goes through a door to face the way it came, and asks for a turn.
class PoseAsker final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [](auto& x) { told().body = *x; });
  }

  void run() override {
    GoToPlace there;
    there.x = 4.8;
    there.y = 2;
    there.heading = std::numbers::pi;
    there.has_heading = true;
    told().first = perform("navigation", there).wait(120s);
    TurnTo turn;
    told().second = perform("navigation", turn).wait(20s);
    sleep_for(200ms);
    add(Movement{});
  }
};
CASTOR_COMPONENT(PoseAsker, "asks a robot that is no disc for movements")

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

/// A graph of three nodes beside the straight way: goes along it to a node, and into an area.
class GraphAsker final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [](auto& x) {
      told().body = *x;
      told().highest = std::max(told().highest, x->pose.y);
    });
    const auto add_node = [this](std::int64_t id, NodeKind kind, const Pose2& pose) {
      GraphNode node;
      node.id = id;
      node.kind = kind;
      node.pose = pose;
      node.area = kind == NodeKind::gateway ? -1 : pose.x < 3 ? 1 : 2;
      add(here("node-" + std::to_string(id)), node);
    };
    add_node(0, NodeKind::place, {1, 1.2, 0});
    add_node(1, NodeKind::place, {1.5, 3.3, 0});
    add_node(2, NodeKind::gateway, {3, 2, 0});
    add_node(3, NodeKind::place, {5, 1, 0});
    for (const std::int64_t a : {0, 1, 2})
      add(here("edge-" + std::to_string(a)), GraphEdge{a, a + 1, 1});
    for (const std::int64_t id : {1, 2}) {
      Area area;
      area.id = id;
      area.x = id == 1 ? 1 : 5;
      area.y = 1;
      add(here("area-" + std::to_string(id)), area);
    }
  }

  void run() override {
    GoToNode node;
    node.node = 3;
    node.along_graph = true;
    const auto first = perform("navigation", node);
    // Pushes are delivered meanwhile.
    while (is_running() && !first.is_over())
      sleep_for(50ms);
    told().first = first.state();
    told().passed = told().highest;
    GoToArea area;
    area.area = 1;
    told().second = perform("navigation", area).wait(90s);
    node.node = 9;
    told().third = perform("navigation", node).wait(20s);
    add(Movement{});
  }
};
CASTOR_COMPONENT(GraphAsker, "asks for movements along a graph")

/// One that runs, two that wait, and one with a high priority.
class HurriedAsker final : public UnmanagedComponent {
  void run() override {
    TurnBy turn;
    turn.angle = 1;
    auto first = perform("navigation", turn);
    auto second = perform("navigation", turn);
    auto third = perform("navigation", turn);
    while (is_running() && first.status() != ActionStatus::running)
      sleep_for(50ms);
    turn.priority = MovementPriority::high;
    auto high = perform("navigation", turn);
    told().third = high.wait(30s);
    told().first = first.state();
    told().second = second.state();
    third.wait(30s);
    add(Movement{});
  }
};
CASTOR_COMPONENT(HurriedAsker, "asks for movements, one of them before the others")

std::atomic<bool> navigator_is_back = false;

/// A goal, and another one after the Navigator was restarted.
class PatientAsker final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [](auto& x) { told().body = *x; });
  }

  void run() override {
    GoToPlace there;
    there.x = 1.5;
    there.y = 2;
    told().first = perform("navigation", there).wait(60s);
    // Long enough for the robot to stand, and for its pose to be told.
    sleep_for(2s);
    add(DriverSeat{});
    while (is_running() && !navigator_is_back)
      sleep_for(50ms);
    there.x = 2;
    told().second = perform("navigation", there).wait(60s);
    add(Movement{});
  }
};
CASTOR_COMPONENT(PatientAsker, "asks for movements before and after a failure")

/// Follows somebody for a while.
class FollowAsker final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [](auto& x) { told().body = *x; });
  }

  void run() override {
    auto action = perform("navigation", FollowPerson{});
    while (is_running() && !action.is_over() && told().body.pose.x < 5)
      sleep_for(50ms);
    action.cancel();
    told().first = action.wait(10s);
    add(Movement{});
  }
};
CASTOR_COMPONENT(FollowAsker, "follows somebody")

/// Tells of the true pose; nothing while the robot stands.
class QuietLocalisation final : public UnmanagedComponent {
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
CASTOR_COMPONENT(QuietLocalisation, "says where the robot is")

class NavigatorSystem : public testing::Test {
protected:
  void run(const std::string& asker) {
    const auto system = system_with(asker, "--pose truth");
    system->expect_entry("Movement in asking");
  }

  std::unique_ptr<TestSystem> system_with(const std::string& asker, const std::string& navigator,
                                          const std::string& robot = "") {
    told() = {};
    navigator_is_back = false;
    auto map = test::empty_room(6, 4);
    test::fill(map, 2.95, 0, 3.05, 4);
    test::fill(map, 2.95, 1.6, 3.05, 2.4, 0);
    const auto stem = folder_.path() / "rooms";
    write_map_server(map, stem);
    const auto yaml = stem.string() + ".yaml";
    return std::make_unique<TestSystem>(
      "COMPONENT CPP robot SimulatedRobot --building " + yaml +
        " --start \"1 1 heading 90\" --lease navigation/seat " + robot +
        "\n"
        "SUBARCHITECTURE navigation\n"
        "CPP WM SubarchitectureWorkingMemory\n"
        "CPP TM AlwaysPositiveTaskManager\n"
        "CPP UM localisation QuietLocalisation\n"
        "CPP UM navigator Navigator --map " +
        yaml + " --seat seat --localisation navigation " + navigator +
        "\n"
        "SUBARCHITECTURE asking\n"
        "CPP WM SubarchitectureWorkingMemory\n"
        "CPP TM AlwaysPositiveTaskManager\n"
        "CPP UM asker " +
        asker + "\nSUPERVISE * RESTARTS 10 IN 10s\n",
      TestSystemOptions{.patience = 120s, .simulated_time = true});
  }

  /// A hall in which somebody walks away from the robot.
  std::unique_ptr<TestSystem> hall_with(const std::string& asker, const std::string& navigator) {
    told() = {};
    const auto stem = folder_.path() / "hall";
    write_map_server(test::empty_room(12, 6), stem);
    const auto building = stem.string() + ".building";
    std::ofstream{building} << "wall 0 0 to 12 0 to 12 6 to 0 6 close\n"
                               "person ann route 2.5 3 to 11 3 speed 0.5\n"
                               "start 1 3\n";
    return std::make_unique<TestSystem>(
      "COMPONENT CPP robot SimulatedRobot --people true --legs true --beams-per-degree 2 "
      "--lease navigation/seat --building " +
        building +
        "\n"
        "SUBARCHITECTURE people\n"
        "CPP WM SubarchitectureWorkingMemory\n"
        "CPP TM AlwaysPositiveTaskManager\n"
        "CPP UM tracker PersonTracker --localisation navigation\n"
        "SUBARCHITECTURE navigation\n"
        "CPP WM SubarchitectureWorkingMemory\n"
        "CPP TM AlwaysPositiveTaskManager\n"
        "CPP UM localisation QuietLocalisation\n"
        "CPP UM navigator Navigator --map " +
        stem.string() + ".yaml --seat seat --localisation navigation " + navigator +
        "\n"
        "SUBARCHITECTURE asking\n"
        "CPP WM SubarchitectureWorkingMemory\n"
        "CPP TM AlwaysPositiveTaskManager\n"
        "CPP UM asker " +
        asker + "\nSUPERVISE * RESTARTS 10 IN 10s\n",
      TestSystemOptions{.patience = 120s, .simulated_time = true});
  }

  castor::test::TemporaryFolder folder_;
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

TEST_F(NavigatorSystem, CarGoesThroughADoorAndDoesNotTurnOnTheSpot) {
  const std::string car =
    "--footprint \"0.55 0.22, -0.15 0.22, -0.15 -0.22, 0.55 -0.22\" --turning-radius 0.5";
  const auto system = system_with("PoseAsker", "--pose truth --planner reeds_shepp " + car, car);
  system->expect_entry("Movement in asking");
  EXPECT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  EXPECT_NEAR(told().body.pose.x, 4.8, 0.15);
  EXPECT_NEAR(told().body.pose.y, 2, 0.15);
  EXPECT_NEAR(std::abs(told().body.pose.heading), std::numbers::pi, 0.2);
  EXPECT_EQ(told().second.outcome, ActionOutcome::failed);
  EXPECT_EQ(told().second.reason, "the robot cannot turn on the spot");
  EXPECT_EQ(told().body.collisions, 0);
}

TEST_F(NavigatorSystem, LongRobotGoesThroughADoorAndTurns) {
  const std::string robot = "--footprint \"0.6 0.25, -0.6 0.25, -0.6 -0.25, 0.6 -0.25\"";
  const auto system = system_with("PoseAsker", "--pose truth --planner footprint " + robot, robot);
  system->expect_entry("Movement in asking");
  EXPECT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  EXPECT_EQ(told().second.outcome, ActionOutcome::succeeded) << told().second.reason;
  EXPECT_NEAR(told().body.pose.heading, 0, 0.1);
  EXPECT_EQ(told().body.collisions, 0);
}

TEST_F(NavigatorSystem, GoesAlongTheGraphToNodesAndAreas) {
  const auto system = system_with("GraphAsker", "--pose truth --graph asking");
  system->expect_entry("Movement in asking");
  EXPECT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  EXPECT_GT(told().passed, 2.8) << "not past node 1";
  EXPECT_EQ(told().second.outcome, ActionOutcome::succeeded) << told().second.reason;
  EXPECT_NEAR(told().body.pose.x, 1, 0.15);
  EXPECT_NEAR(told().body.pose.y, 1.2, 0.15);
  EXPECT_EQ(told().third.outcome, ActionOutcome::failed);
  EXPECT_THAT(told().third.reason, testing::HasSubstr("no node 9; it has 4 nodes"));
  EXPECT_EQ(told().body.collisions, 0);
}

TEST_F(NavigatorSystem, AHighPriorityGoesBeforeThoseThatWait) {
  run("HurriedAsker");
  EXPECT_EQ(told().third.outcome, ActionOutcome::succeeded) << told().third.reason;
  EXPECT_EQ(told().first.status, ActionStatus::over);
  EXPECT_NE(told().second.status, ActionStatus::over);
}

TEST_F(NavigatorSystem, FollowsAPersonUntilItIsCancelled) {
  const auto system = hall_with("FollowAsker", "--people people");
  system->expect_entry("Movement in asking");
  system->expect_entry("Movement in navigation where task == \"follow person 1\"");
  EXPECT_EQ(told().first.outcome, ActionOutcome::cancelled) << told().first.reason;
  EXPECT_GE(told().body.pose.x, 5);
  EXPECT_EQ(told().body.collisions, 0);
}

TEST_F(NavigatorSystem, SaysThatItDoesNotKnowOfPeople) {
  const auto system = hall_with("FollowAsker", "");
  system->expect_entry("Movement in asking");
  EXPECT_EQ(told().first.outcome, ActionOutcome::failed);
  EXPECT_THAT(told().first.reason, testing::HasSubstr("--people"));
}

TEST_F(NavigatorSystem, GoesOnAfterAFailureWhileTheRobotStands) {
  const auto system = system_with("PatientAsker", "");
  system->expect_entry("DriverSeat in asking");
  system->inject("crash navigator");
  system->expect_back("navigator");
  navigator_is_back = true;
  system->expect_entry("Movement in asking");
  EXPECT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  EXPECT_EQ(told().second.outcome, ActionOutcome::succeeded) << told().second.reason;
  EXPECT_NEAR(told().body.pose.x, 2, 0.15);
  EXPECT_NEAR(told().body.pose.y, 2, 0.15);
}

} // namespace

} // namespace castor::mapping
