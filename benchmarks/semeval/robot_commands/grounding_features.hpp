#pragma once

#include "castor/benchmarks/semeval/robot_commands/command_features.hpp"

#include <vector>

namespace castor::semeval {

/// Adds what the board says of a command: how many things each entity may be, whether what is taken
/// can be, and whether there is room where it is to be put.
void add_grounding_features(const RclTree& tree, const Board& board,
                            std::vector<CommandFeature>& features);

} // namespace castor::semeval
