#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace castor::mapping {

struct FreeSpaceOptions {
  /// Metres.
  double cell_size = 0.1;
  /// Beams say what is free up to there, metres from the scanner.
  double range = 10;
  /// The last part of a beam says nothing, metres: it may graze a wall.
  double end = 0.2;
};

/// Where nothing has stood for some time, so that what is there now has moved. A grid around the
/// robot; each cell counts how often it was passed by beams, and hit by them.
class FreeSpace {
public:
  explicit FreeSpace(const FreeSpaceOptions& options) : options_(options) {}

  /// Whether the place was free, and is not beside something that stands.
  bool was_free(const Point2& p) const;

  /// Whether something has been there, or beside, for about a second.
  bool is_settled(const Point2& p) const;

  /// One scan. Beams without a return are left out.
  /// @param standing where beams ended at what may stand
  /// @param moving where they ended at those who move, which says only where it is free before them
  void add(const Point2& scanner, std::span<const Point2> standing, std::span<const Point2> moving);

private:
  struct Cell {
    /// Positive: something stands there; negative: it was free.
    std::int16_t count = 0;
    /// Numbers of the last scans that hit it, and that passed it.
    std::uint32_t hit = 0;
    std::uint32_t passed = 0;
  };
  static constexpr int tile_side = 32; // cells
  using Tile = std::array<Cell, tile_side * tile_side>;

  struct CellIndex {
    std::int32_t column = 0;
    std::int32_t row = 0;
  };

  CellIndex index(const Point2& p) const;
  int count(CellIndex x) const;
  /// Whether one of the nine cells around was hit at least that often more than passed.
  bool is_any_hit(CellIndex middle, int times) const;
  Cell& cell(CellIndex x);
  void pass(const Point2& scanner, const Point2& end);
  void forget_far(const Point2& scanner);

  FreeSpaceOptions options_;
  std::unordered_map<std::uint64_t, Tile> tiles_;
  /// The last one that was asked for.
  std::uint64_t last_key_ = 0;
  Tile* last_tile_ = nullptr;
  std::uint32_t scan_ = 0;
};

} // namespace castor::mapping
