#include "castor/perception/spatial/potential_fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

namespace castor::spatial {

namespace {

/// What is lost in arithmetic: 0.29 m / 0.01 m is not quite 29, and what is right of something by
/// less than this share of an angle is not right of it.
constexpr double rounding = 1e-9;

/// From the landmark; the viewer is at its front.
GroundPoint axis_of(SpatialRelation relation, const GroundPoint& landmark,
                    const GroundPoint& viewer) {
  const double x = viewer.x - landmark.x;
  const double y = viewer.y - landmark.y;
  switch (relation) {
    case SpatialRelation::front:
      return {x, y};
    case SpatialRelation::back:
      return {-x, -y};
    case SpatialRelation::left:
      return {y, -x};
    case SpatialRelation::right:
      return {-y, x};
    case SpatialRelation::near:
      break;
  }
  return {};
}

/// 1 along the axis, 0 at a right angle to it.
double fit_along(const GroundPoint& axis, const GroundPoint& way) {
  if (way.x == 0 && way.y == 0)
    return 1;
  const double along = way.x * axis.x + way.y * axis.y;
  if (along <= 0)
    return 0;
  const double across = std::abs(way.x * axis.y - way.y * axis.x);
  return 1 - std::atan2(across, along) / (std::numbers::pi / 2);
}

} // namespace

double distance(const GroundPoint& a, const GroundPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

double angle_fit(SpatialRelation direction, const GroundPoint& point, const GroundPoint& landmark,
                 const GroundPoint& viewer) {
  if (point == landmark)
    return 0;
  return fit_along(axis_of(direction, landmark, viewer),
                   {point.x - landmark.x, point.y - landmark.y});
}

PotentialFields::PotentialFields(std::span<const GroundPoint> objects, GroundPoint viewer,
                                 FieldOptions options)
  : options_(options), viewer_(viewer) {
  const double side = std::floor(options_.map_size / options_.cell_size + rounding);
  if (!(side >= 1 && side <= 1e5))
    throw std::invalid_argument("a map of potential fields has between 1 and 100000 cells along "
                                "its side: map_size / cell_size is not in between");
  side_ = static_cast<int>(side);
  objects_.reserve(objects.size());
  for (const auto& object : objects)
    objects_.push_back(place(object));
}

PotentialFields::Object PotentialFields::place(const GroundPoint& point) const {
  const auto column = [this](double along, double centre) {
    const double cell =
      std::floor((along - centre + options_.map_size / 2) / options_.cell_size + rounding);
    // Far outside is as good as just outside; NaN is outside.
    return cell >= -1 ? static_cast<int>(std::min<double>(cell, side_)) : -1;
  };
  Object object;
  object.cell = {column(point.x, options_.centre.x), column(point.y, options_.centre.y)};
  const auto [x, y] = object.cell;
  object.on_map = x >= 0 && y >= 0 && x < side_ && y < side_;
  object.farthest = std::hypot(std::max(x, side_ - 1 - x), std::max(y, side_ - 1 - y));
  return object;
}

GroundPoint PotentialFields::middle_of(const Cell& cell) const {
  const double corner = options_.map_size / 2;
  return {options_.centre.x - corner + cell.x * options_.cell_size,
          options_.centre.y - corner + cell.y * options_.cell_size};
}

PotentialFields::Field PotentialFields::field(SpatialRelation relation, std::size_t landmark,
                                              std::optional<std::size_t> target) const {
  Field result{relation, &objects_.at(landmark), {}, {}};
  result.axis = axis_of(relation, middle_of(result.landmark->cell), viewer_);
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (i != landmark && i != target && objects_[i].on_map)
      result.others.push_back(&objects_[i]);
  }
  return result;
}

double PotentialFields::linear(const Object& origin, const Cell& cell) const {
  if (origin.farthest <= 0)
    return 1;
  return 1 - std::hypot(cell.x - origin.cell.x, cell.y - origin.cell.y) / origin.farthest;
}

bool PotentialFields::within_radius(const Cell& a, const Cell& b) const {
  return std::hypot(a.x - b.x, a.y - b.y) * options_.cell_size <=
         options_.distractor_radius + rounding;
}

double PotentialFields::angular(const Field& field, const Cell& cell) const {
  return fit_along(field.axis, {static_cast<double>(cell.x - field.landmark->cell.x),
                                static_cast<double>(cell.y - field.landmark->cell.y)});
}

double PotentialFields::raw_value(const Field& field, const Cell& cell) const {
  const double nearness = linear(*field.landmark, cell);
  if (field.relation == SpatialRelation::near) {
    for (const auto* other : field.others) {
      if (nearness - linear(*other, cell) < options_.proximity_gate)
        return 0;
    }
    return nearness * nearness;
  }
  for (const auto* other : field.others) {
    if (within_radius(cell, other->cell))
      return 0;
  }
  return angular(field, cell) * nearness;
}

double PotentialFields::maximum(const Field& field) const {
  const auto [x, y] = field.landmark->cell;
  double best = raw_value(field, field.landmark->cell);
  // In growing squares: what is farther off is worth less, however well its direction fits.
  for (int ring = 1; ring < side_; ++ring) {
    const double nearest = linear(*field.landmark, {x + ring, y});
    const double bound = field.relation == SpatialRelation::near ? nearest * nearest : nearest;
    if (best >= bound)
      break;
    for (int row = std::max(y - ring, 0); row <= std::min(y + ring, side_ - 1); ++row) {
      const bool edge = std::abs(row - y) == ring;
      for (int column = x - ring; column <= x + ring; column += edge ? 1 : 2 * ring) {
        if (column >= 0 && column < side_)
          best = std::max(best, raw_value(field, {column, row}));
      }
    }
  }
  return best;
}

double PotentialFields::value(SpatialRelation relation, std::size_t target,
                              std::size_t landmark) const {
  const Object& object = objects_.at(target);
  if (target == landmark || !object.on_map || !objects_.at(landmark).on_map)
    return 0;
  const Field around = field(relation, landmark, target);
  const double raw = raw_value(around, object.cell);
  return raw > rounding ? raw / maximum(around) : 0;
}

std::vector<TargetPosition> PotentialFields::positions(SpatialRelation relation,
                                                       std::size_t landmark,
                                                       std::size_t count) const {
  std::vector<TargetPosition> result;
  if (!objects_.at(landmark).on_map)
    return result;
  const Field around = field(relation, landmark, std::nullopt);
  struct Candidate {
    Cell cell;
    double value = 0;
  };
  std::vector<Candidate> candidates;
  for (int x = 0; x < side_; ++x) {
    for (int y = 0; y < side_; ++y) {
      if (within_radius({x, y}, around.landmark->cell))
        continue;
      const double raw = raw_value(around, {x, y});
      if (raw > rounding)
        candidates.push_back({{x, y}, raw});
    }
  }
  double highest = 0;
  // The order of the cells decides between equals.
  while (result.size() < count && !candidates.empty()) {
    const auto best =
      *std::max_element(candidates.begin(), candidates.end(),
                        [](const Candidate& a, const Candidate& b) { return a.value < b.value; });
    highest = std::max(highest, best.value);
    result.push_back({middle_of(best.cell), best.value / highest});
    std::erase_if(candidates, [&](const Candidate& x) { return within_radius(x.cell, best.cell); });
  }
  return result;
}

std::optional<TargetPosition> PotentialFields::position(SpatialRelation relation,
                                                        std::size_t landmark) const {
  const auto best = positions(relation, landmark, 1);
  return best.empty() ? std::nullopt : std::optional{best.front()};
}

} // namespace castor::spatial
