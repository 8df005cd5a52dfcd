#pragma once

#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/building.hpp"
#include "castor/mapping/grid/cell_map.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace castor::benchmark {

/// Where robots are to drive, and the map of it that they have.
class MovementWorld {
public:
  /// @param name file of a building, .yaml of a map, or generated:SEED
  /// @param start_seed of the place where a robot begins in a map, which does not say it
  /// \throws TextFileError, MapFileError, std::invalid_argument
  MovementWorld(const std::string& name, std::uint64_t start_seed);

  const mapping::CellMap& map() const { return map_; }
  const mapping::Pose2& start() const { return start_; }
  /// Nothing of a map.
  const std::optional<mapping::Building>& building() const { return building_; }

  mapping::BodySurroundings surroundings(const mapping::BodyOptions& options) const;

private:
  std::optional<mapping::Building> building_;
  mapping::CellMap map_;
  mapping::Pose2 start_;
};

} // namespace castor::benchmark
