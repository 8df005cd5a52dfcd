#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Exploring a building: the action, and what is said of it. Metres, in the frame of the map.
namespace castor::mapping {

/// Action: see all of the building that can be reached.
struct Explore {
  /// Ends with success once that many square metres are known to be free; 0: only when nothing
  /// reachable is left.
  double area = 0;
};

enum class FrontierState {
  /// Can be gone to.
  open,
  /// Is being gone to.
  chosen,
  /// The map has no way there that is wide enough.
  unreachable,
  /// Was gone to, and what is behind it was not seen; or could not be driven to.
  given_up
};

/// A border between what is known to be free and what is unknown.
struct FrontierReport {
  /// Its middle.
  double x = 0;
  double y = 0;
  /// Length.
  double size = 0;
  FrontierState state = FrontierState::open;
  /// Why it is unreachable or given up.
  std::string reason;

  friend bool operator==(const FrontierReport&, const FrontierReport&) = default;
};

/// Entry: how far an Explorer is. Its id is the component's name; it is overwritten.
struct ExplorationState {
  /// When that was, microseconds since the system began.
  std::int64_t time = 0;
  /// Known to be free, square metres.
  double seen = 0;
  std::vector<FrontierReport> frontiers;
  /// Places that the Navigator was asked to go to.
  std::int64_t goals = 0;
  /// Nothing is left that can be reached.
  bool finished = false;

  friend bool operator==(const ExplorationState&, const ExplorationState&) = default;
};

CASTOR_REFLECT(Explore, area)
CASTOR_REFLECT_ENUM(FrontierState, open, chosen, unreachable, given_up)
CASTOR_REFLECT(FrontierReport, x, y, size, state, reason)
CASTOR_REFLECT(ExplorationState, time, seen, frontiers, goals, finished)

} // namespace castor::mapping
