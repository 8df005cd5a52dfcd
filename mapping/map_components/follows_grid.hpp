#pragma once

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/grid/grid_view.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/grid/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <map>
#include <optional>
#include <string>

namespace castor::mapping {

/// A component derived from `Base` that has the grid in one piece, and is told of each change of
/// it.
template <class Base>
class FollowsGrid : public Base {
protected:
  using Base::Base;

  /// Tiles are in the component's own subarchitecture, or in the one that --grid names. To be
  /// called in `start()`: tells of all that there are.
  void follow_grid() {
    auto where = grid_->empty() ? this->subarchitecture() : std::string{grid_.get()};
    auto take_event = [this](const ChangeEvent& event) {
      try {
        note(take(this->template read<GridTile>(event.address)));
      } catch (const DoesNotExistOnWM&) {
        this->debug("{} was deleted before it was read", event.address.id);
      }
    };
    this->on_change(added<GridTile>().in(where), take_event);
    this->on_change(overwritten<GridTile>().in(where), take_event);
    this->on_change(deleted<GridTile>().in(where), [this](const ChangeEvent& event) {
      const auto known = tiles_.find(event.address.id);
      if (known == tiles_.end())
        return;
      const auto tile = known->second;
      tiles_.erase(known);
      note(view_.remove(tile));
    });
    // What there was before.
    std::optional<CellRegion> changed;
    for (auto& x : this->template read_all_in<GridTile>(where))
      if (auto region = take(x))
        changed = changed ? changed->united(*region) : region;
    note(changed);
  }

  /// Cells of that region have changed; the map may have grown.
  virtual void grid_changed(const CellRegion& changed) = 0;

  const GridView& grid() const { return view_; }

private:
  std::optional<CellRegion> take(const EntryOf<GridTile>& tile) {
    tiles_[tile.address.id] = {tile->column, tile->row};
    try {
      return view_.apply(*tile);
    } catch (const DamagedTile& e) {
      this->warning("{}: {}; its cells stay what they were", to_string(tile.address), e.what());
      return std::nullopt;
    }
  }

  void note(const std::optional<CellRegion>& changed) {
    if (changed)
      grid_changed(*changed);
  }

  Option<SubarchitectureName> grid_{this, "grid", "",
                                    "subarchitecture of the grid's tiles; empty: its own"};
  GridView view_;
  std::map<std::string, TileIndex> tiles_;
};

} // namespace castor::mapping
