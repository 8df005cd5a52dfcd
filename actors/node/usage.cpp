#include "castor/actors/node/usage.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace castor {

namespace {

const auto begin = std::chrono::steady_clock::now();

std::chrono::nanoseconds duration(const timeval& x) {
  return std::chrono::seconds{x.tv_sec} + std::chrono::microseconds{x.tv_usec};
}

} // namespace

ProcessUsage usage_of_process() {
  ProcessUsage result;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  result.cpu = duration(usage.ru_utime) + duration(usage.ru_stime);
  result.age = std::chrono::steady_clock::now() - begin;
  std::uint64_t pages = 0;
  std::uint64_t resident = 0;
  if (std::ifstream{"/proc/self/statm"} >> pages >> resident)
    result.memory_bytes = resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return result;
}

} // namespace castor
