#include "castor/benchmarks/rooms/room_scores.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace castor::mapping {

namespace {

using Label = std::int32_t;
using Sizes = std::map<Label, std::size_t>;

Sizes sizes_of(const std::vector<Label>& labels, std::size_t smallest) {
  Sizes result;
  for (auto x : labels)
    if (x > 0)
      ++result[x];
  std::erase_if(result, [&](const auto& x) { return x.second <= smallest; });
  return result;
}

struct Means {
  double by_room = 0;
  double by_area = 0;
};

/// @param largest pixels of each room that its best counterpart has
Means means_of(const Sizes& sizes, const Sizes& largest) {
  double shares = 0;
  double covered = 0;
  double total = 0;
  for (const auto& [label, size] : sizes) {
    auto found = largest.find(label);
    auto common = found == largest.end() ? 0. : static_cast<double>(found->second);
    shares += common / static_cast<double>(size);
    covered += common;
    total += static_cast<double>(size);
  }
  if (sizes.empty())
    return {};
  return {shares / static_cast<double>(sizes.size()), covered / total};
}

} // namespace

RoomScores room_scores(const std::vector<Label>& truth, const std::vector<Label>& found,
                       std::size_t smallest) {
  if (truth.size() != found.size())
    throw std::invalid_argument("room_scores: the label images differ in size");
  const auto true_sizes = sizes_of(truth, smallest);
  const auto found_sizes = sizes_of(found, smallest);
  std::map<std::pair<Label, Label>, std::size_t> common;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (true_sizes.contains(truth[i]) && found_sizes.contains(found[i]))
      ++common[{truth[i], found[i]}];
  Sizes largest_of_true;
  Sizes largest_of_found;
  for (const auto& [pair, size] : common) {
    auto& of_true = largest_of_true[pair.first];
    of_true = std::max(of_true, size);
    auto& of_found = largest_of_found[pair.second];
    of_found = std::max(of_found, size);
  }
  const auto recall = means_of(true_sizes, largest_of_true);
  const auto precision = means_of(found_sizes, largest_of_found);
  return {.recall = recall.by_room,
          .precision = precision.by_room,
          .recall_by_area = recall.by_area,
          .precision_by_area = precision.by_area,
          .true_rooms = true_sizes.size(),
          .found_rooms = found_sizes.size()};
}

std::vector<Label> connected_rooms(const std::vector<bool>& free, int width, int height) {
  if (width < 0 || height < 0 ||
      free.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw std::invalid_argument("connected_rooms: width times height is not the number of pixels");
  std::vector<Label> labels(free.size(), 0);
  std::vector<std::pair<int, int>> pending;
  Label last = 0;
  auto position = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height)
      return;
    auto i = position(x, y);
    if (!free[i] || labels[i] != 0)
      return;
    labels[i] = last;
    pending.emplace_back(x, y);
  };
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      if (!free[position(column, row)] || labels[position(column, row)] != 0)
        continue;
      ++last;
      visit(column, row);
      while (!pending.empty()) {
        auto [x, y] = pending.back();
        pending.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            visit(x + dx, y + dy);
      }
    }
  return labels;
}

} // namespace castor::mapping
