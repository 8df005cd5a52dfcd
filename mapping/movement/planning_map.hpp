#pragma once

#include "castor/mapping/movement/clearance_map.hpp"

#include <cstdint>
#include <optional>

namespace castor::mapping {

/// A map with the clearances that planning needs, which are computed once for each version of it.
class PlanningMap {
public:
  explicit PlanningMap(const ClearanceOptions& options = {}) : options_(options) {
    // nop
  }

  /// Takes over the map, unless it has that version already.
  void update(const CellMap& map, std::uint64_t version);

  /// Of the map that it has; nothing before the first.
  std::optional<std::uint64_t> version() const { return version_; }

  const CellMap& cells() const { return cells_; }

  /// From obstacles as the options say.
  const ClearanceMap& clearance() const { return clearance_; }

  /// From occupied cells only.
  const ClearanceMap& clearance_of_occupied() const {
    return options_.unknown_is_obstacle ? of_occupied_ : clearance_;
  }

private:
  ClearanceOptions options_;
  std::optional<std::uint64_t> version_;
  CellMap cells_;
  ClearanceMap clearance_;
  ClearanceMap of_occupied_;
};

} // namespace castor::mapping
