#pragma once

#include "castor/benchmarks/semeval/robot_commands/grounding.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace castor::semeval {

std::uint64_t cell(int x, int y);

/// The middle of the cells of a referent.
struct BoardPoint {
  double x = 0;
  double y = 0;
};
BoardPoint middle(const Referent& referent);

/// The parts of a board of an RCL type (corner, edge, region, board, tile, robot) that have all of
/// these indicators (left, right, front, back, center).
std::vector<Referent> places(std::string_view type,
                             const std::vector<std::string_view>& indicators);

bool is_place(std::string_view type);

} // namespace castor::semeval
