#include "castor/mapping/building/enclosed_regions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>

namespace castor::mapping {

namespace {

/// Areas below this are those of walls that enclose nothing, square metres.
constexpr double no_area = 1e-6;

/// Points that are one if they are nearer to each other than the tolerance.
class Vertices {
public:
  explicit Vertices(double tolerance) : tolerance_(tolerance) {
    // nop
  }

  std::size_t add(const Point2& p) {
    const auto column = cell(p.x);
    const auto row = cell(p.y);
    for (auto x = column - 1; x <= column + 1; ++x)
      for (auto y = row - 1; y <= row + 1; ++y)
        if (auto found = cells_.find(key(x, y)); found != cells_.end())
          for (auto i : found->second)
            if (distance(points_[i], p) <= tolerance_)
              return i;
    points_.push_back(p);
    cells_[key(column, row)].push_back(points_.size() - 1);
    return points_.size() - 1;
  }

  const std::vector<Point2>& points() const { return points_; }

private:
  std::int64_t cell(double x) const {
    return static_cast<std::int64_t>(std::floor(x / tolerance_));
  }

  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U ^ static_cast<std::uint64_t>(y);
  }

  double tolerance_;
  std::vector<Point2> points_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// Shares of `a` at which `b` crosses or meets it.
void add_meetings(const Segment& a, const Segment& b, double tolerance, std::vector<double>& out) {
  for (const auto& end : {b.from, b.to})
    if (distance(a, end) <= tolerance)
      out.push_back(nearest_share(a, end));
  const Point2 u{a.to.x - a.from.x, a.to.y - a.from.y};
  const Point2 v{b.to.x - b.from.x, b.to.y - b.from.y};
  const double cross = u.x * v.y - u.y * v.x;
  if (std::abs(cross) < 1e-12)
    return;
  const Point2 w{b.from.x - a.from.x, b.from.y - a.from.y};
  const double s = (w.x * v.y - w.y * v.x) / cross;
  const double t = (w.x * u.y - w.y * u.x) / cross;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
    out.push_back(s);
}

/// Walls as a planar graph, whose neighbours are in anticlockwise order around each vertex.
class WallGraph {
public:
  WallGraph(std::span<const Segment> walls, double tolerance) : vertices_(tolerance) {
    for (std::size_t i = 0; i < walls.size(); ++i) {
      std::vector<double> shares{0, 1};
      for (std::size_t j = 0; j < walls.size(); ++j)
        if (i != j)
          add_meetings(walls[i], walls[j], tolerance, shares);
      std::ranges::sort(shares);
      auto last = vertices_.add(point_at(walls[i], shares.front()));
      for (double share : shares) {
        auto next = vertices_.add(point_at(walls[i], share));
        if (next != last)
          edges_.insert(std::minmax(last, next));
        last = next;
      }
    }
    neighbours_.resize(points().size());
    for (auto [a, b] : edges_) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
    for (std::size_t i = 0; i < neighbours_.size(); ++i)
      std::ranges::sort(neighbours_[i], {}, [&](std::size_t x) {
        return std::atan2(points()[x].y - points()[i].y, points()[x].x - points()[i].x);
      });
  }

  const std::vector<Point2>& points() const { return vertices_.points(); }

  std::vector<Point2> free_ends() const {
    std::vector<Point2> result;
    for (std::size_t i = 0; i < neighbours_.size(); ++i)
      if (neighbours_[i].size() == 1)
        result.push_back(points()[i]);
    return result;
  }

  /// The boundaries of all faces, each with the face on its left.
  std::vector<std::vector<std::size_t>> boundaries() const {
    std::vector<std::vector<std::size_t>> result;
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (std::size_t i = 0; i < neighbours_.size(); ++i)
      for (auto j : neighbours_[i]) {
        if (seen.contains({i, j}))
          continue;
        std::vector<std::size_t> boundary;
        auto from = i;
        auto to = j;
        while (seen.insert({from, to}).second) {
          boundary.push_back(from);
          auto next = following(from, to);
          from = to;
          to = next;
        }
        result.push_back(std::move(boundary));
      }
    return result;
  }

  /// A number for each vertex that is equal for those that are connected.
  std::vector<std::size_t> components() const {
    std::vector<std::size_t> parent(points().size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    auto root = [&](std::size_t x) {
      while (parent[x] != x)
        x = parent[x] = parent[parent[x]];
      return x;
    };
    for (auto [a, b] : edges_)
      parent[root(a)] = root(b);
    for (std::size_t i = 0; i < parent.size(); ++i)
      parent[i] = root(i);
    return parent;
  }

private:
  /// Where to go from `to`, coming from `from`, if one turns left as sharply as possible.
  std::size_t following(std::size_t from, std::size_t to) const {
    const auto& around = neighbours_[to];
    auto back = std::ranges::find(around, from);
    return back == around.begin() ? around.back() : *std::prev(back);
  }

  Vertices vertices_;
  std::set<std::pair<std::size_t, std::size_t>> edges_;
  std::vector<std::vector<std::size_t>> neighbours_;
};

} // namespace

EnclosedRegions enclosed_regions(std::span<const Segment> walls, double tolerance) {
  const WallGraph graph(walls, tolerance);
  EnclosedRegions result;
  result.free_ends = graph.free_ends();
  const auto components = graph.components();
  std::vector<std::size_t> component_of_region;
  std::vector<std::pair<std::size_t, Polygon>> outsides;
  for (const auto& boundary : graph.boundaries()) {
    Polygon outline;
    for (auto i : boundary)
      outline.push_back(graph.points()[i]);
    const double area = signed_area(outline);
    if (area > no_area) {
      result.regions.push_back({std::move(outline), {}, area});
      component_of_region.push_back(components[boundary.front()]);
    } else if (area < -no_area) {
      outsides.emplace_back(components[boundary.front()], std::move(outline));
    }
  }
  for (auto& [component, outline] : outsides) {
    std::optional<std::size_t> around;
    for (std::size_t i = 0; i < result.regions.size(); ++i)
      if (component_of_region[i] != component &&
          contains(result.regions[i].outline, outline.front()) &&
          (!around ||
           signed_area(result.regions[i].outline) < signed_area(result.regions[*around].outline)))
        around = i;
    if (around) {
      auto& region = result.regions[*around];
      region.area += signed_area(outline);
      region.holes.push_back(std::move(outline));
    }
  }
  return result;
}

std::optional<std::size_t> region_at(const EnclosedRegions& x, const Point2& p) {
  std::optional<std::size_t> result;
  for (std::size_t i = 0; i < x.regions.size(); ++i)
    if (contains(x.regions[i].outline, p) &&
        (!result || signed_area(x.regions[i].outline) < signed_area(x.regions[*result].outline)))
      result = i;
  return result;
}

} // namespace castor::mapping
