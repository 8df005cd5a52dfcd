#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/restart_type.hpp"

#include <chrono>
#include <optional>

namespace castor {

/// Options of a component line that its supervisor needs; the component may run in another process.
/// Invalid values were refused by `castor check` and by the component itself.
struct ChildOptions {
  /// `--restart`
  RestartType restart = RestartType::permanent;
  /// `--shutdown`: how long it may take to stop; the default of the system's options if there is no
  /// value.
  std::optional<std::chrono::milliseconds> shutdown = {};

  explicit ChildOptions(const ComponentDescription& x);
};

} // namespace castor
