#include "castor/mapping/logs/carmen_log.hpp"

#include "castor/base/input_file.hpp"
#include "castor/mapping/logs/carmen_line.hpp"
#include "castor/mapping/logs/gzip.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace castor::mapping {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;
constexpr std::size_t most_messages = 20;
constexpr std::size_t shown_of_line = 80;

/// A mount further from the robot's middle than this is the path of another estimate.
constexpr double most_mount = 1;

class CarmenLogReader {
public:
  CarmenLogReader(const std::string& file, const CarmenLogOptions& options)
    : file_(file), options_(options) {}

  void read_line(std::string_view line) {
    ++number_;
    CarmenWords words{line};
    try {
      read_message(words.next(), words);
    } catch (const CarmenLineError& e) {
      report(line, e.what(), e.remedy, e.column);
    }
  }

  RobotLogResult result() && {
    RobotLogResult result;
    auto has_robotlaser = !robotlaser_.lines.empty();
    auto& series = has_robotlaser ? robotlaser_ : flaser_;
    auto& scans = series.lines;
    if (scans.empty() && !has_errors(diagnostics_))
      add(Severity::error, 0, {}, "the log has no scans of a laser",
          "take a log with lines FLASER or ROBOTLASER1", 0);
    if (messages_ > most_messages)
      add(has_errors(diagnostics_) ? Severity::error : Severity::warning, 0, {},
          std::to_string(messages_ - most_messages) + " more lines cannot be used", {}, 0);
    if (!has_errors(diagnostics_)) {
      result.log.emplace();
      mount_scanner(scans);
      make_times_fit(series, has_robotlaser ? "ROBOTLASER1" : "FLASER",
                     [](CarmenScan& x) -> std::int64_t& { return x.scan.time; });
      make_times_fit(odometry_, "ODOM", [](Odometry& x) -> std::int64_t& { return x.time; });
      for (auto& x : scans) {
        auto logged = std::exchange(x.odometry.time, x.scan.time);
        result.log->scans.push_back({std::move(x.scan), x.odometry, logged});
      }
      result.log->odometry = std::move(odometry_.lines);
    }
    result.diagnostics = std::move(diagnostics_);
    return result;
  }

private:
  /// Lines that start with the same word.
  template <class T>
  struct Series {
    std::vector<T> lines;
    std::int64_t latest = std::numeric_limits<std::int64_t>::min();
    /// Lines whose time is before that of a line above.
    std::size_t backward = 0;
    std::size_t first_backward = 0;
  };

  void read_message(std::string_view kind, CarmenWords& words) {
    if (kind == "FLASER")
      add_scan(flaser_, read_flaser(words, angles_, options_.max_range));
    else if (kind == "ROBOTLASER1")
      add_scan(robotlaser_, read_robotlaser(words, options_.max_range));
    else if (kind == "ODOM")
      add_odometry(read_odom(words));
    else if (kind == "PARAM")
      read_parameter(words);
  }

  void add_scan(Series<CarmenScan>& series, CarmenScan scan) {
    if (!series.lines.empty()) {
      auto before = series.lines.back().scan.ranges.size();
      auto beams = scan.scan.ranges.size();
      if (beams != before)
        throw CarmenLineError("a scan of " + std::to_string(beams) + " beams after one of " +
                                std::to_string(before),
                              "a log has scans of one scanner: divide it, or delete the line", 1);
    }
    require_order(series, scan.scan.time);
    series.lines.push_back(std::move(scan));
  }

  void add_odometry(const Odometry& x) {
    require_order(odometry_, x.time);
    odometry_.lines.push_back(x);
  }

  template <class T>
  void require_order(Series<T>& series, std::int64_t time) {
    auto before = std::exchange(series.latest, std::max(series.latest, time));
    if (time >= before)
      return;
    if (series.backward++ == 0)
      series.first_backward = number_;
    if (static_cast<double>(before - time) / 1e6 > options_.most_lateness)
      throw CarmenLineError("time runs backward by " +
                              std::to_string(static_cast<double>(before - time) / 1e6) + " s",
                            "sort the lines by their time, or delete the line", 1);
  }

  void read_parameter(CarmenWords& words) {
    auto name = words.next();
    if (name == "laser_front_laser_fov") {
      auto degrees = words.number("the field of view");
      if (degrees > 0 && degrees <= 360)
        angles_.field_of_view = degrees * std::numbers::pi / 180;
    } else if (name == "robot_frontlaser_offset") {
      offset_ = words.number("the offset of the laser");
    }
  }

  // A message that was taken late has a time that is too late; all are in the order in which they
  // were sent.
  template <class T, class TimeOf>
  void make_times_fit(Series<T>& series, const char* kind, TimeOf time_of) {
    if (series.backward == 0)
      return;
    add(Severity::warning, series.first_backward, {},
        "time runs backward here and in " + std::to_string(series.backward - 1) + " later lines " +
          kind + ", so messages were logged late",
        "none is needed: times that are too late are set back to those of the lines below", 0);
    for (auto i = series.lines.size(); i-- > 1;)
      time_of(series.lines[i - 1]) =
        std::min(time_of(series.lines[i - 1]), time_of(series.lines[i]));
  }

  void mount_scanner(std::vector<CarmenScan>& scans) {
    Pose2 mount = between(scans.front().odometry.pose, scans.front().laser);
    if (offset_)
      mount = {*offset_, 0, 0};
    // The poses of laser and robot keep their distance, unless one of them is a corrected path.
    auto is_mount = std::hypot(mount.x, mount.y) <= most_mount &&
                    std::all_of(scans.begin(), scans.end(), [&](const CarmenScan& x) {
                      auto there = between(x.odometry.pose, x.laser);
                      return offset_ || distance(there, mount) < 0.02;
                    });
    if (!is_mount) {
      add(Severity::note, 0, {},
          "the poses of laser and robot are not those of a scanner that is screwed to a robot, so "
          "the scanner is taken to be in the robot's middle",
          "give its place in a line PARAM robot_frontlaser_offset", 0);
      mount = {};
    }
    for (auto& x : scans)
      x.scan.mount = mount;
  }

  void report(std::string_view line, const std::string& message, const std::string& remedy,
              std::size_t column) {
    if (++messages_ > most_messages)
      return;
    add(options_.skip_bad_lines ? Severity::warning : Severity::error, number_, line, message,
        remedy, column);
  }

  void add(Severity severity, std::size_t line_number, std::string_view line,
           const std::string& message, const std::string& remedy, std::size_t column) {
    Diagnostic x;
    x.severity = severity;
    x.where = SourceLocation{file_, line_number};
    // What is beyond the part that is shown has no column.
    x.line =
      std::string{line.substr(0, shown_of_line)} + (line.size() > shown_of_line ? "..." : "");
    x.column = column <= shown_of_line ? column : 0;
    x.message = message;
    x.remedy = remedy;
    diagnostics_.push_back(std::move(x));
  }

  std::string file_;
  CarmenLogOptions options_;
  std::size_t number_ = 0;
  std::size_t messages_ = 0;
  CarmenAngles angles_;
  std::optional<double> offset_;
  Series<CarmenScan> flaser_;
  Series<CarmenScan> robotlaser_;
  Series<Odometry> odometry_;
  std::vector<Diagnostic> diagnostics_;
};

RobotLogResult unreadable(const std::string& file, const std::string& message,
                          const std::string& remedy) {
  Diagnostic x;
  x.where = SourceLocation{file, 0};
  x.message = message;
  x.remedy = remedy;
  return {std::nullopt, {std::move(x)}};
}

} // namespace

RobotLogResult parse_carmen_log(std::string_view text, const std::string& file,
                                const CarmenLogOptions& options) {
  CarmenLogReader reader{file, options};
  while (!text.empty()) {
    auto end = text.find('\n');
    reader.read_line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return std::move(reader).result();
}

RobotLogResult read_carmen_log(const std::filesystem::path& file, const CarmenLogOptions& options) {
  try {
    auto bytes = read_input_file(file, most_bytes);
    if (is_gzip(bytes))
      bytes = gunzip(bytes, most_bytes);
    return parse_carmen_log(bytes, file.string(), options);
  } catch (const InputFileError& e) {
    return unreadable(file.string(), e.what(), "give the path of a CARMEN log");
  } catch (const GzipError& e) {
    return unreadable(file.string(), e.what(), "fetch or compress the file again");
  }
}

} // namespace castor::mapping
