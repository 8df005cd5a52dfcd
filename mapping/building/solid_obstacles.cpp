#include "castor/mapping/building/solid_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::mapping {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t most_cells = 1'000'000;

} // namespace

SolidObstacles::SolidObstacles(std::span<const Solid> solids, double cell) : cell_(cell) {
  for (const auto& x : solids) {
    Outline outline;
    outline.centre = {x.pose.x, x.pose.y};
    if (x.shape == SolidShape::disc) {
      outline.radius = x.length / 2;
    } else {
      outline.cosine = std::cos(x.pose.heading);
      outline.sine = std::sin(x.pose.heading);
      outline.half_length = x.length / 2;
      outline.half_width = x.width / 2;
    }
    outlines_.push_back(outline);
  }
  find_extent();
  fill_cells();
}

void SolidObstacles::find_extent() {
  low_ = {infinity, infinity};
  high_ = {-infinity, -infinity};
  for (const auto& x : outlines_) {
    const double reach = std::max(std::hypot(x.half_length, x.half_width), x.radius);
    low_ = {std::min(low_.x, x.centre.x - reach), std::min(low_.y, x.centre.y - reach)};
    high_ = {std::max(high_.x, x.centre.x + reach), std::max(high_.y, x.centre.y + reach)};
  }
  if (outlines_.empty())
    return;
  auto count = [&](double from, double to) {
    return static_cast<std::int64_t>(std::floor((to - from) / cell_)) + 1;
  };
  while (count(low_.x, high_.x) > most_cells / count(low_.y, high_.y))
    cell_ *= 2;
  columns_ = count(low_.x, high_.x);
  rows_ = count(low_.y, high_.y);
  high_ = {low_.x + static_cast<double>(columns_) * cell_,
           low_.y + static_cast<double>(rows_) * cell_};
}

std::int64_t SolidObstacles::column(double x) const {
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((x - low_.x) / cell_)), 0,
                                  columns_ - 1);
}

std::int64_t SolidObstacles::row(double y) const {
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((y - low_.y) / cell_)), 0,
                                  rows_ - 1);
}

void SolidObstacles::fill_cells() {
  std::vector<std::vector<std::uint32_t>> cells(static_cast<std::size_t>(columns_ * rows_));
  // Outlines that are just beside a cell count as touching it, so that a ray along the border of
  // two cells misses nothing.
  const double reach = cell_ * std::sqrt(0.5) + 1e-6;
  for (std::uint32_t i = 0; i < outlines_.size(); ++i) {
    const auto& x = outlines_[i];
    const double size = std::max(std::hypot(x.half_length, x.half_width), x.radius) + 1e-6;
    for (auto r = row(x.centre.y - size); r <= row(x.centre.y + size); ++r)
      for (auto c = column(x.centre.x - size); c <= column(x.centre.x + size); ++c) {
        const Point2 middle{low_.x + (static_cast<double>(c) + 0.5) * cell_,
                            low_.y + (static_cast<double>(r) + 0.5) * cell_};
        if (away(x, middle) <= reach)
          cells[static_cast<std::size_t>(r * columns_ + c)].push_back(i);
      }
  }
  first_.reserve(cells.size() + 1);
  first_.push_back(0);
  for (const auto& cell : cells) {
    members_.insert(members_.end(), cell.begin(), cell.end());
    first_.push_back(static_cast<std::uint32_t>(members_.size()));
  }
}

double SolidObstacles::hit(const Outline& x, const Ray& ray) {
  const double dx = x.centre.x - ray.origin.x;
  const double dy = x.centre.y - ray.origin.y;
  if (x.radius > 0) {
    const double outside = dx * dx + dy * dy - x.radius * x.radius;
    if (outside <= 0)
      return 0;
    const double along = dx * ray.direction.x + dy * ray.direction.y;
    const double square = along * along - outside;
    return along < 0 || square < 0 ? infinity : along - std::sqrt(square);
  }
  // The ray in the frame of the box, between its two pairs of sides.
  const double ox = -(dx * x.cosine + dy * x.sine);
  const double oy = -(dy * x.cosine - dx * x.sine);
  const double ux = ray.direction.x * x.cosine + ray.direction.y * x.sine;
  const double uy = ray.direction.y * x.cosine - ray.direction.x * x.sine;
  double enter = 0;
  double leave = infinity;
  auto clip = [&](double o, double u, double half) {
    if (u == 0) {
      if (std::abs(o) > half)
        leave = -infinity;
      return;
    }
    const double a = (-half - o) / u;
    const double b = (half - o) / u;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  };
  clip(ox, ux, x.half_length);
  clip(oy, uy, x.half_width);
  return enter <= leave ? enter : infinity;
}

double SolidObstacles::away(const Outline& x, const Point2& p) {
  const double dx = p.x - x.centre.x;
  const double dy = p.y - x.centre.y;
  if (x.radius > 0)
    return std::max(0.0, std::hypot(dx, dy) - x.radius);
  const double along = std::abs(dx * x.cosine + dy * x.sine) - x.half_length;
  const double aside = std::abs(dy * x.cosine - dx * x.sine) - x.half_width;
  return std::hypot(std::max(0.0, along), std::max(0.0, aside));
}

std::optional<double> SolidObstacles::cast(const Point2& origin, double direction,
                                           double max_range) const {
  if (outlines_.empty())
    return std::nullopt;
  const Ray ray{origin, {std::cos(direction), std::sin(direction)}};
  // The part of the ray that is above the index.
  double enter = 0;
  double leave = max_range;
  auto clip = [&](double o, double u, double low, double high) {
    if (u == 0) {
      if (o < low || o > high)
        leave = -infinity;
      return;
    }
    const double a = (low - o) / u;
    const double b = (high - o) / u;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  };
  clip(origin.x, ray.direction.x, low_.x, high_.x);
  clip(origin.y, ray.direction.y, low_.y, high_.y);
  if (!(enter <= leave))
    return std::nullopt;
  auto c = column(origin.x + enter * ray.direction.x);
  auto r = row(origin.y + enter * ray.direction.y);
  // From cell to cell: where the ray crosses the next border in x and in y.
  auto border = [&](double o, double u, double low, std::int64_t i) {
    return u == 0 ? infinity : (low + static_cast<double>(u > 0 ? i + 1 : i) * cell_ - o) / u;
  };
  double next_x = border(origin.x, ray.direction.x, low_.x, c);
  double next_y = border(origin.y, ray.direction.y, low_.y, r);
  const double step_x = ray.direction.x == 0 ? infinity : cell_ / std::abs(ray.direction.x);
  const double step_y = ray.direction.y == 0 ? infinity : cell_ / std::abs(ray.direction.y);
  double nearest = infinity;
  for (;;) {
    const auto i = static_cast<std::size_t>(r * columns_ + c);
    for (auto k = first_[i]; k < first_[i + 1]; ++k)
      nearest = std::min(nearest, hit(outlines_[members_[k]], ray));
    const double end = std::min(next_x, next_y);
    if (nearest <= end || end > leave)
      break;
    if (next_x < next_y) {
      c += ray.direction.x > 0 ? 1 : -1;
      next_x += step_x;
    } else {
      r += ray.direction.y > 0 ? 1 : -1;
      next_y += step_y;
    }
    if (c < 0 || c >= columns_ || r < 0 || r >= rows_)
      break;
  }
  if (nearest > max_range)
    return std::nullopt;
  return nearest;
}

double SolidObstacles::clearance(const Point2& p, double limit) const {
  double result = limit;
  if (outlines_.empty() || p.x < low_.x - limit || p.x > high_.x + limit || p.y < low_.y - limit ||
      p.y > high_.y + limit)
    return result;
  for (auto r = row(p.y - limit); r <= row(p.y + limit); ++r)
    for (auto c = column(p.x - limit); c <= column(p.x + limit); ++c) {
      const auto i = static_cast<std::size_t>(r * columns_ + c);
      for (auto k = first_[i]; k < first_[i + 1]; ++k)
        result = std::min(result, away(outlines_[members_[k]], p));
    }
  return result;
}

} // namespace castor::mapping
