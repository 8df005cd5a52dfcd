#include "castor/mapping/logs/carmen_line.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <system_error>
#include <vector>

namespace castor::mapping {

namespace {

constexpr std::size_t most_beams = 100000;

const char* const cut_off_remedy = "delete the line, or read with skipping of bad lines";

// Nothing came back from `max_range` on; 0 says so.
std::vector<float> read_ranges(CarmenWords& words, std::size_t beams, double max_range) {
  std::vector<float> result;
  result.reserve(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    auto range = words.number("a range");
    if (std::isnan(range) || range < 0)
      throw CarmenLineError("range " + std::to_string(i + 1) + " of " + std::to_string(beams) +
                              (range < 0 ? " is negative" : " is NaN"),
                            "write 0, or a range above the scanner's, where nothing came back",
                            words.column());
    result.push_back(range < max_range ? static_cast<float>(range) : 0.F);
  }
  return result;
}

std::size_t read_beams(CarmenWords& words) {
  auto result = words.count("the number of beams");
  if (result < 2 || result > most_beams)
    throw CarmenLineError("a scan of " + std::to_string(result) + " beams",
                          "a scan has 2 to " + std::to_string(most_beams) + " beams",
                          words.column());
  return result;
}

} // namespace

std::string_view CarmenWords::next() {
  auto is_space = [](char x) { return x == ' ' || x == '\t' || x == '\r'; };
  while (at_ < line_.size() && is_space(line_[at_]))
    ++at_;
  word_ = at_;
  while (at_ < line_.size() && !is_space(line_[at_]))
    ++at_;
  return line_.substr(word_, at_ - word_);
}

std::string_view CarmenWords::word(const char* what) {
  auto result = next();
  if (result.empty())
    throw CarmenLineError(std::string{"the line is cut off: "} + what + " is missing",
                          cut_off_remedy, column());
  return result;
}

double CarmenWords::number(const char* what) {
  auto text = word(what);
  double result = 0;
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  if (error != std::errc{} || end != text.data() + text.size())
    throw CarmenLineError("'" + std::string{text.substr(0, 40)} + "' is no number: it is " + what,
                          "write a number, or delete the line", column());
  return result;
}

std::size_t CarmenWords::count(const char* what) {
  auto result = number(what);
  if (!(result >= 0 && result <= 1e9 && result == std::floor(result)))
    throw CarmenLineError(std::string{what} + " is no whole number", "delete the line", column());
  return static_cast<std::size_t>(result);
}

std::int64_t CarmenWords::time(const char* what) {
  auto seconds = number(what);
  if (!(std::abs(seconds) < 1e12))
    throw CarmenLineError(std::string{what} + " is no time in seconds", "delete the line",
                          column());
  return std::llround(seconds * 1e6);
}

Pose2 CarmenWords::pose(const char* what) {
  Pose2 result;
  for (auto* x : {&result.x, &result.y, &result.heading}) {
    *x = number(what);
    if (!std::isfinite(*x))
      throw CarmenLineError(std::string{what} + " is not finite", "delete the line", column());
  }
  result.heading = normalised(result.heading);
  return result;
}

void CarmenWords::skip(std::size_t words, const char* what) {
  for (std::size_t i = 0; i < words; ++i)
    word(what);
}

CarmenScan read_flaser(CarmenWords& words, const CarmenAngles& angles, double max_range) {
  using std::numbers::pi;
  CarmenScan result;
  auto beams = read_beams(words);
  auto& scan = result.scan;
  scan.ranges = read_ranges(words, beams, max_range);
  scan.max_range = max_range;
  // Of 181 beams the last is at the other end of the half turn; of 180 it is left out.
  auto view = angles.field_of_view.value_or(pi);
  auto steps = beams % 2 == 0 ? beams : beams - 1;
  scan.angle_step = view / static_cast<double>(steps);
  scan.first_angle = -view / 2;
  result.laser = words.pose("the pose of the laser");
  result.odometry.pose = words.pose("the pose of the robot");
  scan.time = result.odometry.time = words.time("the time");
  words.skip(1, "the name of the host");
  words.time("the time of the logger");
  return result;
}

CarmenScan read_robotlaser(CarmenWords& words, double max_range) {
  CarmenScan result;
  auto& scan = result.scan;
  words.skip(1, "the type of the laser");
  scan.first_angle = words.number("the first angle");
  words.skip(1, "the field of view");
  scan.angle_step = words.number("the angle from beam to beam");
  if (!(std::abs(scan.first_angle) < 10) || !(scan.angle_step > 0 && scan.angle_step < 2))
    throw CarmenLineError("these are no angles of a scanner",
                          "angles are radians, from the right to the left", words.column());
  auto range = words.number("the maximum range");
  scan.max_range = range > 0 ? std::min(range, max_range) : max_range;
  words.skip(2, "accuracy or remission mode");
  auto beams = read_beams(words);
  scan.ranges = read_ranges(words, beams, scan.max_range);
  words.skip(words.count("the number of remissions"), "a remission");
  result.laser = words.pose("the pose of the laser");
  result.odometry.pose = words.pose("the pose of the robot");
  result.odometry.velocity.forward = words.number("the velocity");
  result.odometry.velocity.turn = words.number("the velocity of turning");
  words.skip(3, "a safety distance or the turn axis");
  scan.time = result.odometry.time = words.time("the time");
  words.skip(1, "the name of the host");
  words.time("the time of the logger");
  return result;
}

Odometry read_odom(CarmenWords& words) {
  Odometry result;
  result.pose = words.pose("the pose of the robot");
  result.velocity.forward = words.number("the velocity");
  result.velocity.turn = words.number("the velocity of turning");
  words.number("the acceleration");
  result.time = words.time("the time");
  return result;
}

} // namespace castor::mapping
