#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>

/// What a system says of its own health, so that an architecture can react to it: entries in a
/// working memory that every supervised system has, that of the subarchitecture `castor`. Each
/// stands under the name of the component; of one that never failed there is none.
///
///     on_change(added<ComponentDown>().in(health_subarchitecture), ...)
namespace castor {

inline constexpr const char* health_subarchitecture = "castor";

/// A component or a working memory is not there.
struct ComponentDown {
  std::string component;
  /// Empty for a stand-alone component.
  std::string subarchitecture;
  std::uint64_t incarnation = 1;
  std::string reason;
  /// It will be started again, so far as that depends on its supervisors.
  bool will_restart = false;
};
CASTOR_REFLECT(ComponentDown, component, subarchitecture, incarnation, reason, will_restart)

/// It is back.
struct ComponentUp {
  std::string component;
  std::string subarchitecture;
  std::uint64_t incarnation = 1;
  /// For how long it was not there, microseconds.
  std::int64_t down_us = 0;
};
CASTOR_REFLECT(ComponentUp, component, subarchitecture, incarnation, down_us)

} // namespace castor
