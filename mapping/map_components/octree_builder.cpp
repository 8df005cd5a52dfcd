#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/write_batch.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/map_components/follows_keyframes.hpp"
#include "castor/mapping/octree/anchored_octree.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::mapping {

namespace {

std::string id_of(const BlockIndex& x) {
  return "block " + std::to_string(x.x) + ' ' + std::to_string(x.y) + ' ' + std::to_string(x.z);
}

/// Keeps the octree of what lasers and other sensors see at the corrected poses of keyframes, as
/// OctreeBlock entries, and answers what is asked about it. One that is started again answers by
/// the entries, until it has made the octree anew. Clouds that were pushed are in its memory only:
/// then, there is what the lasers of keyframes have seen.
class OctreeBuilder final : public FollowsKeyframes<UnmanagedComponent> {
  void configure() override {
    octree_.emplace(OccupancyOctreeOptions{voxel_size_, max_range_}, voxel_size_.get());
  }

  void start() override {
    restore();
    if (!clouds_->empty())
      on_push<SensedCloud>(clouds_, [this](const std::shared_ptr<const SensedCloud>& x) {
        newest_cloud_ = x;
        if (last_.object)
          place_cloud(last_, last_robot_);
        write_blocks(blocks_per_step_);
      });
    on_call<AskPoint>([this](const AskPoint& x) { return octree_->octree().at(x.point); });
    on_call<AskRay>([this](const AskRay& x) { return octree_->octree().cast(x); });
    on_call<AskBox>([this](const AskBox& x) { return octree_->octree().look_into(x.box); });
    follow_keyframes();
    every(std::min<std::chrono::nanoseconds>(rebuild_period_.get(), rebuild_step_), [this] {
      rebuild();
      write_blocks(blocks_per_step_);
    });
  }

  void restore() {
    std::map<BlockIndex, BlockVoxels> blocks;
    for (auto& x : read_all<OctreeBlock>()) {
      const BlockIndex index{x->x, x->y, x->z};
      written_[index] = {x->version, x->bytes};
      try {
        if (x->voxel_size == voxel_size_)
          blocks[index] = decode_tile(x->bytes);
      } catch (const DamagedTile& e) {
        warning("{}: {}; it is made anew", to_string(x.address), e.what());
      }
      if (!blocks.contains(index))
        changed_.insert(index);
    }
    is_restored_ = !blocks.empty();
    if (is_restored_)
      octree_->restore(blocks);
  }

  void place(const EntryOf<Keyframe>& keyframe, const Pose2& robot) override {
    auto& name = keyframe.address.id;
    std::shared_ptr<const PointCloud> laser;
    const bool is_new = !octree_->has(name);
    if (is_new)
      laser = std::make_shared<PointCloud>(cloud_of(keyframe->scan, {}, laser_height_));
    if (is_new && is_restored_ && was_there(*keyframe))
      octree_->anchor(name, std::move(laser), robot);
    else
      changed_.merge(octree_->place(name, std::move(laser), robot));
    if (!last_.object || keyframe->number >= last_->number) {
      last_ = keyframe;
      last_robot_ = robot;
    }
    place_cloud(keyframe, robot);
  }

  /// Anchors the newest cloud to a keyframe of the same time; corrects the pose of one that is.
  void place_cloud(const EntryOf<Keyframe>& keyframe, const Pose2& robot) {
    auto name = cloud_of_keyframe(keyframe.address.id);
    if (octree_->has(name)) {
      octree_->place(name, nullptr, robot);
      return;
    }
    if (!newest_cloud_ || std::chrono::microseconds{
                            std::abs(newest_cloud_->time - keyframe->time)} > cloud_window_.get())
      return;
    auto& x = newest_cloud_->coordinates;
    auto cloud = std::make_shared<PointCloud>();
    cloud->sensor = newest_cloud_->sensor;
    for (std::size_t i = 0; i + 2 < x.size(); i += 3)
      cloud->points.push_back(
        {static_cast<double>(x[i]), static_cast<double>(x[i + 1]), static_cast<double>(x[i + 2])});
    newest_cloud_.reset();
    changed_.merge(octree_->place(name, std::move(cloud), robot));
  }

  static std::string cloud_of_keyframe(const std::string& keyframe) { return keyframe + " cloud"; }

  void remove(const std::string& keyframe) override {
    octree_->remove(keyframe);
    octree_->remove(cloud_of_keyframe(keyframe));
  }

  void placed() override {
    has_all_ = true;
    write_blocks(blocks_per_step_);
  }

  void stop() override { write_blocks(changed_.size()); }

  /// A step of a rebuild, if one is due.
  void rebuild() {
    // Not from a part of the keyframes.
    if (!has_all_)
      return;
    if (!octree_->is_rebuilding() && (!octree_->is_outdated() || now() < next_rebuild_))
      return;
    auto start = std::chrono::steady_clock::now();
    changed_.merge(octree_->rebuild(clouds_per_step_));
    rebuild_time_ += std::chrono::steady_clock::now() - start;
    if (octree_->is_rebuilding())
      return;
    // A large map takes long: nine tenths of the time are left for other things.
    next_rebuild_ =
      now() + std::max<Timestamp>(rebuild_period_.get(),
                                  std::chrono::duration_cast<Timestamp>(9 * rebuild_time_));
    rebuild_time_ = {};
  }

  /// Looks at up to `most` of the blocks that may have changed, and writes those that have.
  void write_blocks(std::size_t most) {
    WriteBatch batch;
    std::size_t blocks = 0;
    for (; most > 0 && !changed_.empty(); --most) {
      const auto index = changed_.extract(changed_.begin()).value();
      auto bytes = encode_tile(octree_->octree().block(index));
      auto [at, is_new] = written_.try_emplace(index);
      auto& written = at->second;
      if (written.bytes == bytes)
        continue;
      written = {written.version + 1, std::move(bytes)};
      OctreeBlock block{index.x, index.y, index.z, written.version, voxel_size_, written.bytes};
      if (is_new)
        batch.add(here(id_of(index)), std::move(block));
      else
        batch.overwrite(here(id_of(index)), std::move(block));
      ++blocks;
    }
    if (blocks > 0)
      write(batch);
  }

  /// Between the steps of a rebuild.
  static constexpr std::chrono::milliseconds rebuild_step_{100};
  /// Some hundredths of a second of computing, for scans of hundreds of beams.
  static constexpr std::size_t clouds_per_step_ = 20;
  static constexpr std::size_t blocks_per_step_ = 100;

  struct Written {
    std::uint64_t version = 0;
    std::vector<std::uint8_t> bytes;
  };

  Option<double> voxel_size_{this, "voxel-size", 0.1, "side of a voxel, metres"};
  Option<double> max_range_{this, "max-range", 8, "longer beams are free space only; metres"};
  Option<double> laser_height_{this, "laser-height", 0.3, "of the laser above the floor, metres"};
  Option<StandaloneName> clouds_{this, "clouds", "",
                                 "stand-alone component that pushes SensedCloud; empty: none"};
  Option<std::chrono::milliseconds> cloud_window_{
    this, "cloud-window", std::chrono::milliseconds{100},
    "a cloud belongs to a keyframe that is at most so much older or newer"};
  Option<std::chrono::milliseconds> rebuild_period_{this, "rebuild-period", std::chrono::seconds{5},
                                                    "corrected poses take effect at most so often"};

  std::optional<AnchoredOctree> octree_;
  std::shared_ptr<const SensedCloud> newest_cloud_;
  EntryOf<Keyframe> last_;
  Pose2 last_robot_;
  /// By the entries of a predecessor, until it is made anew.
  bool is_restored_ = false;
  /// Whether all keyframes were told once.
  bool has_all_ = false;
  Timestamp next_rebuild_{0};
  std::chrono::steady_clock::duration rebuild_time_{};
  std::set<BlockIndex> changed_;
  std::map<BlockIndex, Written> written_;
};

CASTOR_COMPONENT(OctreeBuilder, "keeps the octree of free and occupied space, and answers queries")

} // namespace

} // namespace castor::mapping
