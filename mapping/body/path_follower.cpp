#include "castor/mapping/body/path_follower.hpp"

#include "castor/base/statement_words.hpp"
#include "castor/base/text_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

namespace {

constexpr double farthest = 10'000; // metres

/// Directions further aside than this are turned to on the spot, until they are within the second.
constexpr double begin_to_turn = 0.9; // radians
constexpr double end_to_turn = 0.2;   // radians

} // namespace

PathText parse_path(std::string_view text, const std::string& file_name) {
  PathText result;
  for (const auto& line : text_lines(text)) {
    // A comma ends a waypoint as the end of a line does.
    std::vector<std::vector<std::string>> points(1);
    for (std::string_view word : line.words) {
      for (auto comma = word.find(','); comma != word.npos; comma = word.find(',')) {
        if (comma > 0)
          points.back().emplace_back(word.substr(0, comma));
        points.emplace_back();
        word.remove_prefix(comma + 1);
      }
      if (!word.empty())
        points.back().emplace_back(word);
    }
    for (const auto& point : points) {
      if (point.empty())
        continue;
      try {
        StatementWords words(point);
        const double x = words.length("the x of a waypoint", -farthest, farthest);
        const double y = words.length("the y of a waypoint", -farthest, farthest);
        words.expect_end();
        if (result.path.empty() || result.path.back() != Point2{x, y})
          result.path.push_back({x, y});
      } catch (const StatementError& error) {
        result.problems.push_back(
          finding(Severity::error, file_name, line, error.what(), error.remedy()));
      }
    }
  }
  if (result.path.empty() && result.problems.empty())
    result.problems.push_back(finding(Severity::error, file_name, {}, "there is no waypoint",
                                      "Write two numbers on a line for each: 2.5 1"));
  return result;
}

PathFollower::PathFollower(Path path, const FollowOptions& options)
  : path_(std::move(path)), options_(options), along_{0} {
  for (std::size_t i = 1; i < path_.size(); ++i)
    along_.push_back(along_.back() + distance(path_[i - 1], path_[i]));
}

Point2 PathFollower::point_at(double way) const {
  const auto next = std::ranges::upper_bound(along_, way);
  if (next == along_.end())
    return path_.back();
  const auto i = static_cast<std::size_t>(next - along_.begin());
  const double share = (way - along_[i - 1]) / (along_[i] - along_[i - 1]);
  return {std::lerp(path_[i - 1].x, path_[i].x, share),
          std::lerp(path_[i - 1].y, path_[i].y, share)};
}

Point2 PathFollower::shifted_point_at(double way, double shift) const {
  const auto point = point_at(way);
  // Of the path around it.
  constexpr double half = 0.05; // metres
  const auto before = point_at(std::max(0.0, way - half));
  const auto after = point_at(std::min(along_.back(), way + half));
  const double length = distance(before, after);
  if (shift == 0 || length == 0)
    return point;
  return {point.x - shift * (after.y - before.y) / length,
          point.y + shift * (after.x - before.x) / length};
}

std::optional<double> PathFollower::free_shift(std::span<const Point2> points, double clearance,
                                               double way, double most) const {
  const double end = std::min(along_.back(), done_ + way);
  std::vector<Point2> near;
  for (const auto& x : points)
    if (distance(x, point_at(done_)) < way + clearance + most)
      near.push_back(x);
  const auto is_free = [&](double shift) {
    constexpr double step = 0.05; // metres
    for (double at = done_; at <= end; at += step) {
      const auto place = shifted_point_at(at, shift);
      for (const auto& x : near)
        if (distance(x, place) < clearance)
          return false;
    }
    return true;
  };
  constexpr double step = 0.02; // metres
  for (double shift = 0; shift <= most; shift += step)
    for (const double side : {1.0, -1.0})
      if (is_free(side * shift))
        return side * shift;
  return std::nullopt;
}

double PathFollower::aside(const Pose2& pose) const {
  const double at = progress_of(pose);
  const auto on_path = point_at(at);
  const auto left = shifted_point_at(at, 1);
  return (pose.x - on_path.x) * (left.x - on_path.x) + (pose.y - on_path.y) * (left.y - on_path.y);
}

double PathFollower::progress_of(const Pose2& pose) const {
  // Not further ahead, where the path may come back to this place.
  const double window = 2 * options_.look_ahead;
  constexpr int steps = 40;
  double best = done_;
  double best_distance = distance(point_at(done_), {pose.x, pose.y});
  for (int i = 1; i <= steps; ++i) {
    const double way = std::min(along_.back(), done_ + window * i / steps);
    if (const double d = distance(point_at(way), {pose.x, pose.y}); d < best_distance) {
      best = way;
      best_distance = d;
    }
  }
  return best;
}

Twist2 PathFollower::velocity_at(const Pose2& pose, double shift) {
  done_ = progress_of(pose);
  const double left = distance(path_.back(), {pose.x, pose.y});
  if (along_.back() - done_ < 2 * options_.look_ahead && left < options_.tolerance)
    has_arrived_ = true;
  if (has_arrived_)
    return {};
  const auto goal = transform(inverse(pose), shifted_point_at(done_ + options_.look_ahead, shift));
  const double aside = std::atan2(goal.y, goal.x);
  is_turning_ = std::abs(aside) > (is_turning_ ? end_to_turn : begin_to_turn);
  if (is_turning_)
    return {0, std::clamp(2 * aside, -options_.max_turn, options_.max_turn)};
  const double away_squared = goal.x * goal.x + goal.y * goal.y;
  const double curvature = away_squared > 0 ? 2 * goal.y / away_squared : 0;
  // Slower in bends, and before the end, so that it stops there.
  double speed = options_.speed / (1 + std::abs(curvature) * 0.5);
  speed = std::min(speed, 0.05 + left);
  if (std::abs(curvature) * speed > options_.max_turn)
    speed = options_.max_turn / std::abs(curvature);
  return {speed, curvature * speed};
}

} // namespace castor::mapping
