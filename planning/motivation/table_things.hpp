#pragma once

#include <map>
#include <string>
#include <vector>

/// What requests about a table are about.
namespace castor::planning {

/// A place on the table that a goal is about, metres.
struct TableSpot {
  /// In the goal's formula.
  std::string name;
  double x = 0;
  double y = 0;

  friend bool operator==(const TableSpot&, const TableSpot&) = default;
};

/// Fingers fit into such a gap between two things, metres.
inline constexpr double finger_gap = 0.035;

/// What stands so near to its place is not moved to it, metres.
inline constexpr double stands_right = 0.008;

/// A move of something on the table that was made.
struct TableMove {
  /// The planner's name for the thing, and how it is called: "the red ball".
  std::string object;
  std::string words;
  /// What it was done for: "you said 'put the ball there'"; empty if nobody says so.
  std::string because = {};

  friend bool operator==(const TableMove&, const TableMove&) = default;
};

/// Something on the table that requests are about.
struct TableThing {
  /// The proxy by which requests refer to it.
  std::string proxy;
  /// The planner's names for it and for the waypoint that it is at.
  std::string object;
  std::string waypoint;
  /// How it is called: "the red ball".
  std::string words;
  /// To the right, metres.
  double x = 0;
  /// By kinds of features: colour, shape, size.
  std::map<std::string, std::string, std::less<>> qualities = {};
  /// Parts of the table that it is in, such as left.
  std::vector<std::string> parts = {};
  /// The waypoint where it was before it was last moved; empty if it was not.
  std::string waypoint_before = {};
  bool is_held = false;
  /// Other proxies by which requests may refer to it.
  std::vector<std::string> former_proxies = {};
  /// Where it was before the last goal; empty if that did not move it.
  std::string waypoint_before_goal = {};
  /// Away from the viewer, and of the disc that it fits in, metres.
  double y = 0;
  double radius = 0.03;
  /// The waypoint where it was before it was moved for the first time; empty if it was not.
  std::string waypoint_at_first = {};
  /// That of `waypoint_before`; without a name if there is none.
  TableSpot spot_before = {};
  /// Somebody has said that it is not to be touched, or that nothing is to be put on it.
  bool is_kept = false;
  bool is_kept_clear = false;
  /// Metres; 0 if it is not known.
  double height = 0;
  /// The planner's name of the thing that it stands on; empty for the table.
  std::string on = {};
  /// Where it was when people last said to remember that; empty if they did not.
  std::string waypoint_noted = {};
  /// It was last moved to put it where it was before.
  bool has_returned = false;
  /// It is what was moved last.
  bool is_last_moved = false;

  bool was_moved() const { return !waypoint_before.empty(); }

  /// Metres. The disc around a cube is wider than that.
  double width() const {
    const auto shape = qualities.find("shape");
    return shape != qualities.end() && shape->second == "cube" ? height : 2 * radius;
  }
};

} // namespace castor::planning
