#include "castor/mapping/rooms/room_segmentation.hpp"

#include "castor/mapping/rooms/clearance.hpp"
#include "castor/mapping/rooms/clearance_basins.hpp"
#include "castor/mapping/rooms/cut_lines.hpp"
#include "castor/mapping/rooms/room_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace castor::mapping {

namespace {

using Labels = Raster<std::int32_t>;
using Pair = std::pair<std::int32_t, std::int32_t>;

void check(const CellMap& map, const RoomOptions& options) {
  if (!(map.cell_size > 0))
    throw std::invalid_argument("segment_rooms: the map's cell size is not positive");
  if (!(options.neck_ratio > 0) || options.neck_ratio > 1)
    throw std::invalid_argument("segment_rooms: neck_ratio is not within (0, 1]");
  if (options.largest_furniture < 0 || options.narrowest_opening < 0 || options.smallest_room < 0)
    throw std::invalid_argument("segment_rooms: a size is negative");
}

/// Merges the smallest label, again and again, into what it has the longest boundary with, until
/// none that adjoins another is smaller than `smallest` cells; removes small ones that are alone.
void merge_small(Labels& labels, double smallest) {
  std::map<std::int32_t, std::size_t> sizes;
  std::map<std::int32_t, std::map<std::int32_t, int>> boundaries;
  for (int i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0)
      continue;
    ++sizes[labels[i]];
    for (auto step : labels.beside())
      if (auto other = labels[i + step]; other >= 0 && other != labels[i])
        ++boundaries[labels[i]][other];
  }
  std::map<std::int32_t, std::int32_t> becomes;
  while (!sizes.empty()) {
    auto [label, size] = *std::ranges::min_element(sizes, {}, [](auto& x) { return x.second; });
    if (static_cast<double>(size) >= smallest)
      break;
    sizes.erase(label);
    auto adjoining = std::exchange(boundaries[label], {});
    auto widest = std::ranges::max_element(adjoining, {}, [](auto& x) { return x.second; });
    auto into = widest == adjoining.end() ? -1 : widest->first;
    becomes[label] = into;
    for (auto [other, length] : adjoining) {
      boundaries[other].erase(label);
      if (other != into) {
        boundaries[other][into] += length;
        boundaries[into][other] += length;
      }
    }
    if (into >= 0)
      sizes[into] += size;
  }
  for (auto& x : labels.cells)
    for (auto next = becomes.find(x); next != becomes.end(); next = becomes.find(x))
      x = next->second;
}

/// Numbers from 1 instead of labels, and 0 instead of none. Returns how many there are.
std::int32_t number(Labels& labels) {
  std::map<std::int32_t, std::int32_t> numbers;
  for (auto& x : labels.cells)
    x = x < 0 ? 0
              : numbers.try_emplace(x, static_cast<std::int32_t>(numbers.size()) + 1).first->second;
  return static_cast<std::int32_t>(numbers.size());
}

/// Boundary cells of two rooms that are within two cells of each other.
std::vector<std::vector<int>> connected(std::set<int> cells, const Labels& labels) {
  std::vector<std::vector<int>> result;
  while (!cells.empty()) {
    std::vector<int> piece{*cells.begin()};
    cells.erase(cells.begin());
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x)
          if (auto found = cells.find(piece[i] + y * labels.stride() + x); found != cells.end()) {
            piece.push_back(*found);
            cells.erase(found);
          }
    result.push_back(std::move(piece));
  }
  return result;
}

class Description {
public:
  Description(const CellMap& map, const Labels& labels, const Raster<float>& clearance,
              double narrowest_opening)
    : map_(map), labels_(labels), clearance_(clearance), narrowest_opening_(narrowest_opening) {}

  SegmentedRooms describe(std::int32_t rooms) const {
    SegmentedRooms result;
    result.openings = openings();
    std::vector<int> centres(static_cast<std::size_t>(rooms), -1);
    std::vector<std::size_t> sizes(centres.size(), 0);
    for (int row = 0; row < map_.rows; ++row)
      for (int column = 0; column < map_.columns; ++column) {
        auto cell = labels_.position(column, row);
        auto label = labels_[cell];
        result.labels.push_back(label);
        if (label == 0)
          continue;
        auto i = static_cast<std::size_t>(label - 1);
        ++sizes[i];
        if (centres[i] < 0 || clearance_[cell] > clearance_[centres[i]])
          centres[i] = cell;
      }
    for (std::size_t i = 0; i < centres.size(); ++i) {
      SegmentedRoom room;
      room.number = static_cast<std::int32_t>(i) + 1;
      room.centre = point(centres[i]);
      room.clearance = clearance_[centres[i]] * map_.cell_size;
      room.area = static_cast<double>(sizes[i]) * map_.cell_size * map_.cell_size;
      for (auto [column, row] : outline_of(labels_, room.number))
        room.outline.push_back(point(labels_.position(column, row)));
      std::set<std::int32_t> neighbours;
      for (const auto& x : result.openings)
        if (x.a == room.number || x.b == room.number)
          neighbours.insert(x.a == room.number ? x.b : x.a);
      room.neighbours.assign(neighbours.begin(), neighbours.end());
      result.rooms.push_back(std::move(room));
    }
    return result;
  }

private:
  /// Centre of a cell, in the frame of the map.
  Point2 point(int cell) const {
    return transform(map_.origin, {(labels_.column(cell) + 0.5) * map_.cell_size,
                                   (labels_.row(cell) + 0.5) * map_.cell_size});
  }

  std::vector<RoomOpening> openings() const {
    std::map<Pair, std::set<int>> boundaries;
    for (int i = 0; i < labels_.size(); ++i) {
      if (labels_[i] == 0)
        continue;
      for (auto step : labels_.beside())
        if (labels_[i + step] > labels_[i])
          boundaries[{labels_[i], labels_[i + step]}].insert(i);
    }
    std::vector<RoomOpening> result;
    for (auto& [pair, cells] : boundaries)
      for (const auto& piece : connected(std::move(cells), labels_)) {
        auto opening = opening_of(piece);
        opening.a = pair.first;
        opening.b = pair.second;
        if (opening.width >= narrowest_opening_)
          result.push_back(opening);
      }
    return result;
  }

  /// Between the two cells that are farthest apart.
  RoomOpening opening_of(const std::vector<int>& cells) const {
    RoomOpening result{.from = point(cells.front()), .to = point(cells.front())};
    auto longest = 0.;
    for (auto a : cells)
      for (auto b : cells)
        if (auto length = distance(point(a), point(b)); length > longest) {
          longest = length;
          result.from = point(a);
          result.to = point(b);
        }
    result.width = longest + map_.cell_size;
    return result;
  }

  const CellMap& map_;
  const Labels& labels_;
  const Raster<float>& clearance_;
  double narrowest_opening_;
};

} // namespace

SegmentedRooms segment_rooms(const CellMap& map, const RoomOptions& options) {
  check(map, options);
  const auto clear = clearance(map, options.largest_furniture, options.free_to);
  auto basins = clearance_basins(clear, options.neck_ratio);
  straighten(basins, clear, options.narrowest_opening / 2 / map.cell_size);
  merge_small(basins.labels, options.smallest_room / (map.cell_size * map.cell_size));
  const auto rooms = number(basins.labels);
  return Description(map, basins.labels, clear, options.narrowest_opening).describe(rooms);
}

} // namespace castor::mapping
