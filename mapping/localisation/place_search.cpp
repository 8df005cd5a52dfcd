#include "castor/mapping/localisation/place_search.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <tuple>

namespace castor::mapping {

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

/// An end of a beam, turned as the robot is.
struct TurnedPoint {
  Point2 arm;
  /// It fits if it is so near to an occupied cell, m.
  float near = 0;
};

std::vector<TurnedPoint> turned(const std::vector<Point2>& points, double heading, double near,
                                double near_by_range) {
  std::vector<TurnedPoint> result;
  result.reserve(points.size());
  for (const auto& x : points)
    result.push_back({transform({0, 0, heading}, x),
                      static_cast<float>(near + near_by_range * std::hypot(x.x, x.y))});
  return result;
}

/// How many fit, or fewer than `least` as soon as it cannot be so many.
std::size_t fitting(const DistanceField& map, const std::vector<TurnedPoint>& points,
                    const Point2& robot, std::size_t least) {
  std::size_t result = 0;
  auto left = points.size();
  for (const auto& x : points) {
    result += map.to_surface(robot.x + x.arm.x, robot.y + x.arm.y) <= x.near ? 1 : 0;
    if (result + --left < least)
      return result;
  }
  return result;
}

/// Ends of all scans' beams on the robot, in an order in which each part of them is from all
/// directions.
std::vector<Point2> points_of(const std::vector<PlacedScan>& trail, std::size_t wanted) {
  auto each = std::max<std::size_t>(10, wanted / trail.size());
  std::vector<Point2> all;
  for (const auto& x : trail)
    for (const auto& point : ends_of_beams(x.scan, each))
      all.push_back(transform(x.pose, point));
  std::vector<Point2> result;
  constexpr std::size_t stride = 7;
  for (std::size_t first = 0; first < stride; ++first)
    for (auto i = first; i < all.size(); i += stride)
      result.push_back(all[i]);
  return result;
}

} // namespace

PlaceSearch::PlaceSearch(std::shared_ptr<const DistanceField> map, const MapFitOptions& fit,
                         const PlaceSearchOptions& options)
  : options_(options), map_(std::move(map)), fit_(map_, fit),
    positions_(map_->free_places(options.step, options.clearance)) {}

double PlaceSearch::explained(const std::vector<PlacedScan>& trail, const Pose2& robot) const {
  double sum = 0;
  for (const auto& x : trail)
    sum += fit_.explained(x.scan, compose(robot, x.pose));
  return sum / static_cast<double>(trail.size());
}

int PlaceSearch::headings() const {
  return std::max(1, static_cast<int>(std::lround(whole_turn / options_.step_heading)));
}

std::vector<PlaceSearch::Candidate>
PlaceSearch::candidates(const std::vector<Point2>& points) const {
  auto step_heading = whole_turn / headings();
  auto least = static_cast<std::size_t>(
    std::ceil(options_.least_explained * static_cast<double>(points.size())));
  // What half a step moves an end by.
  auto near = options_.near + options_.step * std::numbers::sqrt2 / 2;
  auto half_near = options_.near + options_.step * std::numbers::sqrt2 / 4;
  std::vector<Candidate> result;
  for (int i = 0; i < headings(); ++i) {
    auto heading = i * step_heading;
    auto coarse = turned(points, heading, near, step_heading / 2);
    auto left = turned(points, heading - step_heading / 4, half_near, step_heading / 4);
    auto right = turned(points, heading + step_heading / 4, half_near, step_heading / 4);
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      const auto& position = positions_[k];
      if (fitting(*map_, coarse, position, least) < least)
        continue;
      std::size_t most = least;
      Pose2 best;
      bool fits = false;
      for (double dx : {-options_.step / 4, options_.step / 4})
        for (double dy : {-options_.step / 4, options_.step / 4})
          for (const auto* half : {&left, &right}) {
            Point2 there{position.x + dx, position.y + dy};
            auto count = fitting(*map_, *half, there, most);
            if (count < most)
              continue;
            most = count;
            fits = true;
            best = {there.x, there.y,
                    normalised(heading + (half == &left ? -step_heading : step_heading) / 4)};
          }
      if (fits)
        result.push_back({best, most, k, i});
    }
    if (result.size() > options_.most_candidates)
      break;
  }
  return result;
}

std::vector<PlaceSearch::Candidate>
PlaceSearch::best_of_neighbours(const std::vector<Candidate>& all) const {
  // By their places on the grid.
  auto key = [this](double x, double y, int heading) {
    auto count = headings();
    return std::tuple{std::lround(x / options_.step), std::lround(y / options_.step),
                      (heading + count) % count};
  };
  std::map<std::tuple<long, long, int>, std::size_t> index;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& at = positions_[all[i].position];
    index[key(at.x, at.y, all[i].heading)] = i;
  }
  auto is_better = [&](std::size_t a, std::size_t b) {
    return all[a].fitting != all[b].fitting ? all[a].fitting > all[b].fitting : a < b;
  };
  auto is_best = [&](std::size_t i) {
    const auto& at = positions_[all[i].position];
    for (int dx : {-1, 0, 1})
      for (int dy : {-1, 0, 1})
        for (int turn : {-1, 0, 1}) {
          auto other = index.find(
            key(at.x + dx * options_.step, at.y + dy * options_.step, all[i].heading + turn));
          if (other != index.end() && is_better(other->second, i))
            return false;
        }
    return true;
  };
  std::vector<Candidate> result;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_best(i))
      result.push_back(all[i]);
  return result;
}

FoundPlaces PlaceSearch::find(const std::vector<PlacedScan>& trail) const {
  auto points = points_of(trail, options_.points);
  if (points.empty())
    return {{}, true};
  auto candidates = this->candidates(points);
  if (candidates.size() > options_.most_candidates)
    return {{}, true};
  MapAlignmentOptions alignment;
  alignment.prior = options_.step;
  alignment.prior_heading = options_.step_heading;
  std::vector<Place> places;
  for (const auto& x : best_of_neighbours(candidates)) {
    Place place;
    place.pose = aligned(*map_, points, x.pose, alignment);
    place.explained = explained(trail, place.pose);
    if (place.explained >= options_.least_explained)
      places.push_back(place);
  }
  places = distinct_places(std::move(places), options_.apart, options_.apart_heading);
  if (!places.empty()) {
    auto least = places.front().explained - options_.margin;
    std::erase_if(places, [&](const Place& x) { return x.explained < least; });
  }
  if (places.size() > options_.most_places)
    return {{}, true};
  return {std::move(places), false};
}

std::vector<Place> distinct_places(std::vector<Place> places, double apart, double apart_heading) {
  std::ranges::stable_sort(places, std::greater{}, &Place::explained);
  std::vector<Place> result;
  for (const auto& x : places) {
    auto is_one = [&](const Place& y) {
      return distance(x.pose, y.pose) < apart &&
             std::abs(normalised(x.pose.heading - y.pose.heading)) < apart_heading;
    };
    if (std::ranges::none_of(result, is_one))
      result.push_back(x);
  }
  return result;
}

} // namespace castor::mapping
