#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <cstddef>
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

  /// One scan.
  /// @param ends where beams ended; those without a return are left out
  /// @param movers places of those who move: what is seen there does not stand
  void add(const Point2& scanner, std::span<const Point2> ends, std::span<const Point2> movers);

private:
  using Key = std::uint64_t;

  Key key(const Point2& p) const;
  int count(Key x) const;
  void forget_far(const Point2& scanner);

  FreeSpaceOptions options_;
  /// Positive: something stands there; negative: it was free.
  std::unordered_map<Key, std::int16_t> cells_;
  std::vector<Key> passed_;
  std::vector<Key> hit_;
};

} // namespace castor::mapping
