#pragma once

#include "castor/actors/node/part_protocol.hpp"

namespace castor {

/// What this process has taken of its machine so far.
ProcessUsage usage_of_process();

} // namespace castor
