#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/restart_type.hpp"

#include <chrono>
#include <optional>

namespace castor {

/// What a component line tells the supervisor of the component, which may run elsewhere. `castor
/// check` and the component itself have refused values that cannot be read.
struct ChildOptions {
  /// `--restart`
  RestartType restart = RestartType::permanent;
  /// `--shutdown`: how long it may take to stop; nothing if that is up to the options of the
  /// system.
  std::optional<std::chrono::milliseconds> shutdown = {};

  explicit ChildOptions(const ComponentDescription& x);
};

} // namespace castor
