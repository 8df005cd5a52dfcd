#pragma once

#include "castor/benchmarks/semeval/robot_commands/command_features.hpp"

#include <vector>

namespace castor::semeval {

/// Adds features of a command on the board: the number of referents of each entity, whether the
/// block can be taken, and whether there is room at its destination.
void add_grounding_features(const RclTree& tree, const Board& board,
                            std::vector<CommandFeature>& features);

} // namespace castor::semeval
