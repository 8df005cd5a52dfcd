// The component that stands for a recorded robot.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/mapping/planar/types.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace castor::mapping::test {

/// What a receiver has heard of a log.
struct HeardLog {
  std::vector<std::int64_t> scan_times;
  std::vector<double> odometry_xs;
  std::vector<float> last_ranges;
};
CASTOR_REFLECT(HeardLog, scan_times, odometry_xs, last_ranges)

namespace {

using castor::test::TemporaryFolder;

class LogListener final : public UnmanagedComponent {
  void start() override {
    on_push<Odometry>("robot", [this](const std::shared_ptr<const Odometry>& x) {
      heard_.odometry_xs.push_back(x->pose.x);
    });
    on_push<LaserScan>("robot", [this](const std::shared_ptr<const LaserScan>& x) {
      heard_.scan_times.push_back(x->time);
      heard_.last_ranges = x->ranges;
      if (heard_.scan_times.size() == 3)
        add(heard_);
    });
  }

  HeardLog heard_;
};
CASTOR_COMPONENT(LogListener, "notes what it hears of a log")

std::vector<Odometry>& odometry_kept() {
  static std::vector<Odometry> instance;
  return instance;
}

/// Keeps all odometry, and the newest as an entry.
class OdometryKeeper final : public UnmanagedComponent {
  void start() override {
    on_push<Odometry>("robot", [this](const std::shared_ptr<const Odometry>& x) {
      odometry_kept().push_back(*x);
      put(here("newest"), *x);
    });
  }
};
CASTOR_COMPONENT(OdometryKeeper, "keeps the odometry of a log")

std::string cast_with(const std::string& robot) {
  return "COMPONENT CPP robot RecordedRobot " + robot +
         "\n"
         "SUBARCHITECTURE mapping\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM listener LogListener\n";
}

TEST(RecordedRobot, PushesWhatWasRecordedWhenItWas) {
  TemporaryFolder folder;
  auto log = folder / "robot.log";
  std::ofstream(log) << "FLASER 4 1 2 3 4 0 0 0 0 0 0 100.0 host 100.0\n"
                        "ODOM 1 0 0 0 0 0 100.02 host 100.02\n"
                        "FLASER 4 1 2 3 5 2 0 0 2 0 0 100.05 host 100.05\n"
                        "FLASER 4 1 2 3 6 3 0 0 3 0 0 100.1 host 100.1\n";
  TestSystem system{cast_with("--ends no --file " + log.string())};
  auto entry = system.expect_entry("HeardLog in mapping");
  auto heard = entry->value.as<HeardLog>();
  ASSERT_TRUE(heard);
  ASSERT_EQ(heard->scan_times.size(), 3U);
  EXPECT_EQ(heard->scan_times[1] - heard->scan_times[0], 50'000);
  EXPECT_EQ(heard->scan_times[2] - heard->scan_times[0], 100'000);
  EXPECT_EQ(heard->odometry_xs, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(heard->last_ranges, (std::vector<float>{1, 2, 3, 6}));
}

TEST(RecordedRobot, GoesOnWhereTheLogIsAfterAFailure) {
  TemporaryFolder folder;
  auto log = folder / "robot.log";
  {
    // The odometry's x is its time since the beginning, seconds.
    std::ofstream text(log);
    for (int i = 0; i < 300; ++i)
      text << fmt::format("FLASER 2 1 1 {0} 0 0 {0} 0 0 {1} host {1}\n", 0.1 * i, 100 + 0.1 * i);
  }
  TestSystemOptions options;
  options.simulated_time = true;
  options.patience = std::chrono::seconds{60};
  TestSystem system{"COMPONENT CPP robot RecordedRobot --ends no --file " + log.string() +
                      "\n"
                      "SUBARCHITECTURE mapping\n"
                      "CPP WM SubarchitectureWorkingMemory\n"
                      "CPP TM AlwaysPositiveTaskManager\n"
                      "CPP UM keeper OdometryKeeper\n",
                    options};
  system.expect_entry("Odometry in mapping where pose.x > 6");
  system.inject("crash robot");
  system.expect_back("robot");
  system.expect_entry("Odometry in mapping where pose.x > 20");
  const auto heard = odometry_kept();
  ASSERT_GT(heard.size(), 150U);
  for (std::size_t i = 1; i < heard.size(); ++i) {
    EXPECT_GT(heard[i].pose.x, heard[i - 1].pose.x) << i;
    // The first start may have been a moment after that of the system.
    EXPECT_NEAR(static_cast<double>(heard[i].time) / 1e6, heard[i].pose.x, 0.5) << i;
  }
}

TEST(RecordedRobot, EndsTheSystemWithTheLog) {
  TemporaryFolder folder;
  auto log = folder / "robot.log";
  std::ofstream(log) << "FLASER 4 1 2 3 4 0 0 0 0 0 0 100.0 host 100.0\n";
  TestSystem system{cast_with("--linger 1ms --file " + log.string())};
  system.expect_end(0, "the log is over");
}

TEST(RecordedRobot, RefusesALogThatCannotBeUsed) {
  TemporaryFolder folder;
  auto log = folder / "robot.log";
  std::ofstream(log) << "FLASER 4 1 2\n";
  EXPECT_ANY_THROW(TestSystem{cast_with("--file " + log.string())});
  EXPECT_ANY_THROW(TestSystem{cast_with("--file none.rawlog")});
  EXPECT_ANY_THROW(TestSystem{cast_with("")});
}

} // namespace

} // namespace castor::mapping::test
