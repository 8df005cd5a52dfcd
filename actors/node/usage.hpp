#pragma once

#include "castor/actors/node/part_protocol.hpp"

#include <cstdint>
#include <optional>

#include <sys/types.h>

namespace castor {

/// What this process has taken of its machine so far.
ProcessUsage usage_of_process();

/// How much of a process's memory is resident; nothing if there is no such process.
std::optional<std::uint64_t> resident_bytes(pid_t process);

} // namespace castor
