#pragma once

#include <cstdint>

#include <sys/types.h>

namespace castor::benchmark {

/// Seconds of processor time that a process has taken, by its clock, which counts nanoseconds and
/// ended threads, too.
double processor_seconds(pid_t process);

/// Memory of a process in bytes: its own, and its share of what it has in common with others (PSS).
double memory_bytes(pid_t process);

} // namespace castor::benchmark
