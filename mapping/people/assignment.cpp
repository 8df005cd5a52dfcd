#include "castor/mapping/people/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::mapping {

std::vector<std::optional<std::size_t>> assign(const CostMatrix& costs) {
  if (costs.empty())
    return {};
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const std::size_t rows = costs.size();
  const std::size_t columns = costs.front().size();
  // A forbidden assignment costs more than all permitted ones together, and so does leaving a row
  // out, in one of the columns behind.
  double forbidden = 1;
  for (const auto& row : costs)
    for (const double x : row)
      if (std::isfinite(x))
        forbidden += x;
  const std::size_t width = columns + rows;
  const auto cost = [&](std::size_t row, std::size_t column) {
    if (column >= columns)
      return forbidden;
    return std::isfinite(costs[row][column]) ? costs[row][column] : 2 * forbidden;
  };
  // Potentials of rows and columns, from 1; row 0 and column 0 are none.
  std::vector<double> row_potential(rows + 1);
  std::vector<double> column_potential(width + 1);
  std::vector<std::size_t> row_of(width + 1);
  for (std::size_t row = 1; row <= rows; ++row) {
    row_of[0] = row;
    std::size_t column = 0;
    std::vector<double> least(width + 1, infinite);
    std::vector<std::size_t> before(width + 1);
    std::vector<bool> done(width + 1);
    do {
      done[column] = true;
      double step = infinite;
      std::size_t next = 0;
      for (std::size_t j = 1; j <= width; ++j) {
        if (done[j])
          continue;
        const double x =
          cost(row_of[column] - 1, j - 1) - row_potential[row_of[column]] - column_potential[j];
        if (x < least[j]) {
          least[j] = x;
          before[j] = column;
        }
        if (least[j] < step) {
          step = least[j];
          next = j;
        }
      }
      for (std::size_t j = 0; j <= width; ++j) {
        if (done[j]) {
          row_potential[row_of[j]] += step;
          column_potential[j] -= step;
        } else {
          least[j] -= step;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    while (column != 0) {
      row_of[column] = row_of[before[column]];
      column = before[column];
    }
  }
  std::vector<std::optional<std::size_t>> result(rows);
  for (std::size_t j = 1; j <= columns; ++j)
    if (row_of[j] != 0 && std::isfinite(costs[row_of[j] - 1][j - 1]))
      result[row_of[j] - 1] = j - 1;
  return result;
}

} // namespace castor::mapping
