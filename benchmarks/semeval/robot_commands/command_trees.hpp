#pragma once

#include "castor/benchmarks/semeval/robot_commands/rcl_tree.hpp"
#include "castor/communication/types.hpp"

#include <vector>

namespace castor::semeval {

/// The RCL trees that a meaning may stand for: more than one if "one" may refer to several
/// entities. Leaves have the index of their first word.
std::vector<RclTree> command_trees(const communication::LogicalForm& form);

} // namespace castor::semeval
