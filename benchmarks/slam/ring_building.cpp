#include "castor/benchmarks/slam/ring_building.hpp"

#include "castor/mapping/building/building_file.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>

namespace castor::slam_benchmark {

namespace {

constexpr double depth_of_rooms = 3;
constexpr double from_corner = 0.6; // of doors and cabinets, at least

/// A side of the block: walls of rooms and doors stand along it.
struct Side {
  mapping::Point2 corner;
  /// Along the side, and into the block; of length one.
  mapping::Point2 along;
  mapping::Point2 inwards;
  double length = 0;

  mapping::Point2 at(double way, double depth) const {
    return {corner.x + way * along.x + depth * inwards.x,
            corner.y + way * along.y + depth * inwards.y};
  }
  double heading() const { return std::atan2(along.y, along.x) * 57.29577951308232; }
};

std::array<Side, 4> sides_of(const RingOptions& options) {
  const double low = options.corridor;
  const double right = options.width - options.corridor;
  const double top = options.height - options.corridor;
  const double width = right - low;
  const double height = top - low;
  return {Side{{low, low}, {1, 0}, {0, 1}, width}, Side{{right, low}, {0, 1}, {-1, 0}, height},
          Side{{right, top}, {-1, 0}, {0, -1}, width}, Side{{low, top}, {0, -1}, {1, 0}, height}};
}

class RingWriter {
public:
  explicit RingWriter(const RingOptions& options) : options_(options), random_(options.seed) {}

  std::string write() {
    const double low = options_.corridor;
    const double right = options_.width - low;
    const double top = options_.height - low;
    add("wall 0 0 to {} 0 to {} {} to 0 {} close\n", options_.width, options_.width,
        options_.height, options_.height);
    add("wall {} {} to {} {} to {} {} to {} {} close\n", low, low, right, low, right, top, low,
        top);
    for (const auto& side : sides_of(options_))
      add_side(side);
    add("start {} {} heading 0\n", options_.corridor / 2 + 2, options_.corridor / 2);
    return text_;
  }

private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  void add_cabinet(const Side& side, double way, double depth) {
    const auto at = side.at(way, depth);
    add("furniture cabinet at {:.3f} {:.3f} box {:.2f} 0.4 1.5 turned {:.0f}\n", at.x, at.y,
        options_.is_repeating ? 1.0 : uniform(0.5, 1.4), side.heading());
  }

  // Rooms begin beyond those of the side before, so that corners stay closed.
  void add_side(const Side& side) {
    for (double way = depth_of_rooms + options_.door_spacing / 2;
         way < side.length - depth_of_rooms - from_corner; way += options_.door_spacing) {
      const auto door = side.at(way, 0);
      add("door door-{} at {:.3f} {:.3f} width 0.9\n", ++doors_, door.x, door.y);
      const auto wall = side.at(way + options_.door_spacing / 2, 0);
      const auto end = side.at(way + options_.door_spacing / 2, depth_of_rooms);
      add("wall {:.3f} {:.3f} to {:.3f} {:.3f}\n", wall.x, wall.y, end.x, end.y);
      const double aside = options_.is_repeating ? 0 : uniform(-0.8, 0.8);
      add_cabinet(side, way + aside, options_.is_repeating ? 2.5 : uniform(1.2, 2.6));
      if (!options_.is_repeating && uniform(0, 1) < 0.3)
        add_cabinet(side, way + uniform(-1.2, 1.2), -options_.corridor + 0.25);
    }
  }

  double uniform(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }

  RingOptions options_;
  std::mt19937_64 random_;
  std::string text_;
  int doors_ = 0;
};

} // namespace

mapping::Building ring_building(const RingOptions& options) {
  const double least = 2 * (options.corridor + depth_of_rooms) + options.door_spacing;
  if (options.width < least || options.height < least)
    throw std::invalid_argument(
      fmt::format("a ring with rooms takes at least {} m in both directions", least));
  auto result = mapping::parse_building("building ring\n" + RingWriter(options).write(), "ring");
  for (const auto& x : result.problems)
    if (x.severity == Severity::error)
      throw std::invalid_argument(render({x}));
  return result.building;
}

mapping::Path path_around(const RingOptions& options, double rounds) {
  const double low = options.corridor / 2;
  const double right = options.width - low;
  const double top = options.height - low;
  const mapping::Path corners{{right, low}, {right, top}, {low, top}, {low, low}};
  mapping::Path result{{low + 2, low}};
  double left = rounds * 2 * (right - low + top - low);
  for (std::size_t i = 0; left > 0; ++i) {
    const auto& from = result.back();
    const auto& to = corners[i % corners.size()];
    const double way = mapping::distance(from, to);
    const double share = std::min(1.0, left / way);
    result.push_back({std::lerp(from.x, to.x, share), std::lerp(from.y, to.y, share)});
    left -= way;
  }
  return result;
}

} // namespace castor::slam_benchmark
