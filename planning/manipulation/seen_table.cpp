#include "castor/planning/manipulation/seen_table.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/mapping/geometry/seen_solid.hpp"
#include "castor/planning/manipulation/arm_model.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

namespace castor::manipulation {

namespace {

using geometry::SeenSolid;

// Outlines that fit worse are those of other shapes, or of several things; pixels.
constexpr double worst_fit = 6;
// How far surfaces are off at most, where the outline fits; metres. Of 193 things on random tables
// few were more than that larger than seen, and those higher only.
constexpr double fitted_uncertainty = 0.002;
// More for each pixel that the outline is off, metres.
constexpr double pixel_uncertainty = 0.001;
// Standard deviations of its height by which a thing may be higher than it is seen: 500
// rendered cylinders were higher by at most 1.8 of them, most of all those below the camera.
constexpr double height_deviations = 2;
// Of what is known by its box only.
constexpr double box_uncertainty = 0.005;

// What is no flat piece is not seen to be flatter or thinner, metres.
constexpr double least_thickness = 0.01;

/// What is partly hidden may fit best to a mere slice.
bool is_plausible(const std::string& shape, const Solid& solid) {
  const bool is_solid = shape == "cube" || shape == "sphere" || shape == "cylinder";
  return !is_solid || std::min({solid.size.x, solid.size.y, solid.size.z}) >= least_thickness;
}

std::string description_of(const vision::SceneObject& x) {
  const bool has_colour = x.colour.value != vision::Hypothesis{}.value;
  const bool has_shape = x.shape.value != vision::Hypothesis{}.value;
  return "the " + (has_colour ? x.colour.value + ' ' : std::string{}) +
         (has_shape ? x.shape.value : "thing");
}

/// By the outline, else by the box; nothing if neither says where it is.
std::optional<SeenSolid> solid_of(const vision::SceneObject& x, const SeenEntries& entries) {
  for (const auto& id : x.roi_ids) {
    const auto region = entries.regions.find(id);
    if (region == entries.regions.end() || !entries.camera || entries.camera->is_assumed)
      continue;
    const auto& contour = region->second.contour;
    std::vector<std::vector<geometry::Point2>> others;
    for (const auto& [other, seen] : entries.regions)
      if (std::ranges::find(x.roi_ids, other) == x.roi_ids.end())
        others.push_back(seen.contour);
    auto fitted = geometry::seen_solid(x.shape.value, contour, *entries.camera, others);
    if (!fitted || fitted->error > geometry::good_outline_fit)
      for (const char* shape : {"cylinder", "box"})
        if (auto other = geometry::seen_solid(shape, contour, *entries.camera, others);
            other && is_plausible(x.shape.value, other->solid) &&
            (!fitted || other->error < fitted->error))
          fitted = std::move(other);
    if (fitted && fitted->error <= worst_fit)
      return fitted;
  }
  const auto& size = x.box.size;
  if (!(size.x > 0 && size.y > 0 && size.z > 0))
    return {};
  return SeenSolid{box(size.x, size.y, size.z),
                   {x.box.centroid, {}, x.box.frame},
                   (box_uncertainty - fitted_uncertainty) / pixel_uncertainty};
}

} // namespace

std::vector<SeenThing> seen_things(const SeenEntries& entries, const Pose& arm) {
  const auto to_arm = geometry::inverse(arm, arm_frame);
  std::vector<SeenThing> result;
  std::map<std::string, int> count;
  for (const auto& [id, object] : entries.objects) {
    const auto seen = solid_of(object, entries);
    if (!seen)
      continue;
    auto name = description_of(object);
    if (const int number = ++count[name]; number > 1)
      name += ' ' + std::to_string(number);
    auto pose = geometry::compose(to_arm, seen->pose);
    result.push_back({id,
                      object.colour.value,
                      object.shape.value,
                      {std::move(name), seen->solid, std::move(pose),
                       fitted_uncertainty + pixel_uncertainty * seen->error,
                       height_deviations * seen->height_deviation}});
  }
  return result;
}

void leave_out_held(std::vector<SeenThing>& things, const SeenThing& held, const Pose& at) {
  const double size = outer_radius(held.thing.solid) + seen_off(std::max(at.position.z, 0.0));
  std::erase_if(things, [&](const SeenThing& x) {
    const double within = size + outer_radius(x.thing.solid);
    return x.colour == held.colour &&
           distance_on_table(x.thing.pose.position, at.position) < within;
  });
}

Scene scene_of(const std::vector<SeenThing>& things) {
  Scene result{{table_top(table_length, table_length)}, {}};
  for (const auto& x : things)
    result.things.push_back(x.thing);
  return result;
}

const SeenThing* find_like(const std::vector<SeenThing>& things, const SeenThing& x,
                           const Point3& place, double within) {
  const SeenThing* best = nullptr;
  const auto rank = [&](const SeenThing& y) {
    return std::pair(y.shape != x.shape, distance_on_table(y.thing.pose.position, place));
  };
  for (const auto& y : things)
    if ((y.colour == x.colour || x.colour == vision::Hypothesis{}.value) &&
        distance_on_table(y.thing.pose.position, place) <= within &&
        (!best || rank(y) < rank(*best)))
      best = &y;
  return best;
}

std::vector<Point3> free_places(const std::vector<SeenThing>& things, double width, bool wide) {
  // For the fingers, metres.
  constexpr double gap = 0.04;
  // Where who looks at the table still sees it, metres.
  constexpr double most_aside = 0.24;
  constexpr int rings = 13;
  constexpr int rays = 17;
  std::vector<std::pair<double, Point3>> found;
  for (int ring = 0; ring < rings; ++ring)
    for (int ray = 0; ray < rays; ++ray) {
      const double distance = 0.20 + 0.02 * ring;
      // From the middle to both sides.
      const double degrees = 6.0 * ((ray + 1) / 2) * (ray % 2 == 0 ? 1 : -1);
      const double angle = degrees * std::numbers::pi / 180;
      const Point3 place{distance * std::cos(angle), distance * std::sin(angle), 0};
      const bool is_in_middle = distance > 0.27 && std::abs(degrees) < 25;
      if (std::abs(place.y) > most_aside || (!wide && !is_in_middle))
        continue;
      double room = std::numeric_limits<double>::infinity();
      for (const auto& x : things)
        room = std::min(room, distance_on_table(x.thing.pose.position, place) -
                                outer_radius(x.thing.solid) - width / 2);
      if (room >= gap)
        found.emplace_back(room, place);
    }
  std::ranges::stable_sort(found, std::ranges::greater{}, &std::pair<double, Point3>::first);
  std::vector<Point3> result;
  for (const auto& x : found)
    result.push_back(x.second);
  return result;
}

double distance_on_table(const Point3& a, const Point3& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

} // namespace castor::manipulation
