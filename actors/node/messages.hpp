#pragma once

#include "castor/actors/link/wire_table.hpp"

namespace castor {

/// All messages that the processes of a system send each other.
const WireTable& system_messages();

} // namespace castor
