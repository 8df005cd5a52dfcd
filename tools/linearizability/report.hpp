#pragma once

#include "castor/tools/linearizability/entry_search.hpp"

#include <span>
#include <string>

namespace castor::linearizability {

/// Lines of text: a partial order of the operations on an entry, the resulting state of the entry,
/// and the operations one of which had to come next.
std::string report(std::span<const OperationRecord> operations, std::span<const Placement> order);

} // namespace castor::linearizability
