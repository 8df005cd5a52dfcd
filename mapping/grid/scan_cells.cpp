#include "castor/mapping/grid/scan_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace castor::mapping {

namespace {

struct Beam {
  Point2 end;
  bool hit = false;
};

/// Marks of the cells within a rectangle, so that each is listed once.
class CellMarks {
public:
  CellMarks(const Cell& low, const Cell& high)
    : low_(low), columns_(static_cast<std::size_t>(high.column - low.column) + 1),
      marks_(columns_ * (static_cast<std::size_t>(high.row - low.row) + 1)) {}

  /// Whether the cell had no mark yet.
  bool mark(const Cell& cell) {
    auto& x = marks_[static_cast<std::size_t>(cell.row - low_.row) * columns_ +
                     static_cast<std::size_t>(cell.column - low_.column)];
    return !std::exchange(x, true);
  }

private:
  Cell low_;
  std::size_t columns_;
  std::vector<char> marks_;
};

std::vector<Beam> beams_of(const LaserScan& scan, const Pose2& scanner,
                           const ScanCellsOptions& options) {
  std::vector<Beam> result;
  result.reserve(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    auto range = static_cast<double>(scan.ranges[i]);
    auto returned = std::isfinite(range) && range > 0;
    auto hit = returned && range <= options.max_range;
    auto length = hit ? range : returned ? options.max_range : options.free_without_return;
    if (length <= 0)
      continue;
    auto angle = scan.first_angle + static_cast<double>(i) * scan.angle_step;
    result.push_back(
      {transform(scanner, {length * std::cos(angle), length * std::sin(angle)}), hit});
  }
  return result;
}

/// Calls `visit` for the cells from `begin` to `end`, without that of `end`.
template <class Visit>
void traverse(const Point2& begin, const Point2& end, double cell_size, Visit&& visit) {
  auto cell = cell_of(begin, cell_size);
  auto last = cell_of(end, cell_size);
  auto dx = end.x - begin.x;
  auto dy = end.y - begin.y;
  std::int32_t step_x = dx > 0 ? 1 : -1;
  std::int32_t step_y = dy > 0 ? 1 : -1;
  constexpr auto never = std::numeric_limits<double>::infinity();
  // Share of the way at which the next border is crossed, and from border to border.
  auto next = [&](double from, double way, std::int32_t at) {
    return way == 0 ? never : ((way > 0 ? at + 1 : at) * cell_size - from) / way;
  };
  auto next_x = next(begin.x, dx, cell.column);
  auto next_y = next(begin.y, dy, cell.row);
  auto delta_x = dx == 0 ? never : cell_size / std::abs(dx);
  auto delta_y = dy == 0 ? never : cell_size / std::abs(dy);
  // Counted, so that rounding at the end cannot lead past it.
  auto steps_x = std::abs(last.column - cell.column);
  auto steps_y = std::abs(last.row - cell.row);
  while (steps_x + steps_y > 0) {
    visit(cell);
    if (steps_y == 0 || (steps_x > 0 && next_x < next_y)) {
      cell.column += step_x;
      next_x += delta_x;
      --steps_x;
    } else {
      cell.row += step_y;
      next_y += delta_y;
      --steps_y;
    }
  }
}

} // namespace

ScanCells cells_of(const LaserScan& scan, const Pose2& robot, const ScanCellsOptions& options) {
  ScanCells result;
  auto scanner = compose(robot, scan.mount);
  Point2 origin{scanner.x, scanner.y};
  auto beams = beams_of(scan, scanner, options);
  if (beams.empty())
    return result;
  auto low = cell_of(origin, options.cell_size);
  auto high = low;
  for (auto& beam : beams) {
    auto cell = cell_of(beam.end, options.cell_size);
    low = {std::min(low.column, cell.column), std::min(low.row, cell.row)};
    high = {std::max(high.column, cell.column), std::max(high.row, cell.row)};
  }
  CellMarks marks{low, high};
  for (auto& beam : beams)
    if (auto cell = cell_of(beam.end, options.cell_size); beam.hit && marks.mark(cell))
      result.hits.push_back(cell);
  auto pass = [&](const Cell& cell) {
    if (marks.mark(cell))
      result.passes.push_back(cell);
  };
  for (auto& beam : beams) {
    traverse(origin, beam.end, options.cell_size, pass);
    if (!beam.hit)
      pass(cell_of(beam.end, options.cell_size));
  }
  return result;
}

} // namespace castor::mapping
