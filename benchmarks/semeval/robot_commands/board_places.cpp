#include "castor/benchmarks/semeval/robot_commands/board_places.hpp"

#include <algorithm>

namespace castor::semeval {

namespace {

constexpr int last = board_size - 1;

std::uint64_t row(int x) {
  std::uint64_t cells = 0;
  for (int y = 0; y < board_size; ++y)
    cells |= cell(x, y);
  return cells;
}

std::uint64_t column(int y) {
  std::uint64_t cells = 0;
  for (int x = 0; x < board_size; ++x)
    cells |= cell(x, y);
  return cells;
}

/// The half of the board, or its middle.
std::uint64_t side(std::string_view indicator) {
  std::uint64_t cells = 0;
  for (int x = 0; x < board_size; ++x)
    for (int y = 0; y < board_size; ++y) {
      const bool is_in = (indicator == "front" && x >= board_size / 2) ||
                         (indicator == "back" && x < board_size / 2) ||
                         (indicator == "left" && y >= board_size / 2) ||
                         (indicator == "right" && y < board_size / 2) ||
                         (indicator == "center" && x > 1 && x < last - 1 && y > 1 && y < last - 1);
      if (is_in)
        cells |= cell(x, y);
    }
  return cells;
}

std::vector<std::uint64_t> parts(std::string_view type) {
  if (type == "corner")
    return {cell(0, 0), cell(0, last), cell(last, 0), cell(last, last)};
  if (type == "edge")
    return {row(0), row(last), column(0), column(last)};
  if (type == "robot")
    return {cell(last, board_size / 2)};
  return {~std::uint64_t{0}};
}

/// Edges and corners lie on a side if all of them does.
bool lies_on(std::uint64_t cells, std::string_view type, std::string_view indicator) {
  if (type == "edge")
    return cells == (indicator == "front"   ? row(last)
                     : indicator == "back"  ? row(0)
                     : indicator == "left"  ? column(last)
                     : indicator == "right" ? column(0)
                                            : 0);
  return (cells & ~side(indicator)) == 0;
}

} // namespace

std::uint64_t cell(int x, int y) {
  return std::uint64_t{1} << (board_size * x + y);
}

BoardPoint middle(const Referent& referent) {
  BoardPoint sum;
  double count = 0;
  for (int x = 0; x < board_size; ++x)
    for (int y = 0; y < board_size; ++y)
      if ((referent.cells & cell(x, y)) != 0) {
        sum.x += x;
        sum.y += y;
        ++count;
      }
  return count == 0 ? sum : BoardPoint{sum.x / count, sum.y / count};
}

bool is_place(std::string_view type) {
  return type == "corner" || type == "edge" || type == "region" || type == "board" ||
         type == "tile" || type == "robot";
}

std::vector<Referent> places(std::string_view type,
                             const std::vector<std::string_view>& indicators) {
  std::vector<Referent> found;
  for (auto cells : parts(type)) {
    bool fits = true;
    for (const auto indicator : indicators) {
      if (side(indicator) == 0)
        continue;
      if (type == "region" || type == "board" || type == "tile")
        cells &= side(indicator);
      else
        fits = fits && lies_on(cells, type, indicator);
    }
    if (fits && cells != 0)
      found.push_back({cells, -1, -1, nullptr});
  }
  return found;
}

} // namespace castor::semeval
