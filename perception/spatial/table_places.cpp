#include "castor/perception/spatial/table_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace castor::spatial {

namespace {

/// Elsewhere is at least so far from where it was, metres.
constexpr double elsewhere_distance = 0.12;
/// Away from a landmark is at least so far from it, metres, of centres.
constexpr double away_distance = 0.20;
/// Of what is seen, metres.
constexpr double height_inaccuracy = 0.015;
/// Worse than all places that are more likely to be possible.
constexpr double less_likely = 4;
/// So many places beside likely ones come before unlikely ones.
constexpr std::size_t most_beside = 4;
/// So much worse places at hand, or as near to a corner as can be, are that take a stop on the way.
constexpr double stop_worth_it = 0.1;
/// And places in a direction from another thing: they are clearly in it, or it takes no stop.
constexpr double stop_worth_for_direction = 0.35;

/// From one to the other, both included, no further apart than the step; none if there is no room.
std::vector<double> positions_between(double from, double to, double step) {
  constexpr double slack = 1e-9;
  if (to < from - slack)
    return {};
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / step - slack)));
  std::vector<double> result;
  for (int i = 0; i <= steps; ++i)
    result.push_back(from + (to - from) * i / steps);
  return result;
}

/// At hand, in a corner, or in a quarter of the table, where what is nearer to the corner is
/// better. What is held is rather given where it can be put at once.
bool are_worth_stop(std::span<const PlaceWanted> places, bool is_held) {
  return std::ranges::any_of(places, [&](const PlaceWanted& x) {
    const std::string_view part = x.relation;
    return x.landmarks.empty() && ((part == "at-hand" && !is_held) || part.ends_with("corner") ||
                                   ((part.starts_with("front-") || part.starts_with("back-")) &&
                                    (part.ends_with("-left") || part.ends_with("-right"))));
  });
}

std::optional<SpatialRelation> direction(const std::string& word) {
  for (const auto& [name, relation] : reflection_of<SpatialRelation>().enumerators)
    if (name == word && relation != SpatialRelation::near)
      return relation;
  return std::nullopt;
}

/// To one side of another thing.
bool is_one_direction(std::span<const PlaceWanted> places) {
  return places.size() == 1 && places.front().landmarks.size() == 1 &&
         direction(places.front().relation);
}

} // namespace

TablePlaces::TablePlaces(std::span<const TableObject> objects, GroundPoint viewer,
                         PlacingOptions options)
  : objects_(objects.begin(), objects.end()), options_(options), viewer_(viewer) {
  // nop
}

/// From rim to rim.
double TablePlaces::gap_to(std::size_t object, const GroundPoint& centre,
                           std::size_t landmark) const {
  const auto& x = objects_.at(landmark);
  return std::max(distance(centre, x.centre) - x.radius - objects_.at(object).radius, 0.0);
}

double TablePlaces::nearness(std::size_t object, const GroundPoint& centre,
                             std::size_t landmark) const {
  return 1 - gap_to(object, centre, landmark) / options_.near_gap;
}

/// Of several landmarks, to the nearest: what is left of them all is beside the leftmost.
double TablePlaces::gap_to_landmarks(const PlaceWanted& place, std::size_t object,
                                     const GroundPoint& centre) const {
  double result = std::numeric_limits<double>::infinity();
  for (const auto landmark : place.landmarks)
    result = std::min(result, gap_to(object, centre, landmark));
  return result;
}

bool TablePlaces::is_close(const PlaceWanted& place, std::size_t object) const {
  const double most = place.relation == "near"    ? options_.clearly_near_gap
                      : direction(place.relation) ? options_.clearly_beside_gap
                                                  : std::numeric_limits<double>::infinity();
  const auto& centre = objects_.at(object).centre;
  const bool is_rather_aside =
    direction(place.relation) && fit(place, object, centre) < options_.clear_side_fit;
  return place.landmarks.empty() ||
         (!is_rather_aside && gap_to_landmarks(place, object, centre) <= most);
}

/// How much worse places are that are farther from their landmarks than what is beside them.
double TablePlaces::far_off(std::span<const PlaceWanted> places, std::size_t object,
                            const GroundPoint& centre) const {
  constexpr double share = 3; // per metre
  double result = 0;
  for (const auto& place : places)
    if (!place.landmarks.empty() && direction(place.relation))
      result = std::max(result, gap_to_landmarks(place, object, centre) - options_.beside_gap);
  return share * result;
}

/// In the middle third between two, and not beside the line; of more, around their middle.
double TablePlaces::between(const PlaceWanted& place, const GroundPoint& centre) const {
  if (place.landmarks.size() < 2)
    return 0;
  const auto a = objects_.at(place.landmarks.front()).centre;
  const auto b = objects_.at(place.landmarks.back()).centre;
  if (place.landmarks.size() > 2) {
    GroundPoint middle;
    double reach = 0;
    for (const auto i : place.landmarks) {
      middle.x += objects_.at(i).centre.x / static_cast<double>(place.landmarks.size());
      middle.y += objects_.at(i).centre.y / static_cast<double>(place.landmarks.size());
    }
    for (const auto i : place.landmarks)
      reach = std::max(reach, distance(middle, objects_.at(i).centre));
    return 1 - distance(centre, middle) / std::max(reach / 2, 0.01);
  }
  const double length = std::max(distance(a, b), 0.01);
  const GroundPoint along{(b.x - a.x) / length, (b.y - a.y) / length};
  const double share = ((centre.x - a.x) * along.x + (centre.y - a.y) * along.y) / length;
  const double beside = std::abs((centre.x - a.x) * along.y - (centre.y - a.y) * along.x);
  return std::min(1 - std::abs(share - 0.5) / 0.35, 1 - beside / (length / 4));
}

/// Along the way as the viewer sees it, and along the table: what stands in front of a thing at the
/// left is not left of it, though a viewer who is near may see it so. Above 0.5 within half a right
/// angle to each side.
double TablePlaces::side_fit(SpatialRelation way, const GroundPoint& centre,
                             const GroundPoint& landmark) const {
  const GroundPoint straight_before{landmark.x, landmark.y - 1};
  return std::min(angle_fit(way, centre, landmark, viewer_),
                  angle_fit(way, centre, landmark, straight_before));
}

double TablePlaces::fit_to_landmark(const PlaceWanted& place, std::size_t object,
                                    const GroundPoint& centre) const {
  if (place.relation == "between")
    return between(place, centre);
  double worst = 1;
  for (const auto landmark : place.landmarks) {
    if (landmark == object)
      return 0;
    const auto& x = objects_.at(landmark);
    double fit = 0;
    if (place.relation == "near")
      fit = nearness(object, centre, landmark);
    else if (place.relation == "away")
      fit = distance(centre, x.centre) >= away_distance ? 1 : 0;
    else if (place.relation == "on")
      fit = distance(centre, x.centre) < x.radius ? 1 : 0;
    else if (const auto way = direction(place.relation))
      fit =
        (2 * side_fit(*way, centre, x.centre) - 1) * std::max(1 - distance(centre, x.centre), 0.1);
    else
      throw std::invalid_argument("there is no place '" + place.relation + "' of something");
    worst = std::min(worst, fit);
  }
  return worst;
}

double TablePlaces::fit(const PlaceWanted& place, std::size_t object,
                        const GroundPoint& centre) const {
  if (!place.landmarks.empty())
    return std::clamp(fit_to_landmark(place, object, centre), 0.0, 1.0);
  const auto& x = objects_.at(object);
  if (place.relation == "elsewhere" || place.relation == "aside")
    return distance(centre, x.centre) >= elsewhere_distance ? 1 : 0;
  const auto fit = fit_in_part(place.relation, options_.area, centre, x.radius);
  if (!fit)
    throw std::invalid_argument("the table has no part '" + place.relation + "'");
  return std::clamp(*fit, 0.0, 1.0);
}

std::vector<PlaceHeld> TablePlaces::all_held(std::span<const std::string> parts) const {
  std::vector<PlaceHeld> result;
  const auto note = [&](std::size_t object, const PlaceWanted& place) {
    if (holds(place, object))
      result.push_back({object, place, is_close(place, object)});
  };
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    for (const auto& part : parts)
      note(i, {part, {}});
    for (std::size_t j = 0; j < objects_.size(); ++j) {
      if (j == i)
        continue;
      for (const auto* relation : {"left", "right", "front", "back", "near", "away", "on"})
        note(i, {relation, {j}});
      for (std::size_t k = 0; k < objects_.size(); ++k)
        if (k != i && k != j)
          note(i, {"between", {j, k}});
    }
  }
  return result;
}

/// To the nearest other thing; infinite without one.
double TablePlaces::least_gap(std::size_t object, const GroundPoint& centre) const {
  const double radius = objects_.at(object).radius;
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < objects_.size(); ++i)
    if (i != object)
      result = std::min(result, distance(centre, objects_[i].centre) - radius - objects_[i].radius);
  return result;
}

Reach TablePlaces::reach_of(const GroundPoint& centre) const {
  return options_.reach ? options_.reach(centre) : Reach::direct;
}

PlacesFound TablePlaces::on_top(std::size_t object, std::span<const PlaceWanted> places) const {
  const auto& landmarks = places.front().landmarks;
  if (places.size() > 1 || landmarks.size() != 1)
    return {{}, {}, "it can stand on one thing only"};
  const auto below = landmarks.front();
  if (below == object)
    return {{}, {}, "nothing can stand on itself"};
  const auto& x = objects_.at(below);
  if (!x.is_flat)
    return {{}, {}, "it would fall off: the top is not flat"};
  // What it stands on itself is there, too.
  for (std::size_t i = 0; i < objects_.size(); ++i)
    if (i != object && i != below && distance(objects_[i].centre, x.centre) < x.radius &&
        objects_[i].bottom > x.top - height_inaccuracy)
      return {{}, {}, "something stands on it already"};
  return {{{x.centre, 1, {}}}, below, {}};
}

PlacesFound TablePlaces::find(std::size_t object, std::span<const PlaceWanted> places,
                              std::size_t count) const {
  for (const auto& place : places)
    if (place.relation == "on" && !place.landmarks.empty())
      return on_top(object, places);
  const auto& x = objects_.at(object);
  struct Candidate {
    GroundPoint centre;
    /// Of the fit alone, and with how far away it is.
    double fit = 0;
    double value = 0;
    Reach reach = Reach::direct;
    bool is_likely = false;
    /// One that is found already is beside it.
    bool is_beside = false;
  };
  std::vector<Candidate> candidates;
  bool is_somewhere = false;
  bool is_reached = false;
  bool is_free_somewhere = false;
  const auto& area = options_.area;
  // What is held is nowhere, and comes from the middle.
  const GroundPoint middle{(area.low.x + area.high.x) / 2, (area.low.y + area.high.y) / 2};
  const bool is_on_table = x.centre.x >= area.low.x && x.centre.x <= area.high.x &&
                           x.centre.y >= area.low.y && x.centre.y <= area.high.y;
  const auto from = is_on_table ? x.centre : middle;
  const auto columns =
    positions_between(area.low.x + x.radius, area.high.x - x.radius, options_.step);
  const auto rows = positions_between(area.low.y + x.radius, area.high.y - x.radius, options_.step);
  for (const double column : columns)
    for (const double row : rows) {
      const GroundPoint centre{column, row};
      const double fit = worst_fit(places, object, centre);
      if (fit <= 0)
        continue;
      is_somewhere = true;
      const auto reach = reach_of(centre);
      const double gap = least_gap(object, centre);
      const bool has_room = gap >= std::min(options_.clearance, options_.least_clearance);
      is_reached = is_reached || reach != Reach::none;
      is_free_somewhere = is_free_somewhere || has_room;
      if (reach == Reach::none || !has_room)
        continue;
      const int unlikely = static_cast<int>(reach) + (gap < options_.clearance ? 1 : 0);
      // Who gets a thing has it at hand, though it takes the arm longer.
      const bool takes_stop_only = unlikely == 1 && reach == Reach::by_stop;
      const double less = takes_stop_only && are_worth_stop(places, !is_on_table) ? stop_worth_it
                          : takes_stop_only && is_one_direction(places) ? stop_worth_for_direction
                                                                        : unlikely * less_likely;
      // Of equally good ones, the nearest to where it is.
      const double far = 0.2 * distance(centre, from) + off_side(places, from, centre) +
                         far_off(places, object, centre);
      const double narrow = 0.3 * std::max(0.0, 1 - gap / options_.ample_clearance);
      const double border = fits_around(places, object, centre) ? 0 : 1;
      candidates.push_back(
        {centre, fit, fit - far - narrow - border - less, reach, unlikely == 0, false});
    }
  PlacesFound result;
  std::size_t beside = 0;
  while (result.targets.size() < count && !candidates.empty()) {
    const auto best = *std::ranges::max_element(candidates, {}, &Candidate::value);
    result.targets.push_back({best.centre, best.fit, {}, best.reach});
    beside += best.is_beside ? 1 : 0;
    std::erase_if(candidates, [&](const Candidate& y) {
      return distance(y.centre, best.centre) < options_.close ||
             (y.is_beside && beside == most_beside);
    });
    // A place beside one that is not possible may be; others are tried first that are as likely.
    for (auto& y : candidates)
      if (best.is_likely && y.is_likely && !y.is_beside &&
          distance(y.centre, best.centre) < options_.likely_apart) {
        y.is_beside = true;
        y.value -= less_likely / 2;
      }
  }
  if (result.targets.empty())
    result.reason = !is_somewhere        ? "there is no such place on the table"
                    : !is_reached        ? "I do not reach any such place with it"
                    : !is_free_somewhere ? "there is no room"
                                         : "there is no room where I reach";
  return result;
}

double TablePlaces::worst_fit(std::span<const PlaceWanted> places, std::size_t object,
                              const GroundPoint& centre) const {
  double result = 1;
  for (const auto& place : places)
    result = std::min(result, fit(place, object, centre));
  return result;
}

/// Of what is to go to one side of the table only: how far it would go to another, unless it is to
/// be in the middle, and how little it would be on that one.
double TablePlaces::off_side(std::span<const PlaceWanted> places, const GroundPoint& from,
                             const GroundPoint& centre) const {
  constexpr double aside_share = 1;
  constexpr double unclear_share = 0.5;
  const auto way = places.size() == 1 && places.front().landmarks.empty()
                     ? way_to_side(places.front().relation)
                     : std::nullopt;
  if (!way)
    return 0;
  const double aside = is_middle_of_side(places.front().relation)
                         ? 0
                         : std::abs((centre.x - from.x) * way->y - (centre.y - from.y) * way->x);
  return aside_share * aside + unclear_share * (1 - clearness_on_side(*way, options_.area, centre));
}

/// Whether it still is there if it is put a little beside.
bool TablePlaces::fits_around(std::span<const PlaceWanted> places, std::size_t object,
                              const GroundPoint& centre) const {
  const double off = options_.inaccuracy;
  for (const auto& [x, y] : {std::pair{off, 0.0}, {-off, 0.0}, {0.0, off}, {0.0, -off}})
    if (worst_fit(places, object, {centre.x + x, centre.y + y}) <= 0)
      return false;
  return true;
}

} // namespace castor::spatial
