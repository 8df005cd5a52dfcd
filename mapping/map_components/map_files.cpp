#include "castor/mapping/map_components/map_files.hpp"

#include "castor/mapping/exports/carmen_text.hpp"
#include "castor/mapping/exports/g2o_text.hpp"
#include "castor/mapping/exports/map_picture.hpp"
#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/maps/output_file.hpp"
#include "castor/mapping/octree/occupancy_octree.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// Collects what was written.
class MapFolder {
public:
  explicit MapFolder(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error)
      throw std::runtime_error("cannot make the folder " + path.string() + ": " + error.message());
  }

  std::filesystem::path file(const std::string& name) const { return path_ / name; }

  void wrote(const std::string& name) { result_.files.push_back(file(name).string()); }

  void write(const std::string& name, const std::string& bytes) {
    write_output_file(file(name), bytes);
    wrote(name);
  }

  void leave_out(const std::string& name, const std::string& reason) {
    result_.left_out.push_back(name + ": " + reason);
  }

  ExportedMap result() && { return std::move(result_); }

private:
  std::filesystem::path path_;
  ExportedMap result_;
};

void write_grid(MapFolder& folder, const CellMap& map, const MapContents& contents,
                std::span<const Pose2> truth) {
  if (map.columns > 0) {
    write_map_server(map, folder.file("map"));
    folder.wrote("map.pgm");
    folder.wrote("map.yaml");
  } else {
    folder.leave_out("map.yaml", "there is no grid");
  }
  std::vector<MapTrack> tracks;
  // Broader, to be seen where the path is true.
  if (!truth.empty())
    tracks.push_back({{truth.begin(), truth.end()}, 0x60, 0xC0, 0x70, 6});
  MapTrack path;
  for (auto& x : contents.keyframes)
    path.poses.push_back(x.pose);
  const bool is_empty = map.columns == 0 && path.poses.empty();
  tracks.push_back(std::move(path));
  if (!is_empty)
    folder.write("map.png", map_picture(map, tracks));
  else
    folder.leave_out("map.png", "there is neither a grid nor a keyframe");
}

void write_octree(MapFolder& folder, std::span<const OctreeBlock> blocks) {
  if (blocks.empty()) {
    folder.leave_out("map.ot", "there is no octree");
    return;
  }
  OccupancyOctree octree{{.voxel_size = blocks.front().voxel_size}};
  std::map<BlockIndex, BlockVoxels> voxels;
  for (auto& x : blocks)
    voxels[{x.x, x.y, x.z}] = decode_tile(x.bytes);
  octree.set_blocks(voxels);
  for (auto* name : {"map.ot", "map.bt"}) {
    octree.write(folder.file(name));
    folder.wrote(name);
  }
}

} // namespace

ExportedMap write_map_files(const std::filesystem::path& path, const MapContents& contents,
                            std::span<const GridTile> tiles, std::span<const OctreeBlock> blocks,
                            std::span<const Pose2> truth) {
  MapFolder folder{path};
  write_grid(folder, cell_map(tiles), contents, truth);
  if (contents.keyframes.empty()) {
    folder.leave_out("keyframes.g2o", "there is no keyframe");
  } else {
    folder.write("keyframes.g2o", g2o_text(contents));
    folder.write("corrected.log", carmen_text(contents));
  }
  write_octree(folder, blocks);
  return std::move(folder).result();
}

} // namespace castor::mapping
