// The SimulatedArm as a component: who may command it, and when it comes to rest.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/manipulation/motion_window.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/tests/planning/body/arm_at_table.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace castor::manipulation {

namespace {

using namespace std::chrono_literals;

struct Told {
  std::atomic<bool> is_moving = false;
  std::atomic<bool> is_over = false;
  std::string refusal;
  ArmState before;
  ArmState after;
  std::chrono::microseconds rested{0};
};

Told& told() {
  static Told instance;
  return instance;
}

Trajectory turn() {
  const auto arm = katana();
  auto to = aside();
  to[0] = -90 * degree;
  return motion(arm, aside(), to).trajectory;
}

class CommandsAnArm : public UnmanagedComponent {
protected:
  void start() override {
    on_push<ArmState>("arm", [this](auto& x) { state_ = *x; });
    state_ = *pull<ArmState>("arm");
  }

  /// Commands until the arm has come to that time on its motion.
  void move_until(double time) {
    while (is_running() && state_.motion_time < time) {
      auto command = motion_window(trajectory_, 1, state_.motion == 1 ? state_.motion_time : 0);
      command.opening = 0.1;
      stream_command("arm", command);
      sleep_for(40ms);
    }
  }

  void wait_for_rest() {
    const auto begun = now();
    while (is_running() && !state_.rests && now() < begun + 10s)
      sleep_for(10ms);
    told().rested = now() - begun;
  }

  Trajectory trajectory_ = turn();
  ArmState state_;
};

/// Stops commanding in the middle of a motion.
class SilentCommander final : public CommandsAnArm {
  void run() override {
    auto seat = here("seat");
    put(seat, ArmSeat{});
    const auto lease = lock(seat, LockLevel::o);
    move_until(trajectory_.duration() / 2);
    wait_for_rest();
    told().after = *pull<ArmState>("arm");
    told().is_over = true;
  }
};
CASTOR_COMPONENT(SilentCommander, "stops commanding an arm")

/// Fails in the middle of a motion.
class FailingCommander final : public CommandsAnArm {
  void run() override {
    auto seat = here("seat");
    if (told().is_moving) {
      wait_for_rest();
      told().after = *pull<ArmState>("arm");
      told().is_over = true;
      return;
    }
    put(seat, ArmSeat{});
    const auto lease = lock(seat, LockLevel::o);
    move_until(trajectory_.duration() / 2);
    told().is_moving = true;
    move_until(trajectory_.duration() * 2);
  }
};
CASTOR_COMPONENT(FailingCommander, "fails while it commands an arm")

/// Does not sit in the seat.
class Usurper final : public CommandsAnArm {
  void run() override {
    try {
      command("arm", motion_window(trajectory_, 1, 0));
    } catch (const CommandRefused& e) {
      told().refusal = e.what();
    }
    sleep_for(500ms);
    told().after = *pull<ArmState>("arm");
    told().is_over = true;
  }
};
CASTOR_COMPONENT(Usurper, "commands an arm without its seat")

class SimulatedArmSystem : public testing::Test {
protected:
  void SetUp() override {
    told().is_moving = false;
    told().is_over = false;
    told().refusal.clear();
    told().after = {};
  }

  void start(const std::string& commander, const std::string& options = {}) {
    system_ = std::make_unique<TestSystem>(
      "COMPONENT CPP arm SimulatedArm --scene " CASTOR_CONFIGS
      "/scenes/arm.scene --arm " CASTOR_CONFIGS "/arms/katana.arm --start \"90 -20 110 60 90\" "
      "--lease manipulation/seat " +
        options +
        "\n"
        "COMPONENT CPP camera TableCamera --scene " CASTOR_CONFIGS "/scenes/arm.scene\n"
        "SUBARCHITECTURE manipulation\n"
        "CPP WM SubarchitectureWorkingMemory\n"
        "CPP TM AlwaysPositiveTaskManager\n"
        "CPP UM commander " +
        commander + "\nSUPERVISE * RESTARTS 10 IN 10s\n",
      TestSystemOptions{.patience = 60s, .simulated_time = true});
  }

  void wait_until_over() {
    system_->wait_until("the commander is done", [] { return told().is_over.load(); });
  }

  std::unique_ptr<TestSystem> system_;
};

TEST_F(SimulatedArmSystem, ComesToRestWhenItsCommanderIsSilent) {
  start("SilentCommander");
  wait_until_over();
  EXPECT_TRUE(told().after.rests);
  // 300 ms that the command holds, 800 ms to stop, and what it lags behind.
  EXPECT_LE(told().rested, 1400ms);
  EXPECT_GE(told().rested, 300ms);
  const auto there = turn().at(told().after.motion_time).positions;
  for (std::size_t i = 0; i < there.size(); ++i)
    EXPECT_NEAR(told().after.positions[i], there[i], 0.01) << "on its motion";
}

TEST_F(SimulatedArmSystem, ComesToRestWhenItsCommanderFails) {
  start("FailingCommander");
  system_->wait_until("the arm moves", [] { return told().is_moving.load(); });
  system_->inject("crash commander");
  system_->expect_back("commander");
  wait_until_over();
  EXPECT_TRUE(told().after.rests);
  EXPECT_LT(told().after.motion_time, turn().duration());
}

TEST_F(SimulatedArmSystem, ObeysOnlyWhoSitsInItsSeat) {
  start("Usurper");
  wait_until_over();
  EXPECT_THAT(told().refusal, testing::HasSubstr("lease"));
  EXPECT_EQ(told().after.motion, 0);
  EXPECT_TRUE(told().after.rests);
}

TEST_F(SimulatedArmSystem, IsWhereItWasWhenItsComponentIsStartedAgain) {
  start("SilentCommander");
  wait_until_over();
  const auto before = told().after.positions;
  told().is_over = false;
  system_->inject("crash arm");
  system_->expect_back("arm");
  system_->inject("crash commander");
  system_->expect_back("commander");
  system_->wait_until("the commander goes on", [] { return told().is_over.load(); });
  EXPECT_TRUE(told().after.rests);
  EXPECT_EQ(told().after.positions, before);
  EXPECT_NE(before, aside());
}

TEST_F(SimulatedArmSystem, IsWhereItWasByItsStateFile) {
  const castor::test::TemporaryFolder folder;
  start("FailingCommander", "--state " + (folder.path() / "arm.state").string());
  system_->wait_until("the arm moves", [] { return told().is_moving.load(); });
  system_->inject("crash commander");
  system_->expect_back("commander");
  wait_until_over();
  const auto before = told().after.positions;
  system_->advance(500ms);
  told().is_over = false;
  system_->inject("crash arm");
  system_->expect_back("arm");
  system_->inject("crash commander");
  system_->expect_back("commander", 3);
  system_->wait_until("the commander goes on", [] { return told().is_over.load(); });
  EXPECT_TRUE(told().after.rests);
  EXPECT_EQ(told().after.motion, 0) << "it was made anew, from the file";
  EXPECT_EQ(told().after.positions, before);
  EXPECT_NE(before, aside());
}

} // namespace

} // namespace castor::manipulation
