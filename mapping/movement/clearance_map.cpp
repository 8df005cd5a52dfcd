#include "castor/mapping/movement/clearance_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::mapping {

namespace {

/// Squared distance of a cell from an obstacle where there is none.
constexpr float far = 1e12F;

/// One dimension of the transform: lower envelope of the parabolas at `values`.
class LineTransform {
public:
  explicit LineTransform(std::size_t longest)
    : values(longest), result_(longest), vertices_(longest), bounds_(longest + 1) {}

  std::vector<float> values;

  const std::vector<float>& transform(std::size_t n) {
    constexpr auto infinity = std::numeric_limits<float>::infinity();
    std::size_t k = 0;
    vertices_[0] = 0;
    bounds_[0] = -infinity;
    bounds_[1] = infinity;
    for (std::size_t q = 1; q < n; ++q) {
      float s = intersection(q, vertices_[k]);
      while (s <= bounds_[k])
        s = intersection(q, vertices_[--k]);
      vertices_[++k] = q;
      bounds_[k] = s;
      bounds_[k + 1] = infinity;
    }
    k = 0;
    for (std::size_t q = 0; q < n; ++q) {
      while (bounds_[k + 1] < static_cast<float>(q))
        ++k;
      const auto away = static_cast<float>(q) - static_cast<float>(vertices_[k]);
      result_[q] = away * away + values[vertices_[k]];
    }
    return result_;
  }

private:
  float intersection(std::size_t q, std::size_t v) const {
    const auto a = static_cast<double>(q);
    const auto b = static_cast<double>(v);
    return static_cast<float>((double{values[q]} + a * a - double{values[v]} - b * b) /
                              (2 * (a - b)));
  }

  std::vector<float> result_;
  std::vector<std::size_t> vertices_;
  std::vector<float> bounds_;
};

} // namespace

ClearanceMap::ClearanceMap(const CellMap& map, const ClearanceOptions& options)
  : columns_(map.columns), rows_(map.rows),
    cell_size_(map.cell_size), origin_{map.origin.x, map.origin.y} {
  const auto columns = static_cast<std::size_t>(columns_);
  const auto rows = static_cast<std::size_t>(rows_);
  clearance_.resize(columns * rows);
  for (std::size_t i = 0; i < clearance_.size(); ++i) {
    const bool is_obstacle =
      map.cells[i] < 0 ? options.unknown_is_obstacle : map.cells[i] >= options.occupied_from;
    clearance_[i] = is_obstacle ? 0 : far;
  }
  LineTransform line(std::max(columns, rows));
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t row = 0; row < rows; ++row)
      line.values[row] = clearance_[row * columns + column];
    auto& result = line.transform(rows);
    for (std::size_t row = 0; row < rows; ++row)
      clearance_[row * columns + column] = std::min(result[row], far);
  }
  for (std::size_t row = 0; row < rows; ++row) {
    std::copy_n(clearance_.begin() + static_cast<std::ptrdiff_t>(row * columns), columns,
                line.values.begin());
    auto& result = line.transform(columns);
    for (std::size_t column = 0; column < columns; ++column)
      clearance_[row * columns + column] =
        std::max(0.0F, (std::sqrt(result[column]) - 0.5F) * static_cast<float>(cell_size_));
  }
}

double ClearanceMap::at(const Point2& point) const {
  const auto cell = cell_at(point);
  return cell ? at(*cell) : 0;
}

std::optional<std::size_t> ClearanceMap::cell_at(const Point2& point) const {
  const double column = std::floor((point.x - origin_.x) / cell_size_);
  const double row = std::floor((point.y - origin_.y) / cell_size_);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_))
    return std::nullopt;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

Point2 ClearanceMap::centre(std::size_t cell) const {
  const auto columns = static_cast<std::size_t>(columns_);
  return {origin_.x + (static_cast<double>(cell % columns) + 0.5) * cell_size_,
          origin_.y + (static_cast<double>(cell / columns) + 0.5) * cell_size_};
}

} // namespace castor::mapping
