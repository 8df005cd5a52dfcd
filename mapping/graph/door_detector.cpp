#include "castor/mapping/graph/door_detector.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace castor::mapping {

namespace {

/// A beam that ends before an opening by less than this passes it, metres.
constexpr double range_tolerance = 0.05;
/// Beams on each side of a pair of posts among which no nearer pair may be.
constexpr int neighbourhood = 4;
/// How much of the wall beside a post is looked at, metres.
constexpr double seen_wall = 0.35;
/// A beam that goes on by more than this behind a post has passed it, metres.
constexpr double jump = 0.15;

class OpeningSearch {
public:
  OpeningSearch(const LaserScan& scan, const std::vector<bool>& ignored, const DoorOptions& options)
    : scan_(scan), options_(options), count_(static_cast<int>(scan.ranges.size())) {
    beams_.reserve(scan.ranges.size());
    for (int i = 0; i < count_; ++i) {
      const auto range = double{scan.ranges[static_cast<std::size_t>(i)]};
      const bool is_left_out = !ignored.empty() && ignored[static_cast<std::size_t>(i)];
      Beam x;
      x.direction = {std::cos(angle(i)), std::sin(angle(i))};
      x.hits = range > 0 && range < scan.max_range && !is_left_out;
      x.way = range > 0 && !is_left_out ? range : scan.max_range;
      x.point = {x.way * x.direction.x, x.way * x.direction.y};
      beams_.push_back(x);
    }
  }

  std::vector<Opening> run() const {
    std::vector<Opening> result;
    for (int i = 0; i < count_; ++i) {
      if (!may_be_post(i))
        continue;
      for (int j = i + 2; j < count_; ++j) {
        // No point behind is nearer.
        if (std::sin(angle(j) - angle(i)) * beam(i).way > options_.most_width &&
            angle(j) - angle(i) < std::numbers::pi / 2)
          break;
        if (may_be_post(j) && is_opening(i, j))
          add(result, on_robot(i, j));
      }
    }
    return result;
  }

private:
  /// Of the pairs of posts at one door, the narrowest counts.
  static void add(std::vector<Opening>& openings, const Opening& x) {
    constexpr double one_door = 0.4; // m
    const auto same = std::ranges::find_if(
      openings, [&](const Opening& other) { return distance(other.pose(), x.pose()) < one_door; });
    if (same == openings.end())
      openings.push_back(x);
    else if (x.width() < same->width())
      *same = x;
  }

  struct Beam {
    /// Where it ended; where it passed, the end of its range.
    Point2 point;
    Point2 direction;
    double way = 0;
    bool hits = false;
  };

  double angle(int i) const { return scan_.first_angle + i * scan_.angle_step; }
  const Beam& beam(int i) const { return beams_[static_cast<std::size_t>(i)]; }
  bool may_be_post(int i) const { return beam(i).hits && beam(i).way <= options_.reach; }

  bool is_opening(int i, int j) const {
    const auto width = distance(beam(i).point, beam(j).point);
    // Beams end on the walls, up to some beams beside the posts.
    const auto half_beam = scan_.angle_step * std::max(beam(i).way, beam(j).way) / 2;
    if (width < options_.least_width - half_beam || width > options_.most_width + 4 * half_beam)
      return false;
    return is_seen_frontally(i, j) && is_nearest_pair(i, j, width) && is_passed(i, j) &&
           has_wall(i, -1, j) && has_wall(j, 1, i) && has_allowed_width(i, j);
  }

  bool has_allowed_width(int i, int j) const {
    const auto width = distance(end_of_wall(i, 1, j), end_of_wall(j, -1, i));
    return width >= options_.least_width && width <= options_.most_width;
  }

  bool is_seen_frontally(int i, int j) const {
    const auto& a = beam(i).point;
    const auto& b = beam(j).point;
    const Point2 middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    const auto far = std::hypot(middle.x, middle.y);
    if (!(far > 0))
      return false;
    const auto along = ((b.x - a.x) * middle.x + (b.y - a.y) * middle.y) / distance(a, b) / far;
    return std::abs(along) <= std::sin(options_.most_slant);
  }

  bool is_nearest_pair(int i, int j, double width) const {
    for (int p = std::max(0, i - neighbourhood); p <= std::min(i + neighbourhood, j - 1); ++p) {
      if (!beam(p).hits)
        continue;
      for (int q = std::max(p + 1, j - neighbourhood); q <= std::min(count_ - 1, j + neighbourhood);
           ++q) {
        if (!beam(q).hits || !is_across(p, q, i, j))
          continue;
        const auto narrower = width - distance(beam(p).point, beam(q).point);
        if (narrower > (is_on_jamb(p, i, j) || is_on_jamb(q, i, j) ? jamb_error(i, j) : 0))
          return false;
      }
    }
    return true;
  }

  /// Whether p is a point near post i, and q one near post j.
  bool is_across(int p, int q, int i, int j) const {
    constexpr double near = 0.3; // m
    return distance(beam(p).point, beam(i).point) < near &&
           distance(beam(q).point, beam(j).point) < near;
  }

  /// Whether a point is behind the line through two posts, as those on the sides of a door that
  /// one sees straight ahead.
  bool is_on_jamb(int p, int i, int j) const {
    constexpr double behind = 0.03; // m
    const auto& a = beam(i).point;
    const auto& b = beam(j).point;
    // The robot is to the left of the way from the right post to the left one.
    const auto left = (b.x - a.x) * (beam(p).point.y - a.y) - (b.y - a.y) * (beam(p).point.x - a.x);
    return left < -behind * distance(a, b);
  }

  /// How much narrower a door may be between its jambs: the last beams on the wall's face are up to
  /// a beam before its ends. What narrows more is round. Metres.
  double jamb_error(int i, int j) const {
    constexpr double noise = 0.02; // m
    return noise + std::abs(scan_.angle_step) * (beam(i).way + beam(j).way);
  }

  /// Whether all beams between two posts pass the line between them, and one of them by far.
  bool is_passed(int i, int j) const {
    const auto& a = beam(i).point;
    const auto& b = beam(j).point;
    double farthest = 0;
    for (int k = i + 1; k < j; ++k) {
      const auto& d = beam(k).direction;
      const auto across = d.x * (b.y - a.y) - d.y * (b.x - a.x);
      if (!(std::abs(across) > 1e-9))
        return false;
      const auto way = (a.x * (b.y - a.y) - a.y * (b.x - a.x)) / across;
      if (way <= 0 || beam(k).way < way - range_tolerance)
        return false;
      farthest = std::max(farthest, beam(k).way - way);
    }
    return farthest >= options_.clearance;
  }

  /// Whether a wall that is in line with both posts begins at `post` and goes away from `other`.
  bool has_wall(int post, int step, int other) const {
    const auto& a = beam(post).point;
    const auto& b = beam(other).point;
    const auto width = distance(a, b);
    const Point2 outwards{(a.x - b.x) / width, (a.y - b.y) / width};
    double longest = 0;
    for (int k = post + step; k >= 0 && k < count_ && beam(k).hits; k += step) {
      const auto& p = beam(k).point;
      const auto allowed = options_.gap + 3 * beam(k).way * std::abs(scan_.angle_step);
      if (distance(p, beam(k - step).point) > allowed)
        break;
      const auto along = (p.x - a.x) * outwards.x + (p.y - a.y) * outwards.y;
      const auto aside = std::abs((p.x - a.x) * outwards.y - (p.y - a.y) * outwards.x);
      if (aside > options_.offset)
        break;
      longest = std::max(longest, along);
      if (along > seen_wall)
        break;
    }
    return longest >= options_.post;
  }

  /// The post, moved on to half way between the beam that hit it and the next, if that has passed.
  /// @param step towards the other post
  Point2 end_of_wall(int post, int step, int other) const {
    const auto& a = beam(post).point;
    const auto& b = beam(other).point;
    const auto& next = beam(post + step);
    if (next.hits && next.way < beam(post).way + jump)
      return a;
    const auto between = angle(post) + step * scan_.angle_step / 2;
    const Point2 d{std::cos(between), std::sin(between)};
    const auto across = d.x * (b.y - a.y) - d.y * (b.x - a.x);
    if (!(std::abs(across) > 1e-9))
      return a;
    const auto way = (a.x * (b.y - a.y) - a.y * (b.x - a.x)) / across;
    return {way * d.x, way * d.y};
  }

  Opening on_robot(int i, int j) const {
    return {transform(scan_.mount, end_of_wall(i, 1, j)),
            transform(scan_.mount, end_of_wall(j, -1, i))};
  }

  const LaserScan& scan_;
  const DoorOptions& options_;
  int count_;
  std::vector<Beam> beams_;
};

} // namespace

Pose2 Opening::pose() const {
  // The left post is to the left of who goes through.
  return {(right.x + left.x) / 2, (right.y + left.y) / 2,
          normalised(std::atan2(left.y - right.y, left.x - right.x) - std::numbers::pi / 2)};
}

std::vector<Opening> find_openings(const LaserScan& scan, const std::vector<bool>& ignored,
                                   const DoorOptions& options) {
  return OpeningSearch{scan, ignored, options}.run();
}

} // namespace castor::mapping
