#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/write_batch.hpp"
#include "castor/mapping/grid/keyframe_grid.hpp"
#include "castor/mapping/grid/tile_entries.hpp"
#include "castor/mapping/map_components/follows_keyframes.hpp"

#include <optional>
#include <set>
#include <string>

namespace castor::mapping {

namespace {

/// Keeps the occupancy grid of all keyframes at their corrected poses, as GridTile entries.
class GridBuilder final : public FollowsKeyframes<UnmanagedComponent> {
  void configure() override {
    OccupancyGridOptions options;
    options.cells.cell_size = cell_size_;
    options.cells.max_range = max_range_;
    options.cells.free_without_return = free_without_return_;
    grid_.emplace(options);
  }

  void start() override {
    for (auto& x : read_all<GridTile>())
      entries_.adopt(*x);
    // Also what a predecessor has left, and no keyframe touches any more.
    touched_.merge(entries_.tiles());
    follow_keyframes();
  }

  void place(const EntryOf<Keyframe>& keyframe, const Pose2& robot) override {
    std::shared_ptr<const LaserScan> scan{keyframe.object, &keyframe->scan};
    touched_.merge(grid_->place(keyframe.address.id, scan, robot));
  }

  void remove(const std::string& keyframe) override { touched_.merge(grid_->remove(keyframe)); }

  void placed() override { write_tiles(); }

  void write_tiles() {
    std::set<TileIndex> known = entries_.tiles();
    WriteBatch batch;
    std::size_t tiles = 0;
    std::size_t bytes = 0;
    for (auto& x : entries_.changed(grid_->grid(), touched_)) {
      TileIndex tile{x.column, x.row};
      ++tiles;
      bytes += x.bytes.size();
      if (known.contains(tile))
        batch.overwrite(here(id_of(tile)), x);
      else
        batch.add(here(id_of(tile)), x);
    }
    touched_.clear();
    if (tiles == 0)
      return;
    write(batch);
    ++updates_;
    bytes_ += bytes;
    debug("{} tiles, {} bytes", tiles, bytes);
  }

  void stop() override {
    catch_up();
    if (updates_ > 0)
      info("{} keyframes in {} tiles; {} bytes of tiles per update", grid_->size(),
           entries_.tiles().size(), bytes_ / updates_);
  }

  Option<double> cell_size_{this, "cell-size", 0.05, "side of a cell, metres"};
  Option<double> max_range_{this, "max-range", 30, "longer beams are free space only; metres"};
  Option<double> free_without_return_{this, "free-without-return", 0,
                                      "a beam without a return is free space up to here; metres"};

  std::optional<KeyframeGrid> grid_;
  TileEntries entries_;
  std::set<TileIndex> touched_;
  std::size_t updates_ = 0;
  std::size_t bytes_ = 0;
};

CASTOR_COMPONENT(GridBuilder, "keeps the occupancy grid of the keyframes, in tiles")

} // namespace

} // namespace castor::mapping
