#pragma once

#include "castor/mapping/slam/surface_points.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace castor::mapping {

struct CorrelativeOptions {
  /// Of the finest grid, m.
  double cell = 0.05;
  /// A beam that ends this far from a surface fits by 1 / sqrt(e), m.
  double spread = 0.07;
  /// The heading is searched in steps that move a point at this distance by a cell, m.
  double heading_range = 6;
};

struct SearchWindow {
  /// Half the width in x and in y, m.
  double translation = 1;
  /// To each side, radians.
  double heading = 0.3;
};

struct CorrelativeMatch {
  Pose2 pose;
  /// How well the scan fits there, from 0 to 1.
  double score = 0;
};

/// Finds the pose at which a scan fits best to points of a map within a window, without a guess:
/// correlative scan matching (Olson, 2009) by branch and bound over grids of maxima (Hess, Kohler,
/// Rapp, Andor, "Real-time loop closure in 2D LIDAR SLAM", 2016). The result is the best pose of
/// the search grid.
class CorrelativeMatcher {
public:
  /// @param map points in the frame of the poses
  explicit CorrelativeMatcher(const SurfacePoints& map, const CorrelativeOptions& options = {});

  /// Nothing if no pose has at least `least` as its score.
  std::optional<CorrelativeMatch> match(const SurfacePoints& scan, const Pose2& middle,
                                        const SearchWindow& window, double least) const;

private:
  /// Maxima over squares of 2^level cells, from each cell upwards and to the right.
  struct Level {
    std::int64_t columns = 0;
    std::int64_t rows = 0;
    /// Cells that the square reaches over; the grid begins that much to the left and below.
    std::int64_t margin = 0;
    std::vector<std::uint8_t> cells;

    std::uint8_t at(std::int64_t column, std::int64_t row) const {
      column += margin;
      row += margin;
      if (column < 0 || row < 0 || column >= columns || row >= rows)
        return 0;
      return cells[static_cast<std::size_t>(row * columns + column)];
    }
  };

  struct Node;
  struct Turn;

  void make_finest(const SurfacePoints& map);
  void make_coarser();
  double score_of(const Turn& turn, std::int64_t dx, std::int64_t dy, std::size_t level) const;

  CorrelativeOptions options_;
  double left_ = 0;
  double bottom_ = 0;
  std::vector<Level> levels_;
};

} // namespace castor::mapping
