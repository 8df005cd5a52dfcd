#include "castor/mapping/grid/tile_codec.hpp"

#include <zlib.h>

#include <string>

namespace castor::mapping {

namespace {

constexpr std::uint8_t format_zlib = 1;

} // namespace

std::vector<std::uint8_t> encode_tile(const TileCells& cells) {
  auto size = compressBound(static_cast<uLong>(cells.size()));
  std::vector<std::uint8_t> result(size + 1);
  result[0] = format_zlib;
  auto status = compress2(result.data() + 1, &size, reinterpret_cast<const Bytef*>(cells.data()),
                          static_cast<uLong>(cells.size()), Z_DEFAULT_COMPRESSION);
  // Impossible but for lack of memory, since there is room for incompressible cells.
  if (status != Z_OK)
    throw std::runtime_error("zlib cannot compress a tile: " + std::string{zError(status)});
  result.resize(size + 1);
  return result;
}

TileCells decode_tile(std::span<const std::uint8_t> bytes) {
  if (bytes.empty())
    throw DamagedTile("the tile has no bytes");
  if (bytes[0] != format_zlib)
    throw DamagedTile("the tile has format " + std::to_string(bytes[0]) +
                      ", and this version of Castor reads format 1 only");
  TileCells result;
  auto size = static_cast<uLongf>(result.size());
  auto used = static_cast<uLong>(bytes.size() - 1);
  auto status =
    uncompress2(reinterpret_cast<Bytef*>(result.data()), &size, bytes.data() + 1, &used);
  if (status != Z_OK)
    throw DamagedTile("the bytes of the tile are damaged: " + std::string{zError(status)});
  if (size != result.size() || used != bytes.size() - 1)
    throw DamagedTile("the tile has " + std::to_string(size) + " cells in " + std::to_string(used) +
                      " of " + std::to_string(bytes.size() - 1) + " bytes, instead of " +
                      std::to_string(result.size()) + " cells in all of them");
  return result;
}

} // namespace castor::mapping
