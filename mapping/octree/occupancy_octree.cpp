#include "castor/mapping/octree/occupancy_octree.hpp"

#include "castor/mapping/geometry/poses.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

using geometry::Point3;

/// The key of the voxel whose lowest corner is the origin; below it are the negative coordinates.
constexpr int key_of_origin = 32768;

constexpr std::int64_t most_voxels_of_box = 10'000'000;

octomap::point3d octomap_point(const Point3& x) {
  return {static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)};
}

Point3 point(const octomap::point3d& x) {
  return {static_cast<double>(x.x()), static_cast<double>(x.y()), static_cast<double>(x.z())};
}

bool is_finite(std::initializer_list<Point3> points) {
  return std::ranges::all_of(
    points, [](auto& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); });
}

std::int32_t block_of(octomap::key_type key) {
  // A shift rounds towards minus infinity.
  return (static_cast<std::int32_t>(key) - key_of_origin) >> 4;
}

BlockIndex block_of(const octomap::OcTreeKey& key) {
  return {block_of(key[0]), block_of(key[1]), block_of(key[2])};
}

octomap::key_type key_of(std::int32_t block, int voxel) {
  return static_cast<octomap::key_type>(block * block_side + voxel + key_of_origin);
}

/// The first and the last voxel of a block.
std::pair<octomap::OcTreeKey, octomap::OcTreeKey> key_range(const BlockIndex& x) {
  constexpr auto last = block_side - 1;
  return {{key_of(x.x, 0), key_of(x.y, 0), key_of(x.z, 0)},
          {key_of(x.x, last), key_of(x.y, last), key_of(x.z, last)}};
}

/// Voxels on a side of a leaf at this depth; single voxels are 16 deep.
int side_of(unsigned depth) {
  return 1 << (16 - static_cast<int>(depth));
}

/// Calls `visit` with the key of each voxel of the block, in the order of BlockVoxels.
template <class Visit>
void for_each_voxel(const BlockIndex& block, Visit&& visit) {
  for (int z = 0; z < block_side; ++z)
    for (int y = 0; y < block_side; ++y)
      for (int x = 0; x < block_side; ++x)
        visit(octomap::OcTreeKey{key_of(block.x, x), key_of(block.y, y), key_of(block.z, z)});
}

/// Log-odds below 0, which are free, stay below 0.
std::int8_t quantised(float log_odds) {
  auto result = std::lround(static_cast<double>(log_odds) / quantum);
  return static_cast<std::int8_t>(log_odds < 0 ? std::min(result, -1L) : result);
}

} // namespace

OccupancyOctree::OccupancyOctree(OccupancyOctreeOptions options) : options_(options) {
  if (!(options.voxel_size > 0) || !(options.max_range > 0))
    throw std::invalid_argument("the voxel size and the maximal range have to be more than 0");
  tree_ = std::make_unique<octomap::OcTree>(options.voxel_size);
}

OccupancyOctree::OccupancyOctree(OccupancyOctree&&) noexcept = default;
OccupancyOctree& OccupancyOctree::operator=(OccupancyOctree&&) noexcept = default;
OccupancyOctree::~OccupancyOctree() = default;

std::set<BlockIndex> OccupancyOctree::insert(const PointCloud& cloud) {
  std::set<BlockIndex> result;
  octomap::OcTreeKey key;
  auto is_within = [&](const Point3& x) {
    return is_finite({x}) && tree_->coordToKeyChecked(octomap_point(x), key);
  };
  if (!is_within(cloud.sensor))
    return result;
  octomap::Pointcloud points;
  points.reserve(cloud.points.size());
  for (auto& x : cloud.points)
    if (is_within(x))
      points.push_back(octomap_point(x));
  octomap::KeySet free;
  octomap::KeySet occupied;
  tree_->computeDiscreteUpdate(points, octomap_point(cloud.sensor), free, occupied,
                               options_.max_range);
  // What OcTree::insertPointCloud does, but it does not tell which voxels it changes, and goes
  // through the whole octree each time.
  std::vector<std::pair<octomap::OcTreeKey, bool>> changes;
  auto note = [&](const octomap::OcTreeKey& voxel, bool hit) {
    auto* before = tree_->search(voxel);
    if (!before || (hit ? before->getLogOdds() < tree_->getClampingThresMaxLog()
                        : before->getLogOdds() > tree_->getClampingThresMinLog()))
      changes.emplace_back(voxel, hit);
  };
  for (auto& x : free)
    note(x, false);
  for (auto& x : occupied)
    note(x, true);
  // Inner nodes are updated with each voxel, or all of the octree after the last.
  const bool are_many = changes.size() * tree_->getTreeDepth() > tree_->size();
  BlockIndex last;
  for (auto& [voxel, hit] : changes) {
    tree_->updateNode(voxel, hit, are_many);
    if (auto block = block_of(voxel); result.empty() || block != last) {
      last = block;
      result.insert(block);
    }
  }
  if (are_many)
    tree_->updateInnerOccupancy();
  return result;
}

PointOccupancy OccupancyOctree::at(const Point3& where) const {
  octomap::OcTreeKey key;
  if (!is_finite({where}) || !tree_->coordToKeyChecked(octomap_point(where), key))
    return {};
  auto* node = tree_->search(key);
  if (!node)
    return {};
  return {tree_->isNodeOccupied(node) ? Occupancy::occupied : Occupancy::free,
          node->getOccupancy()};
}

RayEnd OccupancyOctree::cast(const AskRay& ray) const {
  auto& d = ray.direction;
  auto length = std::hypot(d.x, d.y, d.z);
  if (!is_finite({ray.origin, d}) || !(length > 0) || !(ray.max_range > 0))
    throw std::invalid_argument("a ray needs finite numbers, a direction that is not 0, and a "
                                "positive range");
  octomap::point3d end;
  auto hit = tree_->castRay(octomap_point(ray.origin), octomap_point(d), end, !ray.stops_at_unknown,
                            ray.max_range);
  RayEnd result;
  auto way = ray.max_range / length;
  result.point = {ray.origin.x + way * d.x, ray.origin.y + way * d.y, ray.origin.z + way * d.z};
  result.distance = ray.max_range;
  // Without a hit, `end` is the unknown voxel where the ray has stopped, or past the range.
  if (hit)
    result.met = Occupancy::occupied;
  else if (ray.stops_at_unknown && at(point(end)).occupancy == Occupancy::unknown)
    result.met = Occupancy::unknown;
  if (result.met != Occupancy::free) {
    result.point = point(end);
    result.distance = geometry::distance(ray.origin, result.point);
  }
  return result;
}

BoxOccupancy OccupancyOctree::look_into(const geometry::AlignedBox& box) const {
  auto& c = box.centroid;
  auto& s = box.size;
  if (!is_finite({c, s}) || s.x < 0 || s.y < 0 || s.z < 0)
    throw std::invalid_argument("a box needs finite numbers, and a size that is not negative");
  octomap::OcTreeKey low;
  octomap::OcTreeKey high;
  if (!tree_->coordToKeyChecked(octomap_point({c.x - s.x / 2, c.y - s.y / 2, c.z - s.z / 2}),
                                low) ||
      !tree_->coordToKeyChecked(octomap_point({c.x + s.x / 2, c.y + s.y / 2, c.z + s.z / 2}), high))
    throw std::invalid_argument("the box is outside of the octree");
  BoxOccupancy result;
  result.voxels = 1;
  for (unsigned i = 0; i < 3; ++i)
    result.voxels *= high[i] - low[i] + 1;
  if (result.voxels > most_voxels_of_box)
    throw std::invalid_argument("the box has " + std::to_string(result.voxels) +
                                " voxels; ask for parts of at most " +
                                std::to_string(most_voxels_of_box));
  auto known_free = std::int64_t{0};
  octomap::OcTreeKey key;
  for (int x = low[0]; x <= high[0]; ++x)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int z = low[2]; z <= high[2]; ++z) {
        key = {static_cast<octomap::key_type>(x), static_cast<octomap::key_type>(y),
               static_cast<octomap::key_type>(z)};
        auto* node = tree_->search(key);
        if (!node)
          ++result.unknown_voxels;
        else if (tree_->isNodeOccupied(node))
          ++result.occupied_voxels;
        else
          ++known_free;
      }
  result.occupancy = result.occupied_voxels > 0    ? Occupancy::occupied
                     : known_free == result.voxels ? Occupancy::free
                                                   : Occupancy::unknown;
  return result;
}

std::size_t OccupancyOctree::leaves() const {
  return tree_->getNumLeafNodes();
}

BlockVoxels OccupancyOctree::block(const BlockIndex& block) const {
  BlockVoxels result;
  result.fill(unknown_cell);
  auto [low, high] = key_range(block);
  for (auto leaf = tree_->begin_leafs_bbx(low, high), end = tree_->end_leafs_bbx(); leaf != end;
       ++leaf) {
    auto value = quantised(leaf->getLogOdds());
    // A pruned leaf stands for a cube of voxels, which may be larger than a block.
    auto first = leaf.getIndexKey();
    auto side = side_of(leaf.getDepth());
    auto range = [&](unsigned axis) {
      auto from = std::max<int>(first[axis], low[axis]) - low[axis];
      auto to = std::min<int>(first[axis] + side - 1, high[axis]) - low[axis];
      return std::pair{from, to};
    };
    auto [x0, x1] = range(0);
    auto [y0, y1] = range(1);
    auto [z0, z1] = range(2);
    for (int z = z0; z <= z1; ++z)
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
          result[static_cast<std::size_t>((z * block_side + y) * block_side + x)] = value;
  }
  return result;
}

void OccupancyOctree::set_blocks(const std::map<BlockIndex, BlockVoxels>& blocks) {
  auto for_each_value = [&](auto&& f) {
    for (auto& [index, voxels] : blocks) {
      auto* voxel = voxels.data();
      for_each_voxel(index, [&](const octomap::OcTreeKey& key) { f(key, *voxel++); });
    }
  };
  bool forgets = false;
  for_each_value([&](const octomap::OcTreeKey& key, std::int8_t value) {
    forgets = forgets || (value == unknown_cell && tree_->search(key));
  });
  // OctoMap 1.9 cannot delete nodes: its own check ends the program when the last child has gone.
  if (forgets) {
    auto rest = std::make_unique<octomap::OcTree>(options_.voxel_size);
    for (auto& index : this->blocks())
      if (!blocks.contains(index))
        for_each_voxel(index, [&](const octomap::OcTreeKey& key) {
          if (auto* node = tree_->search(key))
            rest->setNodeValue(key, node->getLogOdds(), true);
        });
    tree_ = std::move(rest);
  }
  for_each_value([&](const octomap::OcTreeKey& key, std::int8_t value) {
    if (value != unknown_cell)
      tree_->setNodeValue(key, static_cast<float>(quantum * value), true);
  });
  tree_->updateInnerOccupancy();
  tree_->prune();
}

std::set<BlockIndex> OccupancyOctree::blocks() const {
  std::set<BlockIndex> result;
  for (auto leaf = tree_->begin_leafs(), end = tree_->end_leafs(); leaf != end; ++leaf) {
    // A pruned leaf may be larger than a block.
    auto first = leaf.getIndexKey();
    auto voxels = side_of(leaf.getDepth());
    auto [x0, y0, z0] = block_of(first);
    auto blocks = std::max(1, voxels / block_side);
    for (int x = 0; x < blocks; ++x)
      for (int y = 0; y < blocks; ++y)
        for (int z = 0; z < blocks; ++z)
          result.insert({x0 + x, y0 + y, z0 + z});
  }
  return result;
}

void OccupancyOctree::write(const std::filesystem::path& path) const {
  auto ending = path.extension();
  if (ending != ".ot" && ending != ".bt")
    throw std::runtime_error(path.string() + ": an octree is written to a file that ends in .ot or "
                                             ".bt");
  std::ofstream file{path, std::ios::binary | std::ios::trunc};
  if (ending == ".ot") {
    tree_->write(file);
  } else {
    // The copy loses its log-odds, and is smaller for it.
    octomap::OcTree copy{*tree_};
    copy.toMaxLikelihood();
    copy.prune();
    // OcTree::writeBinary() writes the same, and a line to the terminal.
    file << "# Octomap OcTree binary file\n"
         << "# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
         << "id " << copy.getTreeType() << "\nsize " << copy.size() << "\nres "
         << copy.getResolution() << "\ndata\n";
    copy.writeBinaryData(file);
  }
  file.close();
  if (!file)
    throw std::runtime_error(path.string() + ": the file cannot be written. Check that its folder "
                                             "exists, that you may write there, and that the disk "
                                             "is not full.");
}

} // namespace castor::mapping
