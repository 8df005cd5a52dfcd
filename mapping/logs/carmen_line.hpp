#pragma once

#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace castor::mapping {

/// A line of a CARMEN log cannot be used.
struct CarmenLineError : std::runtime_error {
  CarmenLineError(const std::string& message, std::string what_to_do, std::size_t at)
    : std::runtime_error(message), remedy(std::move(what_to_do)), column(at) {}

  std::string remedy;
  /// From 1.
  std::size_t column;
};

/// Words of a line, separated by spaces.
class CarmenWords {
public:
  explicit CarmenWords(std::string_view line) : line_(line) {}

  /// The next word; empty at the end.
  std::string_view next();

  /// The next word, as a number. `what` is what it is, for the message: "the 3rd range". Throws
  /// CarmenLineError.
  double number(const char* what);
  std::size_t count(const char* what);
  std::int64_t time(const char* what);
  Pose2 pose(const char* what);
  void skip(std::size_t words, const char* what);

  std::size_t column() const { return word_ + 1; }

private:
  std::string_view word(const char* what);

  std::string_view line_;
  std::size_t at_ = 0;
  std::size_t word_ = 0;
};

/// A line with a scan.
struct CarmenScan {
  LaserScan scan;
  Odometry odometry;
  /// Of the laser, in the same frame as the odometry.
  Pose2 laser;
};

/// Angles of FLASER lines, if parameters have said them.
struct CarmenAngles {
  std::optional<double> field_of_view;
};

// These read what comes after the first word of the line. Throw CarmenLineError.
CarmenScan read_flaser(CarmenWords& words, const CarmenAngles& angles, double max_range);
CarmenScan read_robotlaser(CarmenWords& words, double max_range);
Odometry read_odom(CarmenWords& words);

} // namespace castor::mapping
