// Robots and drivers as components of a system, in simulated time.

#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/octree/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/perception/vision/types.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
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

/// What a watcher has got.
struct Seen {
  std::vector<Odometry> odometry;
  std::vector<LaserScan> scans;
  std::vector<BodyStatus> statuses;
  std::string refusal;
  std::size_t frames = 0;
  std::vector<SensedCloud> clouds;
};

Seen& seen() {
  static Seen instance;
  return instance;
}

class DriveWatcher final : public UnmanagedComponent {
  void start() override {
    on_push<Odometry>("robot", [](auto& x) { seen().odometry.push_back(*x); });
    on_push<LaserScan>("robot", [](auto& x) { seen().scans.push_back(*x); });
    on_push<BodyStatus>("robot", [](auto& x) { seen().statuses.push_back(*x); });
  }
};
CASTOR_COMPONENT(DriveWatcher, "keeps what a robot pushes")

class SceneWatcher final : public UnmanagedComponent {
  void start() override {
    on_push<vision::CameraFrame>("robot", [](auto& x) {
      EXPECT_EQ(x->image.bytes.size(), 3u * 80u * 60u);
      ++seen().frames;
    });
    on_push<SensedCloud>("robot", [](auto& x) { seen().clouds.push_back(*x); });
  }
};
CASTOR_COMPONENT(SceneWatcher, "keeps what a robot's camera sees")

/// Commands the robot once.
class PushOff final : public UnmanagedComponent {
  void run() override {
    try {
      command("robot", DriveCommand{{0.5, 0}});
    } catch (const CommandRefused& e) {
      seen().refusal = e.what();
    }
  }
};
CASTOR_COMPONENT(PushOff, "commands a robot once")

/// Tells of the true pose with an offset, as a localisation that has another map frame; nothing
/// while the robot stands.
class ShiftedLocalisation final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [this](auto& x) {
      if (x->time % 200'000 != 0 || x->pose == told_)
        return;
      told_ = x->pose;
      RobotPose pose;
      pose.time = x->time;
      pose.frame = "map";
      pose.pose = x->pose;
      pose.pose.x += 100;
      pose.state = LocalisationState::tracking;
      put(here("pose"), pose);
    });
  }

  std::optional<Pose2> told_;
};
CASTOR_COMPONENT(ShiftedLocalisation, "says where the robot is")

/// Is off by more than a robot has room in a door, until the robot has stood before it and has gone
/// elsewhere, so many times.
class WrongLocalisation final : public UnmanagedComponent {
  void start() override {
    on_push<BodyStatus>("robot", [this](auto& x) {
      const Point2 place{x->pose.x, x->pose.y};
      if (distance(place, stood_at_) > 0.03) {
        stood_at_ = place;
        stands_since_ = x->time;
      }
      if (x->time - stands_since_ > 2'000'000 && x->pose.x > 4)
        stuck_at_ = place;
      if (stuck_at_ && distance(place, *stuck_at_) > 0.3) {
        stuck_at_.reset();
        ++left_;
      }
      if (x->time % 200'000 != 0)
        return;
      RobotPose pose;
      pose.time = x->time;
      pose.frame = "map";
      pose.pose = x->pose;
      pose.pose.y += left_ < times_ ? 0.25 : 0;
      pose.state = LocalisationState::tracking;
      put(here("pose"), pose);
    });
  }

  Option<int> times_{this, "times", 1, "how often the robot has to have gone from where it stood"};

  int left_ = 0;
  Point2 stood_at_;
  std::int64_t stands_since_ = 0;
  std::optional<Point2> stuck_at_;
};
CASTOR_COMPONENT(WrongLocalisation, "says wrongly where the robot is, until it is stuck")

class DriveSystem : public testing::Test {
protected:
  void SetUp() override {
    seen() = {};
    write("hut.building", "wall 0 0 to 8 0 to 8 5 to 0 5 close thickness 0.2\n"
                          "wall 5 0 to 5 5\n"
                          "door d at 5 2.5 width 0.9\n"
                          "start 2 2.5\n");
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream{folder_.path() / name} << text;
  }

  /// Runs the system for that long at most; its time begins at zero.
  std::unique_ptr<System> run(const std::string& robot_options, const std::string& drivers,
                              std::chrono::milliseconds time) {
    auto parsed =
      cast::parse_string("COMPONENT CPP robot SimulatedRobot --building hut.building --base " +
                           folder_.path().string() + " " + robot_options +
                           "\n"
                           "SUBARCHITECTURE navigation\n"
                           "CPP WM SubarchitectureWorkingMemory\n"
                           "CPP TM AlwaysPositiveTaskManager\n"
                           "CPP UM watcher DriveWatcher\n" +
                           drivers,
                         "test.cast");
    EXPECT_TRUE(parsed.ok()) << render(parsed.diagnostics);
    SystemOptions options;
    options.clock.pace = Pace{};
    options.clock.reproducible = true;
    auto system = std::make_unique<System>(parsed.architecture.value(), options);
    EXPECT_TRUE(system->start());
    system->wait({.at_most = time});
    system->stop();
    for (auto& x : system->summary().components)
      EXPECT_EQ(x.failure, "") << x.identity.name;
    return system;
  }

  static std::vector<PathProgress> progress(System& system) {
    std::vector<PathProgress> result;
    for (auto& entry : system.entries("navigation"))
      if (auto x = entry->value.as<PathProgress>())
        result.push_back(*x);
    return result;
  }

  test::TemporaryFolder folder_;
};

} // namespace

TEST_F(DriveSystem, PushesAtItsRates) {
  run("--laser 360", "", 2s);
  ASSERT_GE(seen().odometry.size(), 98u);
  EXPECT_LE(seen().odometry.size(), 100u);
  ASSERT_GE(seen().scans.size(), 19u);
  EXPECT_LE(seen().scans.size(), 20u);
  EXPECT_EQ(seen().odometry[0].time, 20'000);
  EXPECT_EQ(seen().scans[9].time, 1'000'000);
  EXPECT_EQ(seen().scans[0].ranges.size(), 360u);
  EXPECT_EQ(seen().odometry[0].pose, (Pose2{2, 2.5, 0})) << "it begins where the robot does";
}

TEST_F(DriveSystem, StopsWithoutFurtherCommands) {
  run("--valid-for 500ms --slip 0 --diameter-error 0", "CPP UM pusher PushOff\n", 4s);
  ASSERT_FALSE(seen().statuses.empty());
  auto& last = seen().statuses.back();
  // 0.4 m/s are reached after half a second, and it brakes as fast.
  EXPECT_NEAR(last.driven, 0.2, 0.03);
  EXPECT_EQ(last.velocity, Twist2{});
  EXPECT_EQ(last.collisions, 0);
}

TEST_F(DriveSystem, ObeysOnlyWhoSitsInTheSeat) {
  auto system = run("--lease navigation/seat",
                    "CPP UM driver PathDriver --path \"2 2.5, 4 2.5\" --seat seat\n"
                    "CPP UM pusher PushOff\n",
                    20s);
  EXPECT_NE(seen().refusal.find("lease of navigation/seat"), std::string::npos) << seen().refusal;
  ASSERT_EQ(progress(*system).size(), 1u);
  EXPECT_TRUE(progress(*system)[0].arrived);
  EXPECT_NEAR(seen().statuses.back().pose.x, 4, 0.2);
}

TEST_F(DriveSystem, PathLeadsThroughADoor) {
  write("tour.path", "2 2.5\n7 2.5\n7 1\n");
  auto system = run(
    "", "CPP UM driver PathDriver --file tour.path --base " + folder_.path().string() + "\n", 40s);
  ASSERT_EQ(progress(*system).size(), 1u);
  EXPECT_TRUE(progress(*system)[0].arrived);
  EXPECT_NEAR(progress(*system)[0].length, 6.5, 1e-9);
  auto& last = seen().statuses.back();
  EXPECT_NEAR(last.pose.x, 7, 0.3);
  EXPECT_NEAR(last.pose.y, 1, 0.3);
  EXPECT_EQ(last.collisions, 0);
}

TEST_F(DriveSystem, DriverWaitsForAFreeWay) {
  auto system =
    run("--shut d", "CPP UM driver PathDriver --back-off 0s --path \"2 2.5, 7 2.5\"\n", 15s);
  ASSERT_EQ(progress(*system).size(), 1u);
  EXPECT_FALSE(progress(*system)[0].arrived);
  EXPECT_EQ(progress(*system)[0].waits_for, "a free way");
  auto& last = seen().statuses.back();
  EXPECT_EQ(last.collisions, 0);
  EXPECT_GT(last.pose.x, 4);
}

TEST_F(DriveSystem, DriverSteersAsideOfADoorPostThatReachesIntoItsWay) {
  // The middle of the door is at y = 2.5, and there are 0.2 m on both sides of the robot.
  for (const std::string y : {"2.24", "2.3", "2.75"}) {
    seen() = {};
    const auto path = " --path \"2 2.5, 2.6 " + y + ", 7 " + y + "\"\n";
    auto system = run("", "CPP UM driver PathDriver" + path, 40s);
    ASSERT_EQ(progress(*system).size(), 1u);
    EXPECT_TRUE(progress(*system)[0].arrived) << y << " " << progress(*system)[0].waits_for;
    EXPECT_EQ(seen().statuses.back().collisions, 0) << y;
  }
  seen() = {};
  auto system =
    run("", "CPP UM driver PathDriver --aside 0 --back-off 0s --path \"2 2.5, 2.6 2.24, 7 2.24\"\n",
        40s);
  EXPECT_EQ(progress(*system)[0].waits_for, "a free way, for more than 30 s: clear it");
}

TEST_F(DriveSystem, DriverPassesWhatReachesALittleIntoItsWay) {
  // It stops for what is nearer than 0.27 m to its way, and scans are noisy: at such a distance
  // they say now this and now that.
  for (const std::string y : {"2.39", "2.405", "2.41", "2.415"})
    for (const std::string seed : {"1", "2", "3"}) {
      write("hut.building", "wall 0 0 to 8 0 to 8 5 to 0 5 close thickness 0.2\n"
                            "wall 5 0 to 5 5\n"
                            "door d at 5 2.5 width 0.85\n"
                            "furniture ball at 4.1 2 disc 0.3 0.4\n"
                            "start 6.5 " +
                              y + " heading 180\n");
      seen() = {};
      auto system = run(
        "--seed " + seed,
        "CPP UM driver PathDriver --back-off 0s --path \"6.5 " + y + ", 1.7 " + y + "\"\n", 60s);
      ASSERT_EQ(progress(*system).size(), 1u);
      EXPECT_TRUE(progress(*system)[0].arrived)
        << y << ", seed " << seed << ": " << progress(*system)[0].waits_for;
      EXPECT_EQ(seen().statuses.back().collisions, 0) << y << ", seed " << seed;
    }
}

TEST_F(DriveSystem, DriverAsksForAFreeWayAfterItsPatience) {
  auto system =
    run("--shut d",
        "CPP UM driver PathDriver --back-off 0s --patience 5s --path \"2 2.5, 7 2.5\"\n", 20s);
  ASSERT_EQ(progress(*system).size(), 1u);
  EXPECT_EQ(progress(*system)[0].waits_for, "a free way, for more than 5 s: clear it");
  EXPECT_EQ(seen().statuses.back().collisions, 0);
}

TEST_F(DriveSystem, DriverGoesBackFromADoorPostAndComesAgain) {
  const std::string driver = "CPP UM localisation WrongLocalisation\n"
                             "CPP UM driver PathDriver --aside 0 --path \"2 2.5, 7 2.5\" --pose "
                             "localisation --localisation navigation";
  const auto stuck = progress(*run("", driver + " --back-off 0s\n", 60s));
  ASSERT_EQ(stuck.size(), 1u);
  EXPECT_FALSE(stuck[0].arrived);
  EXPECT_EQ(seen().statuses.back().collisions, 0);
  seen() = {};
  const auto freed = progress(*run("", driver + "\n", 60s));
  ASSERT_EQ(freed.size(), 1u);
  EXPECT_TRUE(freed[0].arrived) << freed[0].waits_for;
  EXPECT_NEAR(seen().statuses.back().pose.x, 7, 0.2);
  EXPECT_NEAR(seen().statuses.back().pose.y, 2.5, 0.2);
  EXPECT_EQ(seen().statuses.back().collisions, 0);
}

TEST_F(DriveSystem, DriverThatHasAskedForAFreeWayGoesBackAgain) {
  // More often than it does so before it asks.
  const auto freed = progress(
    *run("",
         "CPP UM localisation WrongLocalisation --times 5\n"
         "CPP UM driver PathDriver --aside 0 --recoveries 3 --patience 10s --path \"2 2.5, 7 "
         "2.5\" --pose localisation --localisation navigation\n",
         300s));
  ASSERT_EQ(freed.size(), 1u);
  EXPECT_TRUE(freed[0].arrived) << freed[0].waits_for;
  EXPECT_NEAR(seen().statuses.back().pose.x, 7, 0.2);
  EXPECT_EQ(seen().statuses.back().collisions, 0);
}

TEST_F(DriveSystem, DriverThatFailsTakesThePoseOfARobotThatStands) {
  const auto folder = folder_.path().string();
  TestSystemOptions options;
  options.simulated_time = true;
  options.patience = 60s;
  TestSystem system{
    "COMPONENT CPP robot SimulatedRobot --shut d --building hut.building --base " + folder +
      "\n"
      "SUBARCHITECTURE navigation\n"
      "CPP WM SubarchitectureWorkingMemory\n"
      "CPP TM AlwaysPositiveTaskManager\n"
      "CPP UM shifted ShiftedLocalisation\n"
      "CPP UM driver PathDriver --back-off 0s --patience 0s --path \"102 2.5, 107 2.5\" "
      "--pose localisation --localisation navigation\n",
    options};
  system.expect_entry("PathProgress in navigation where waits_for == \"a free way\"");
  system.advance(2s);
  const auto crashed = system.system().now();
  system.inject("crash driver");
  system.expect_back("driver");
  system.wait_until("the driver knows where it is", [&] {
    const auto known = progress(system.system());
    return known.size() == 1 && known[0].time > crashed.count() &&
           known[0].waits_for == "a free way";
  });
}

TEST_F(DriveSystem, DriverIsToldByLocalisation) {
  auto system = run("--slip 0.05",
                    "CPP UM shifted ShiftedLocalisation\n"
                    "CPP UM driver PathDriver --path \"102 2.5, 104 2.5, 104 1\" --pose "
                    "localisation --localisation navigation\n",
                    30s);
  ASSERT_EQ(progress(*system).size(), 1u);
  EXPECT_TRUE(progress(*system)[0].arrived);
  EXPECT_NEAR(seen().statuses.back().pose.x, 4, 0.2) << "in the building";
  EXPECT_NEAR(seen().statuses.back().pose.y, 1, 0.2);
}

TEST_F(DriveSystem, LaserThatStopsPushesNoMore) {
  run("--laser-stops-after 1s", "", 3s);
  EXPECT_LE(seen().scans.size(), 10u);
  EXPECT_GE(seen().odometry.size(), 140u);
}

TEST_F(DriveSystem, CameraPushesPicturesAndPoints) {
  run("--camera-period 500ms --camera-width 80 --camera-height 60", "CPP UM scene SceneWatcher\n",
      2s);
  EXPECT_GE(seen().frames, 3u);
  ASSERT_GE(seen().clouds.size(), 3u);
  auto& cloud = seen().clouds.back();
  EXPECT_GT(cloud.coordinates.size(), 3u * 2000u);
  EXPECT_NEAR(cloud.sensor.z, 0.6, 1e-9);
  EXPECT_EQ(cloud.time % 500'000, 0);
}

TEST_F(DriveSystem, BeginsWhereItIsTold) {
  run("--start \"6 1 heading 90\" --odometry-start zero", "", 1s);
  ASSERT_FALSE(seen().statuses.empty());
  EXPECT_EQ(seen().statuses.back().pose.x, 6);
  EXPECT_NEAR(seen().statuses.back().pose.heading, 1.5708, 1e-4);
  EXPECT_EQ(seen().odometry.back().pose, Pose2{});
}

TEST_F(DriveSystem, RobotAndDriverGoOnAfterAFailure) {
  {
    const auto folder = folder_.path().string();
    TestSystem system{
      "COMPONENT CPP robot SimulatedRobot --building hut.building --base " + folder + " --state " +
      folder +
      "/robot.state --lease navigation/seat\n"
      "SUBARCHITECTURE navigation\n"
      "CPP WM SubarchitectureWorkingMemory\n"
      "CPP TM AlwaysPositiveTaskManager\n"
      "CPP UM watcher DriveWatcher\n"
      "CPP UM driver PathDriver --path \"2 2.5, 4.5 2.5\" --speed 0.8 --seat seat\n"};
    system.expect_entry("PathProgress in navigation where done > 0.5");
    system.inject("crash robot");
    system.expect_back("robot");
    system.expect_entry("PathProgress in navigation where done > 1.2");
    system.inject("crash driver");
    system.expect_back("driver");
    system.expect_entry("PathProgress in navigation where arrived == true");
    system.expect_nobody_else_down({"robot", "driver"});
  }
  ASSERT_FALSE(seen().statuses.empty());
  const auto& statuses = seen().statuses;
  for (std::size_t i = 1; i < statuses.size(); ++i)
    // At most what it drives between two savings of its state.
    EXPECT_LT(std::abs(statuses[i].pose.x - statuses[i - 1].pose.x), 0.45) << i;
  EXPECT_NEAR(statuses.back().pose.x, 4.5, 0.2);
}

TEST_F(DriveSystem, DriverThatHasLostItsSeatTakesItAgain) {
  const auto folder = folder_.path().string();
  TestSystem system{"COMPONENT CPP robot SimulatedRobot --building hut.building --base " + folder +
                    " --lease navigation/seat\n"
                    "SUBARCHITECTURE navigation\n"
                    "CPP WM SubarchitectureWorkingMemory\n"
                    "CPP TM AlwaysPositiveTaskManager\n"
                    "CPP UM watcher DriveWatcher\n"
                    "CPP UM driver PathDriver --path \"2 2.5, 4.5 2.5\" --speed 0.8 --seat seat\n"};
  system.expect_entry("PathProgress in navigation where done > 0.5");
  // All leases have expired.
  system.advance(1h);
  system.expect_entry("PathProgress in navigation where arrived == true");
  system.expect_nobody_else_down({});
}

TEST_F(DriveSystem, IsTheSameForTheSameSeed) {
  const std::string driver = "CPP UM driver PathDriver --path \"2 2.5, 4 2.5, 4 1\"\n";
  auto drive = [&](const std::string& options) {
    seen() = {};
    run(options, driver, 12s);
    return seen().statuses.back().pose;
  };
  const auto once = drive("--seed 5");
  EXPECT_EQ(drive("--seed 5"), once);
  EXPECT_NE(drive("--seed 6"), once);
}

} // namespace castor::mapping
