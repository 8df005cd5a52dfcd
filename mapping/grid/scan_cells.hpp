#pragma once

#include "castor/mapping/grid/cells.hpp"
#include "castor/mapping/planar/types.hpp"

#include <vector>

namespace castor::mapping {

/// The cells that a scan has evidence about, each at most once.
struct ScanCells {
  /// Cells with the end of a beam.
  std::vector<Cell> hits;
  /// Other cells that beams have passed.
  std::vector<Cell> passes;
};

struct ScanCellsOptions {
  /// Side of a cell, metres.
  double cell_size = 0.05;
  /// A longer beam is evidence for free space up to this distance only; metres.
  double max_range = 30;
  /// A beam without a return is evidence for free space up to this distance; metres. 0 for scanners
  /// whose beams may fail to return from dark or shiny things that are near.
  double free_without_return = 0;
};

/// Cells of a scan that was taken with the robot at `robot`. A beam whose range is not a finite
/// number, or not positive, counts as one without a return. A cell that one beam ends in and others
/// pass is a hit, since beams that graze a wall pass many of its cells (as in OctoMap: A. Hornung
/// et al., "OctoMap: an efficient probabilistic 3D mapping framework based on octrees", 2013). The
/// cells of a beam are those that it crosses, without gaps (J. Amanatides, A. Woo, "A fast voxel
/// traversal algorithm for ray tracing", 1987).
ScanCells cells_of(const LaserScan& scan, const Pose2& robot, const ScanCellsOptions& options);

} // namespace castor::mapping
