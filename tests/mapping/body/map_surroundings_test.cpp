#include "castor/mapping/body/map_surroundings.hpp"

#include "castor/mapping/maps/map_server.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <exception>
#include <fstream>
#include <stdexcept>

namespace castor::mapping {

namespace {

/// A room of 4 m x 3 m with walls of one cell of 0.1 m, from -1 -1.
void write_room(const std::filesystem::path& stem) {
  CellMap map;
  map.columns = 40;
  map.rows = 30;
  map.cell_size = 0.1;
  map.origin = {-1, -1, 0};
  map.cells.assign(40 * 30, 0);
  for (int column = 0; column < 40; ++column)
    map.at(column, 0) = map.at(column, 29) = 100;
  for (int row = 0; row < 30; ++row)
    map.at(0, row) = map.at(39, row) = 100;
  write_map_server(map, stem);
}

} // namespace

TEST(MapSurroundings, RobotDrivesInAMap) {
  const test::TemporaryFolder folder;
  write_room(folder / "room");
  BodyOptions options;
  options.laser.range_noise = 0;
  options.laser.missing = 0;
  options.laser.mount = {};
  auto surroundings = surroundings_in_map(folder / "room.yaml");
  surroundings.start = {1, 0.5, 0};
  SimulatedBody x(std::move(surroundings), options);
  // The wall at the right begins at 2.9.
  EXPECT_NEAR(x.scan().ranges[90], 1.9, 1e-5);
  EXPECT_NEAR(x.scan().ranges[180], 1.4, 1e-5);
  x.command({0.8, 0});
  for (int i = 0; i < 600; ++i)
    x.step();
  EXPECT_EQ(x.status().collisions, 1);
  EXPECT_NEAR(x.status().pose.x, 2.9 - 0.25, 0.02);
}

TEST(MapSurroundings, RefusesMapsThatAreTurnedOrMissing) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(surroundings_in_map(folder / "no.yaml"), std::exception);
  write_room(folder / "room");
  std::ofstream{folder / "room.yaml"}
    << "image: room.pgm\nresolution: 0.1\norigin: [-1, -1, 0.5]\nnegate: 0\n"
       "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  EXPECT_THROW(surroundings_in_map(folder / "room.yaml"), std::invalid_argument);
}

} // namespace castor::mapping
