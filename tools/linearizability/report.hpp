#pragma once

#include "castor/tools/linearizability/entry_search.hpp"

#include <span>
#include <string>

namespace castor::linearizability {

/// Lines of text: an order of some of the operations on an entry, how the entry then stands, and
/// the operations one of which had to come next.
std::string report(std::span<const OperationRecord> operations, std::span<const Placement> order);

} // namespace castor::linearizability
