#pragma once

#include "castor/mapping/grid/cells.hpp"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace castor::mapping {

/// The bytes of a GridTile cannot be decoded: what() says why.
class DamagedTile : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The cells of a tile as the bytes of a GridTile: the number of the format (1), then a zlib stream
/// of the cells, one byte for each, row by row from below. On logs of robots, that takes a quarter
/// to a third of the bytes of a run-length code (tests/mapping/grid/grid_bytes_test.cpp); the check
/// sum of the stream finds damage.
std::vector<std::uint8_t> encode_tile(const TileCells& cells);

/// Inverse of encode_tile().
/// @throws DamagedTile for bytes that encode_tile() does not make
TileCells decode_tile(std::span<const std::uint8_t> bytes);

} // namespace castor::mapping
