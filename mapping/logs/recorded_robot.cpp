#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/mapping/logs/robot_log_file.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::mapping {

namespace {

/// A robot whose way was recorded: pushes and provides the scans and the odometry of a log, each
/// when it was measured, counted from the first. One that is started again after a failure goes on
/// with what is due then: the robot drove on meanwhile.
class RecordedRobot final : public StandaloneComponent {
  void configure() override {
    if (file_->empty())
      throw std::invalid_argument("--file is not set: name a CARMEN log or a rawlog");
    auto read = read_robot_log(file_named(file_, base_.get()));
    if (!read.log)
      throw std::invalid_argument(render(read.diagnostics));
    for (auto& x : read.diagnostics)
      warning("{}", render(x));
    recorded_ = std::move(*read.log);
  }

  void start() override {
    provide<LaserScan>([this] { return newest_.scan; });
    provide<Odometry>([this] { return newest_.odometry; });
  }

  void run() override {
    auto odometry = recorded_.odometry.begin();
    first_ = recorded_.scans.front().scan.time;
    if (odometry != recorded_.odometry.end())
      first_ = std::min(first_, odometry->time);
    begun_ = now();
    if (begun_ >= late_start_.get()) {
      info("goes on {:.1f} s after the beginning of the log",
           std::chrono::duration<double>(begun_).count());
      due_from_ = std::exchange(begun_, Timestamp{0});
    }
    for (auto& x : recorded_.scans) {
      for (; odometry != recorded_.odometry.end() && odometry->time <= x.scan.time; ++odometry)
        if (!is_over(odometry->time) && (!wait_until(odometry->time) || !give(*odometry)))
          return;
      if (is_over(x.scan.time))
        continue;
      if (!wait_until(x.scan.time) || !give(x.odometry))
        return;
      newest_.scan = x.scan;
      newest_.scan.time = time_of(x.scan.time);
      push(newest_.scan);
    }
    info("the log is over: {} scans", recorded_.scans.size());
    if (ends_ && sleep_for(linger_.get()))
      end_system(0, "the log is over");
  }

  bool give(Odometry odometry) {
    // A scan and its odometry may stand in the log twice.
    odometry.time = time_of(odometry.time);
    if (odometry.time > newest_.odometry.time || !has_odometry_)
      push(odometry);
    has_odometry_ = true;
    newest_.odometry = odometry;
    return is_running();
  }

  /// In the time of the system.
  std::int64_t time_of(std::int64_t logged) const {
    return logged - first_ + std::chrono::duration_cast<std::chrono::microseconds>(begun_).count();
  }

  /// It was due before this component was started.
  bool is_over(std::int64_t logged) const {
    return std::chrono::microseconds{time_of(logged)} < due_from_;
  }

  bool wait_until(std::int64_t logged) {
    auto due = std::chrono::microseconds{time_of(logged)};
    // What is due already is pushed at once, but the component can still be stopped.
    return due > now() ? sleep_for(due - now()) : is_running();
  }

  Option<std::string> file_{this, "file", "", "a CARMEN log, compressed or not, or an MRPT rawlog"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<bool> ends_{this, "ends", true, "whether the system ends with the log"};
  Option<std::chrono::milliseconds> late_start_{
    this, "late-start", std::chrono::seconds{3},
    "a start so long after that of the system is one after a failure: it goes on with what is due"};
  Option<std::chrono::milliseconds> linger_{this, "linger", std::chrono::seconds{1},
                                            "the system ends so long after the log, for others to "
                                            "finish their work"};

  RobotLog recorded_;
  LoggedScan newest_;
  bool has_odometry_ = false;
  std::int64_t first_ = 0;
  /// When the log began.
  Timestamp begun_{0};
  Timestamp due_from_{0};
};

CASTOR_COMPONENT(RecordedRobot, "pushes the scans and the odometry of a recorded robot")

} // namespace

} // namespace castor::mapping
