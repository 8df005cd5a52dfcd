#include "castor/mapping/slam/loop_closer.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <stdexcept>

namespace castor::mapping {

namespace {

/// Metres of way that a turn by one radian counts as: scans of a robot that turns differ, too.
constexpr double way_of_turn = 0.3;
/// Way between the ends of a loop.
constexpr double way_of_loop = 0.5;

double way_between(const Pose2& a, const Pose2& b) {
  auto step = between(a, b);
  return std::hypot(step.x, step.y) + way_of_turn * std::abs(step.heading);
}

} // namespace

LoopCloser::LoopCloser(const LoopCloserOptions& options)
  : options_(options), matcher_(options.matcher) {}

void LoopCloser::remember(const Keyframe& keyframe) {
  if (keyframe.number != keyframes())
    throw std::invalid_argument("the next keyframe of the loop closer is " +
                                std::to_string(keyframes()) + ", and not " +
                                std::to_string(keyframe.number));
  auto path = known_.empty()
                ? 0
                : known_.back().path + way_between(known_.back().local_pose, keyframe.local_pose);
  known_.push_back({keyframe.scan, path, keyframe.local_pose, {}, {}});
  compare_with_newest(keyframe);
}

void LoopCloser::compare_with_newest(const Keyframe& keyframe) {
  PlacedScan added{std::make_shared<const LaserScan>(keyframe.scan), keyframe.local_pose,
                   surface_points(keyframe.scan, options_.surface), options_.moved};
  for (auto& x : newest_) {
    added.learn_from(x.view());
    x.learn_from(added.view());
  }
  newest_.push_back(std::move(added));
  if (newest_.size() <= options_.witnesses)
    return;
  known_[known_.size() - newest_.size()].moved = newest_.front().moved();
  newest_.pop_front();
}

SurfacePoints LoopCloser::standing_points(std::int64_t number) const {
  const auto newer = static_cast<std::size_t>(keyframes() - number);
  const auto moved =
    newer <= newest_.size() ? newest_[newest_.size() - newer].moved() : known(number).moved;
  const auto points = surface_points(known(number).scan, options_.surface);
  SurfacePoints result;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!moved[i])
      result.push_back(points[i]);
  return result;
}

void LoopCloser::remember(const Constraint& loop) {
  if (loop.from < 0 || loop.to < 0 || loop.from >= keyframes() || loop.to >= keyframes())
    throw std::out_of_range("a loop between keyframes that the loop closer does not know");
  known_[static_cast<std::size_t>(loop.from)].loops.push_back(loop.to);
  known_[static_cast<std::size_t>(loop.to)].loops.push_back(loop.from);
}

std::vector<Constraint> LoopCloser::add(const Keyframe& keyframe, const std::vector<Pose2>& poses) {
  remember(keyframe);
  auto number = keyframe.number;
  if (poses.size() < known_.size())
    throw std::invalid_argument("poses of all keyframes are needed to close loops");
  auto since = between(known(searched_).local_pose, keyframe.local_pose);
  if (std::hypot(since.x, since.y) < options_.search_distance &&
      std::abs(since.heading) < options_.search_turn)
    return {};
  searched_ = number;
  std::erase_if(waiting_, [&](const Closure& x) {
    return known(number).path - known(x.constraint.to).path > options_.patience;
  });
  std::vector<Constraint> result;
  for (const auto& place : places_near(number, poses))
    if (auto closure = close(place, number, poses))
      for (auto& x : confirmed(*closure, poses))
        result.push_back(x);
  for (const auto& x : result)
    remember(x);
  return result;
}

std::vector<double> LoopCloser::ways_from(std::int64_t number) const {
  std::vector<double> result(known_.size(), std::numeric_limits<double>::infinity());
  using Item = std::pair<double, std::int64_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  auto reach = [&](std::int64_t x, double way) {
    if (x < 0 || x >= keyframes() || way >= result[static_cast<std::size_t>(x)])
      return;
    result[static_cast<std::size_t>(x)] = way;
    open.emplace(way, x);
  };
  reach(number, 0);
  while (!open.empty()) {
    auto [way, x] = open.top();
    open.pop();
    if (way > result[static_cast<std::size_t>(x)])
      continue;
    if (x > 0)
      reach(x - 1, way + known(x).path - known(x - 1).path);
    if (x + 1 < keyframes())
      reach(x + 1, way + known(x + 1).path - known(x).path);
    for (auto other : known(x).loops)
      reach(other, way + way_of_loop);
  }
  return result;
}

std::vector<LoopCloser::Place> LoopCloser::places_near(std::int64_t number,
                                                       const std::vector<Pose2>& poses) const {
  auto ways = ways_from(number);
  std::vector<Place> near;
  for (std::int64_t i = 0; i < number; ++i) {
    if (known(number).path - known(i).path < options_.least_path)
      break;
    auto way = ways[static_cast<std::size_t>(i)];
    auto apart =
      distance(poses[static_cast<std::size_t>(i)], poses[static_cast<std::size_t>(number)]);
    auto window = std::min(options_.drift * way, options_.most_window);
    if (apart <= options_.near + window)
      near.push_back({i, apart, way});
  }
  std::sort(near.begin(), near.end(),
            [](const Place& a, const Place& b) { return a.distance < b.distance; });
  std::vector<Place> result;
  for (const auto& x : near) {
    if (result.size() == options_.most_places)
      break;
    if (std::all_of(result.begin(), result.end(), [&](const Place& y) {
          return std::abs(x.keyframe - y.keyframe) > 2 * options_.neighbours;
        }))
      result.push_back(x);
  }
  return result;
}

SurfacePoints LoopCloser::points_around(std::int64_t place, std::int64_t number,
                                        const std::vector<Pose2>& poses) const {
  SurfacePoints result;
  auto pose_of = [&](std::int64_t x) { return poses[static_cast<std::size_t>(x)]; };
  auto last = std::min(place + options_.neighbours, number - 1);
  for (auto i = std::max<std::int64_t>(place - options_.neighbours, 0); i <= last; ++i) {
    // What the scan itself follows from is no other view of the place.
    if (known(number).path - known(i).path < options_.least_path / 2)
      break;
    auto points = transform(between(pose_of(place), pose_of(i)), standing_points(i));
    result.insert(result.end(), points.begin(), points.end());
  }
  return result;
}

std::optional<LoopCloser::Closure> LoopCloser::close(const Place& place, std::int64_t number,
                                                     const std::vector<Pose2>& poses) const {
  auto points = standing_points(number);
  auto map = points_around(place.keyframe, number, poses);
  auto guess = between(poses[static_cast<std::size_t>(place.keyframe)],
                       poses[static_cast<std::size_t>(number)]);
  SearchWindow window{std::min(options_.window + options_.drift * place.way, options_.most_window),
                      std::min(options_.window_heading + options_.drift_heading * place.way,
                               options_.most_window_heading)};
  auto start = guess;
  if (window.translation > options_.small_window) {
    CorrelativeMatcher coarse{thinned(map, 0.04)};
    auto best = coarse.match(thinned(points, 0.1), guess, window, options_.least_score);
    if (!best)
      return {};
    start = best->pose;
  }
  auto match = matcher_.match(PointMap{map}, thinned(points, options_.spacing), start);
  if (match.matched < options_.least_matched || match.deviation > options_.most_deviation ||
      match.observability < options_.least_observability)
    return {};
  auto correction = between(guess, match.pose);
  auto moved = std::hypot(correction.x, correction.y);
  // The window is left by as much as closest points may move the scan from a pose of the search.
  if (moved > window.translation + 0.3 || std::abs(correction.heading) > window.heading + 0.1)
    return {};
  Closure result;
  result.window = window.translation;
  result.is_large =
    moved > options_.large_correction || std::abs(correction.heading) > options_.large_turn;
  result.is_sure = !result.is_large && window.translation <= options_.sure_window;
  auto& constraint = result.constraint;
  constraint.kind = ConstraintKind::loop;
  constraint.from = place.keyframe;
  constraint.to = number;
  constraint.pose = match.pose;
  auto translation = options_.deviation * options_.deviation;
  auto heading = options_.deviation_heading * options_.deviation_heading;
  constraint.covariance = {translation, 0, 0, translation, 0, heading};
  return result;
}

bool LoopCloser::agree(const Constraint& a, const Constraint& b,
                       const std::vector<Pose2>& poses) const {
  auto step = [&](std::int64_t from, std::int64_t to) {
    return between(poses[static_cast<std::size_t>(from)], poses[static_cast<std::size_t>(to)]);
  };
  // The newer scan as seen from the older place, by either closure.
  auto by_a = compose(a.pose, step(a.to, b.to));
  auto by_b = compose(step(a.from, b.from), b.pose);
  auto off = between(by_a, by_b);
  return std::hypot(off.x, off.y) <= options_.agreement &&
         std::abs(off.heading) <= options_.agreement_heading;
}

std::vector<Constraint> LoopCloser::confirmed(const Closure& closure,
                                              const std::vector<Pose2>& poses) {
  if (closure.is_sure)
    return {closure.constraint};
  // Scans from nearly the same place would be mistaken in the same way.
  auto apart = options_.least_apart;
  if (closure.is_large)
    apart = std::max(apart, options_.confirmation * closure.window);
  auto is_confirmed = std::any_of(waiting_.begin(), waiting_.end(), [&](const Closure& x) {
    return known(closure.constraint.to).path - known(x.constraint.to).path >= apart &&
           agree(x.constraint, closure.constraint, poses);
  });
  if (!is_confirmed) {
    waiting_.push_back(closure);
    return {};
  }
  std::vector<Constraint> result{closure.constraint};
  std::erase_if(waiting_, [&](const Closure& x) {
    if (!agree(x.constraint, closure.constraint, poses))
      return false;
    result.push_back(x.constraint);
    return true;
  });
  return result;
}

} // namespace castor::mapping
