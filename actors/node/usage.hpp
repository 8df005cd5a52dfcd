#pragma once

#include "castor/actors/node/part_protocol.hpp"

#include <cstdint>
#include <optional>

#include <sys/types.h>

namespace castor {

/// Resource usage of this process so far.
ProcessUsage usage_of_process();

/// Resident memory of a process in bytes; nothing if there is no such process.
std::optional<std::uint64_t> resident_bytes(pid_t process);

} // namespace castor
