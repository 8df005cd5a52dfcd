#include "castor/actors/node/usage.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

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
  result.memory_bytes = resident_bytes(getpid()).value_or(0);
  return result;
}

std::optional<std::uint64_t> resident_bytes(pid_t process) {
  std::uint64_t pages = 0;
  std::uint64_t resident = 0;
  if (!(std::ifstream{"/proc/" + std::to_string(process) + "/statm"} >> pages >> resident))
    return std::nullopt;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

} // namespace castor
