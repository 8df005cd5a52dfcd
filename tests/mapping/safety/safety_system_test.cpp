// A guard between a driver and a robot, in simulated time: it stops the robot whatever fails.

#include "castor/mapping/body/types.hpp"
#include "castor/mapping/safety/types.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// What is known of the robot. It is written by components, and read while their time stands.
struct Watched {
  BodyStatus body;
  SafetyState safety;
  /// Each time that it has come to a stop, and why.
  std::vector<BodyStatus> stops;
  std::vector<SafetyReason> reasons;
  std::string refusal;
};

Watched& watched() {
  static Watched instance;
  return instance;
}

class GuardWatcher final : public StandaloneComponent {
  void start() override {
    on_push<BodyStatus>("robot", [](auto& x) {
      auto& before = watched().body;
      if (x->velocity.forward == 0 && before.velocity.forward != 0) {
        watched().stops.push_back(*x);
        watched().reasons.push_back(watched().safety.reason);
      }
      before = *x;
    });
    on_push<SafetyState>("safety", [](auto& x) { watched().safety = *x; });
  }
};
CASTOR_COMPONENT(GuardWatcher, "keeps what a robot and its guard push")

/// Drives straight on, without looking. It begins late, so that the robot stands before it is
/// started again.
class RecklessDriver final : public UnmanagedComponent {
  void run() override {
    sleep_for(2s);
    const auto seat = here("seat");
    if (!exists(seat))
      add(seat, DriverSeat{component_name()});
    const auto lease = lock(seat, LockLevel::o);
    // A fault "hang" is that of its next callback.
    on_push<SafetyState>(robot_.get(), [](auto&) {});
    every(50ms, [this] { stream_command(robot_.get(), DriveCommand{{0.5, 0}}); });
    while (sleep_for(1s)) {
      // nop
    }
  }

  Option<StandaloneName> robot_{this, "robot", "safety", "whom it commands"};
};
CASTOR_COMPONENT(RecklessDriver, "drives straight on")

/// Commands the robot past its guard.
class Bypasser final : public UnmanagedComponent {
  void run() override {
    try {
      command("robot", DriveCommand{{0.5, 0}});
    } catch (const CommandRefused& e) {
      watched().refusal = e.what();
    }
  }
};
CASTOR_COMPONENT(Bypasser, "commands a guarded robot")

class SafetySystem : public testing::Test {
protected:
  void SetUp() override {
    watched() = {};
    std::ofstream{folder_.path() / "hall.building"} << "wall 0 0 to 30 0 to 30 6 to 0 6 close\n"
                                                       "start 1 3\n";
  }

  void begin(const std::string& robot = "", const std::string& others = "",
             const std::string& guard = "") {
    TestSystemOptions options;
    options.simulated_time = simulated_time_;
    system_ = std::make_unique<TestSystem>(
      "SUPERVISE * RESTARTS 100 IN 10s\n"
      "COMPONENT CPP robot SimulatedRobot --building hall.building --base " +
        folder_.path().string() + " --commander safety " + robot +
        "\n"
        "COMPONENT CPP safety SafetyGuard --lease navigation/seat " +
        guard +
        "\n"
        "COMPONENT CPP watcher GuardWatcher\n"
        "SUBARCHITECTURE navigation\n"
        "CPP WM SubarchitectureWorkingMemory\n"
        "CPP TM AlwaysPositiveTaskManager\n" +
        others,
      options);
  }

  void await_drive() {
    system_->wait_until("the robot drives", [] { return watched().body.velocity.forward > 0.48; });
  }

  BodyStatus await_stop() {
    const auto known = watched().stops.size();
    system_->wait_until("the robot stands", [&] { return watched().stops.size() > known; });
    return watched().stops.at(known);
  }

  /// The robot needs time and way to react and to brake, from 0.5 m/s with 0.8 m/s^2.
  void expect_stop(const std::string& fault) {
    await_drive();
    const auto begun = watched().body;
    system_->inject(fault);
    const auto end = await_stop();
    EXPECT_LE(end.time - begun.time, 300'000 + braking + odometry_period) << fault;
    EXPECT_LE(end.driven - begun.driven, 0.5 * 0.3 + 0.25 / 1.6 + 0.02) << fault;
    EXPECT_EQ(end.collisions, 0) << fault;
  }

  /// What hangs lets simulated time stand, so that is real time. Its figures are in
  /// benchmarks/safety; here the robot has to stand long before the fault is over.
  void expect_stop_in_real_time(const std::string& fault) {
    simulated_time_ = false;
    begin("", driver);
    await_drive();
    const auto begun = watched().body;
    system_->inject(fault + " for 10s");
    const auto end = await_stop();
    EXPECT_LE(end.time - begun.time, 5'000'000) << fault;
    EXPECT_EQ(end.collisions, 0) << fault;
  }

  static constexpr std::int64_t braking = 625'000;
  static constexpr std::int64_t odometry_period = 20'000;
  static constexpr auto driver = "CPP UM driver RecklessDriver\n";

  bool simulated_time_ = true;
  test::TemporaryFolder folder_;
  std::unique_ptr<TestSystem> system_;
};

} // namespace

TEST_F(SafetySystem, StopsBeforeAWall) {
  begin("", driver);
  await_drive();
  system_->wait_until(
    "the guard stops the robot",
    [] {
      return watched().safety.reason == SafetyReason::obstacle &&
             std::abs(watched().body.velocity.forward) < 0.002;
    },
    120s);
  EXPECT_EQ(watched().body.collisions, 0);
  EXPECT_NEAR(watched().body.pose.x, 30 - 0.05 - 0.25 - 0.03, 0.04);
}

TEST_F(SafetySystem, StopsWhenTheDriverCrashes) {
  begin("", driver);
  expect_stop("crash driver");
}

TEST_F(SafetySystem, StopsWhenTheDriverHangs) {
  expect_stop_in_real_time("hang driver");
}

TEST_F(SafetySystem, StopsWhenTheWorkingMemoryCrashes) {
  begin("", driver);
  expect_stop("crash navigation_wm");
}

TEST_F(SafetySystem, RobotStopsWhenTheGuardHangs) {
  expect_stop_in_real_time("hang safety");
}

TEST_F(SafetySystem, StopsWhenTheLaserIsSilent) {
  begin("--laser-stops-after 5s", driver);
  await_drive();
  const auto end = await_stop();
  EXPECT_EQ(watched().reasons.back(), SafetyReason::laser_silent);
  EXPECT_LE(end.time, 5'000'000 + 300'000 + braking + odometry_period);
}

TEST_F(SafetySystem, StopsWhenTheLaserIsFrozen) {
  begin("--laser-freezes-after 5s", driver);
  await_drive();
  const auto end = await_stop();
  EXPECT_EQ(watched().reasons.back(), SafetyReason::laser_frozen);
  EXPECT_LE(end.time, 5'000'000 + 300'000 + braking + odometry_period);
}

TEST_F(SafetySystem, DrivesOnWhenEverythingIsBack) {
  begin("", driver);
  expect_stop("crash navigation_wm");
  system_->expect_back("navigation_wm");
  await_drive();
  system_->inject("crash safety");
  system_->expect_back("safety");
  await_drive();
  system_->wait_until("the guard allows it",
                      [] { return watched().safety.reason == SafetyReason::none; });
}

TEST_F(SafetySystem, NobodyPassesTheGuard) {
  begin("", "CPP UM bypasser Bypasser\n");
  system_->wait_until("the robot refuses", [] { return !watched().refusal.empty(); });
  EXPECT_EQ(watched().refusal, "robot obeys only safety, not bypasser of navigation: command that "
                               "one");
  EXPECT_EQ(watched().body.driven, 0);
}

TEST_F(SafetySystem, LaserWithoutNoiseIsNotFrozenWhereTheRobotStands) {
  begin("--range-noise 0 --missing 0", driver, "--laser-has-noise false");
  await_drive();
  EXPECT_EQ(watched().safety.reason, SafetyReason::none);
}

} // namespace castor::mapping
