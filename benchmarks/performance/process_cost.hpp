#pragma once

#include <cstdint>

#include <sys/types.h>

namespace castor::benchmark {

/// Seconds of processor time that the threads of a process have taken, as the kernel counts them in
/// nanoseconds (/proc/PID/task/TID/schedstat). Those of ended threads are not in it.
double processor_seconds(pid_t process);

/// Memory of a process in bytes: its own, and its share of what it has in common with others (PSS).
double memory_bytes(pid_t process);

} // namespace castor::benchmark
