#include "castor/mapping/pictures/map_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

namespace castor::mapping {

namespace {

struct Rgb {
  std::uint8_t red;
  std::uint8_t green;
  std::uint8_t blue;
};

/// Dark enough for text.
constexpr std::array<Rgb, 8> area_colours{{{0x1F, 0x77, 0xB4},
                                           {0xD6, 0x6A, 0x00},
                                           {0x2C, 0x8A, 0x2C},
                                           {0x94, 0x47, 0xBD},
                                           {0x8C, 0x56, 0x4B},
                                           {0xC2, 0x3D, 0x98},
                                           {0x00, 0x8B, 0x9A},
                                           {0x7F, 0x7F, 0x00}}};
constexpr Rgb gateway_colour{0x20, 0x20, 0x20};
constexpr Rgb path_colour{0x20, 0xA0, 0x40};
constexpr Rgb person_colour{0x80, 0x30, 0xC0};
constexpr Rgb frontier_colour{0xF0, 0x80, 0x00};
constexpr Rgb unreachable_colour{0x80, 0x80, 0x80};

using Colours = std::map<std::int64_t, std::size_t>;

/// For each area, by the order of their ids, the colour that comes next among those that no area
/// behind its gateways has.
Colours colours_of_areas(const MapKnowledge& knowledge) {
  std::map<std::int64_t, std::int64_t> area_of;
  Colours result;
  for (const auto& x : knowledge.nodes) {
    area_of[x.id] = x.area;
    if (x.area >= 0)
      result[x.area] = 0;
  }
  std::map<std::int64_t, std::set<std::int64_t>> around;
  for (const auto& x : knowledge.edges) {
    const auto a = area_of.find(x.a);
    const auto b = area_of.find(x.b);
    if (a == area_of.end() || b == area_of.end())
      continue;
    if (a->second < 0)
      around[x.a].insert(b->second);
    if (b->second < 0)
      around[x.b].insert(a->second);
  }
  std::size_t next = 0;
  for (auto& [area, colour] : result) {
    std::set<std::size_t> taken;
    for (const auto& [gateway, areas] : around)
      if (areas.contains(area))
        for (auto other : areas)
          if (other < area && result.contains(other))
            taken.insert(result.at(other));
    colour = next;
    while (taken.contains(colour) && taken.size() < area_colours.size())
      colour = (colour + 1) % area_colours.size();
    next = (colour + 1) % area_colours.size();
  }
  return result;
}

class Scene {
public:
  explicit Scene(const MapKnowledge& knowledge)
    : knowledge_(knowledge), colours_(colours_of_areas(knowledge)) {
    // nop
  }

  MapScene make() {
    draw_graph();
    if (!knowledge_.trajectory.empty()) {
      result_.tracks.push_back({.poses = knowledge_.trajectory});
      tell("trajectory");
    }
    draw_people();
    draw_frontiers();
    draw_paths();
    return std::move(result_);
  }

private:
  void tell(const std::string& what) {
    result_.content += (result_.content.empty() ? "" : ", ") + what;
  }

  void line(std::vector<Pose2> poses, const Rgb& colour, int width, bool has_ends) {
    MapTrack track;
    track.poses = std::move(poses);
    track.red = colour.red;
    track.green = colour.green;
    track.blue = colour.blue;
    track.width = width;
    track.has_ends = has_ends;
    result_.tracks.push_back(std::move(track));
  }

  void mark(const Point2& place, const Rgb& colour, int radius, std::string text = {}) {
    result_.marks.push_back(
      {place, colour.red, colour.green, colour.blue, radius, std::move(text)});
  }

  Rgb colour_of_area(std::int64_t area) const {
    const auto x = colours_.find(area);
    return x == colours_.end() ? gateway_colour : area_colours[x->second];
  }

  /// The centroid of a corridor that goes around rooms is in one of them.
  Point2 middle_of(const Area& area) const {
    const GraphNode* nearest = nullptr;
    const auto far = [&](const GraphNode& x) {
      return std::hypot(x.pose.x - area.x, x.pose.y - area.y);
    };
    for (const auto& x : knowledge_.nodes)
      if (x.area == area.id && (!nearest || far(x) < far(*nearest)))
        nearest = &x;
    return nearest ? Point2{nearest->pose.x, nearest->pose.y} : Point2{area.x, area.y};
  }

  void draw_graph() {
    std::map<std::int64_t, const GraphNode*> nodes;
    for (const auto& x : knowledge_.nodes)
      nodes.emplace(x.id, &x);
    for (const auto& x : knowledge_.edges) {
      const auto a = nodes.find(x.a);
      const auto b = nodes.find(x.b);
      if (a == nodes.end() || b == nodes.end())
        continue;
      const auto area = std::max(a->second->area, b->second->area);
      line({a->second->pose, b->second->pose}, colour_of_area(area), 1, false);
    }
    for (const auto& x : knowledge_.nodes)
      mark({x.pose.x, x.pose.y},
           x.kind == NodeKind::gateway ? gateway_colour : colour_of_area(x.area), 4);
    std::size_t areas = 0;
    for (const auto& x : knowledge_.areas) {
      if (x.merged_into >= 0)
        continue;
      ++areas;
      mark(middle_of(x), colour_of_area(x.id), 0,
           x.label.empty() ? fmt::format("area {}", x.id) : x.label);
    }
    if (!knowledge_.nodes.empty())
      tell(fmt::format("{} nodes of {} areas", knowledge_.nodes.size(), areas));
  }

  void draw_people() {
    for (const auto& [id, poses] : knowledge_.people) {
      if (poses.empty())
        continue;
      line(poses, person_colour, 2, false);
      mark({poses.back().x, poses.back().y}, person_colour, 5, fmt::format("person {}", id));
    }
    if (!knowledge_.people.empty())
      tell(fmt::format("{} people", knowledge_.people.size()));
  }

  void draw_frontiers() {
    std::size_t count = 0;
    for (const auto& exploration : knowledge_.explorations)
      for (const auto& x : exploration.frontiers) {
        const bool is_open = x.state == FrontierState::open || x.state == FrontierState::chosen;
        mark({x.x, x.y}, is_open ? frontier_colour : unreachable_colour,
             x.state == FrontierState::chosen ? 8 : 5);
        ++count;
      }
    if (count > 0)
      tell(fmt::format("{} frontiers", count));
  }

  void draw_paths() {
    for (const auto& x : knowledge_.movements) {
      if (x.path.size() < 2)
        continue;
      line(x.path, path_colour, 2, true);
      tell("planned path");
    }
  }

  const MapKnowledge& knowledge_;
  Colours colours_;
  MapScene result_;
};

} // namespace

MapScene map_scene(const MapKnowledge& knowledge) {
  return Scene(knowledge).make();
}

} // namespace castor::mapping
