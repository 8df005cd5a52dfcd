#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "castor/mapping/geometry/poses.hpp"

namespace castor::vision {

using namespace geometry;

namespace {

double turn_of(const TabletopObject& object) {
  return object.turned_degrees * std::numbers::pi / 180;
}

/// The extent of `corners` along the direction (x, y).
std::pair<double, double> extent_along(const std::vector<Point2>& corners, double x, double y) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& corner : corners) {
    const double along = corner.x * x + corner.y * y;
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return {low, high};
}

/// Whether one of the edges of `a` separates the convex `a` from the convex `b`.
bool an_edge_separates(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point2& from = a[i];
    const Point2& to = a[(i + 1) % a.size()];
    const double normal_x = to.y - from.y;
    const double normal_y = from.x - to.x;
    const auto [low_a, high_a] = extent_along(a, normal_x, normal_y);
    const auto [low_b, high_b] = extent_along(b, normal_x, normal_y);
    if (high_a <= low_b || high_b <= low_a)
      return true;
  }
  return false;
}

} // namespace

std::string_view to_string(TabletopShape shape) {
  switch (shape) {
    case TabletopShape::cube:
      return "cube";
    case TabletopShape::box:
      return "box";
    case TabletopShape::cylinder:
      return "cylinder";
    case TabletopShape::sphere:
      return "sphere";
    case TabletopShape::square:
      return "square";
    case TabletopShape::rectangle:
      return "rectangle";
    case TabletopShape::triangle:
      return "triangle";
    case TabletopShape::disc:
      return "disc";
  }
  return "unknown";
}

bool is_flat(TabletopShape shape) {
  return shape == TabletopShape::square || shape == TabletopShape::rectangle ||
         shape == TabletopShape::triangle || shape == TabletopShape::disc;
}

Pose pose_of(const TabletopObject& object) {
  return {{object.x, object.y, object.size.z / 2}, rotation_about_z(turn_of(object)), table_frame};
}

AlignedBox bounding_box(const TabletopObject& object) {
  double left = object.x - object.size.x / 2;
  double right = object.x + object.size.x / 2;
  double near = object.y - object.size.y / 2;
  double far = object.y + object.size.y / 2;
  const bool round = object.shape == TabletopShape::sphere ||
                     object.shape == TabletopShape::cylinder || object.shape == TabletopShape::disc;
  if (!round) {
    const auto corners = footprint(object);
    std::tie(left, right) = extent_along(corners, 1, 0);
    std::tie(near, far) = extent_along(corners, 0, 1);
  }
  return {{(left + right) / 2, (near + far) / 2, object.size.z / 2},
          {right - left, far - near, object.size.z},
          table_frame};
}

std::vector<Point2> footprint(const TabletopObject& object) {
  std::vector<Point2> corners;
  const double half_x = object.size.x / 2;
  const double half_y = object.size.y / 2;
  switch (object.shape) {
    case TabletopShape::cube:
    case TabletopShape::box:
    case TabletopShape::square:
    case TabletopShape::rectangle:
      corners = {{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}};
      break;
    case TabletopShape::triangle: {
      const double inner_radius = object.size.x * std::numbers::sqrt3 / 6;
      corners = {{-half_x, -inner_radius}, {half_x, -inner_radius}, {0, 2 * inner_radius}};
      break;
    }
    case TabletopShape::cylinder:
    case TabletopShape::sphere:
    case TabletopShape::disc: {
      constexpr int count = 32;
      for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        corners.push_back({half_x * std::cos(angle), half_x * std::sin(angle)});
      }
      break;
    }
  }
  const double cosine = std::cos(turn_of(object));
  const double sine = std::sin(turn_of(object));
  for (auto& corner : corners)
    corner = {object.x + cosine * corner.x - sine * corner.y,
              object.y + sine * corner.x + cosine * corner.y};
  return corners;
}

bool overlap(const TabletopObject& a, const TabletopObject& b) {
  const auto corners_a = footprint(a);
  const auto corners_b = footprint(b);
  return !an_edge_separates(corners_a, corners_b) && !an_edge_separates(corners_b, corners_a);
}

bool TabletopActor::is_there(SceneTime time) const {
  return time >= appears && (!disappears || time < *disappears);
}

TabletopObject TabletopActor::at(SceneTime time) const {
  TabletopObject result = object;
  for (std::size_t i = 0; i < moves.size() && moves[i].start <= time; ++i) {
    const auto& move = moves[i];
    const SceneTime now = i + 1 < moves.size() ? std::min(time, moves[i + 1].start) : time;
    const double done = now - move.start >= move.duration
                          ? 1.0
                          : static_cast<double>((now - move.start).count()) /
                              static_cast<double>(move.duration.count());
    result.x = std::lerp(result.x, move.x, done);
    result.y = std::lerp(result.y, move.y, done);
  }
  return result;
}

TabletopSnapshot TabletopScene::at(SceneTime time) const {
  time = std::max(time, SceneTime{0});
  TabletopSnapshot snapshot = setting;
  for (const auto& actor : actors)
    if (actor.is_there(time))
      snapshot.objects.push_back(actor.at(time));
  return snapshot;
}

std::vector<SceneTime> TabletopScene::change_times() const {
  std::vector<SceneTime> times{SceneTime{0}};
  for (const auto& actor : actors) {
    times.push_back(actor.appears);
    if (actor.disappears)
      times.push_back(*actor.disappears);
    for (const auto& move : actor.moves) {
      times.push_back(move.start);
      times.push_back(move.start + move.duration);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

} // namespace castor::vision
