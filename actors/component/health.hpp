#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>

/// Entries about the health of a system, so that an architecture can react to it, in the working
/// memory of the subarchitecture `castor`, which every supervised system has. The id of an entry is
/// the name of the component; a component that never failed has none.
///
///     on_change(added<ComponentDown>().in(health_subarchitecture), ...)
namespace castor {

inline constexpr const char* health_subarchitecture = "castor";

/// A component or a working memory is down.
struct ComponentDown {
  std::string component;
  /// Empty for a stand-alone component.
  std::string subarchitecture;
  std::uint64_t incarnation = 1;
  std::string reason;
  /// Whether its supervisors are going to start it again.
  bool will_restart = false;
};
CASTOR_REFLECT(ComponentDown, component, subarchitecture, incarnation, reason, will_restart)

/// A component or a working memory is up again.
struct ComponentUp {
  std::string component;
  std::string subarchitecture;
  std::uint64_t incarnation = 1;
  /// How long it was down, microseconds.
  std::int64_t down_us = 0;
};
CASTOR_REFLECT(ComponentUp, component, subarchitecture, incarnation, down_us)

} // namespace castor
