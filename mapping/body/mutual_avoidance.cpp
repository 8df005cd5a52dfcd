#include "castor/mapping/body/mutual_avoidance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// Before this time a contact counts as one now, seconds.
constexpr double at_once = 0.02;

double length(const Point2& x) {
  return std::hypot(x.x, x.y);
}

/// Until the first contact of somebody at that velocity.
double time_at(const Point2& here, const Point2& current, const Point2& velocity,
               std::span<const AvoidedDisc> others, double horizon) {
  double result = horizon;
  for (const auto& x : others) {
    // With half of the change done by the other, it is as if the velocity were the mean.
    const Point2 own =
      x.is_mutual ? Point2{2 * velocity.x - current.x, 2 * velocity.y - current.y} : velocity;
    result = std::min(result, time_to_contact({x.place.x - here.x, x.place.y - here.y},
                                              {x.velocity.x - own.x, x.velocity.y - own.y}, x.reach,
                                              horizon));
  }
  return result;
}

} // namespace

double time_to_contact(const Point2& place, const Point2& velocity, double reach, double horizon) {
  const double away = place.x * place.x + place.y * place.y - reach * reach;
  const double approach = -(place.x * velocity.x + place.y * velocity.y);
  if (!(approach > 0))
    return horizon;
  if (away <= 0)
    return 0;
  const double squared = velocity.x * velocity.x + velocity.y * velocity.y;
  const double root = approach * approach - squared * away;
  if (root < 0)
    return horizon;
  return std::min(horizon, away / (approach + std::sqrt(root)));
}

Point2 velocity_among(const Point2& here, const Point2& current, const Point2& wanted,
                      std::span<const AvoidedDisc> others,
                      const std::function<bool(const Point2&)>& is_free,
                      const AvoidanceOptions& options) {
  const auto penalty_of_contact = [&](const Point2& x) {
    const double time = time_at(here, current, x, others, options.horizon);
    return time < options.horizon
             ? options.caution * (1 / std::max(at_once, time) - 1 / options.horizon)
             : 0;
  };
  if (penalty_of_contact(wanted) == 0 && is_free(wanted))
    return wanted;
  constexpr int turns = 8;
  constexpr double turn = std::numbers::pi / 16;
  const double speed = length(wanted);
  const double heading = std::atan2(wanted.y, wanted.x);
  std::vector<std::pair<double, Point2>> candidates{
    {penalty_of_contact({}) + speed + options.steadiness * length(current), {}}};
  for (const double share : {1.0, 0.65, 0.3})
    for (int i = -turns; i <= turns; ++i) {
      const double direction = heading + i * turn;
      const Point2 x{share * speed * std::cos(direction), share * speed * std::sin(direction)};
      const double penalty = penalty_of_contact(x) + distance(x, wanted) +
                             options.steadiness * distance(x, current) + (i > 0 ? options.left : 0);
      candidates.push_back({penalty, x});
    }
  std::ranges::stable_sort(candidates, {}, [](const auto& x) { return x.first; });
  for (const auto& [penalty, velocity] : candidates)
    if ((velocity.x == 0 && velocity.y == 0) || is_free(velocity))
      return velocity;
  return {};
}

} // namespace castor::mapping
