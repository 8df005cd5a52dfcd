#pragma once

#include "castor/tools/linearizability/history.hpp"

#include <span>

namespace castor::linearizability {

/// Whether a tiny history of one entry is linearizable, found out by trying every order of every
/// arrival and every giving up, with nothing cut off and nothing remembered.
bool linearizable_by_brute_force(std::span<const OperationRecord> operations);

} // namespace castor::linearizability
