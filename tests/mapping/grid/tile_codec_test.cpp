// The bytes of tile entries.

#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/grid/tile_codec.hpp"

#include "castor/tests/mapping/grid/box_room.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace castor::mapping::test {

namespace {

TileCells any_cells() {
  TileCells result;
  for (auto& x : result)
    x = *rc::gen::arbitrary<std::int8_t>();
  return result;
}

TileCells scanned_cells() {
  OccupancyGrid grid;
  constexpr BoxRoom small_room{-2, 2, -1, 2};
  grid.insert(small_room.scan({}), {});
  return grid.cells({0, 0});
}

TEST(TileCodec, ScannedCellsTakeFewBytes) {
  auto cells = scanned_cells();
  auto bytes = encode_tile(cells);
  EXPECT_EQ(decode_tile(bytes), cells);
  EXPECT_LT(bytes.size(), cells.size() / 8);
}

TEST(TileCodec, RefusesOtherFormatsAndOtherSizes) {
  EXPECT_THROW(decode_tile({}), DamagedTile);
  auto bytes = encode_tile(scanned_cells());
  bytes[0] = 7;
  try {
    decode_tile(bytes);
    FAIL();
  } catch (const DamagedTile& e) {
    EXPECT_STREQ(e.what(), "the tile has format 7, and this version of Castor reads format 1 only");
  }
  bytes[0] = 1;
  bytes.push_back(0);
  EXPECT_THROW(decode_tile(bytes), DamagedTile);
}

RC_GTEST_PROP(TileCodec, DecodesWhatItEncodes, ()) {
  auto cells = any_cells();
  RC_ASSERT(decode_tile(encode_tile(cells)) == cells);
}

RC_GTEST_PROP(TileCodec, NoticesDamage, ()) {
  const auto cells = scanned_cells();
  auto bytes = encode_tile(cells);
  auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
  if (*rc::gen::arbitrary<bool>()) {
    bytes.resize(at);
  } else {
    bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ *rc::gen::inRange(1, 256));
  }
  // Unused bits of a zlib stream may be anything: the cells are intact then.
  try {
    RC_ASSERT(decode_tile(bytes) == cells);
  } catch (const DamagedTile&) {
    RC_SUCCEED("noticed");
  }
}

} // namespace

} // namespace castor::mapping::test
