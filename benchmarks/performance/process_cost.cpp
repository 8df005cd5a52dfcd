#include "castor/benchmarks/performance/process_cost.hpp"

#include <time.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace castor::benchmark {

double processor_seconds(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0)
    throw std::runtime_error("there is no process " + std::to_string(process));
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
}

double memory_bytes(pid_t process) {
  auto file = "/proc/" + std::to_string(process) + "/smaps_rollup";
  std::ifstream in{file};
  for (std::string word; in >> word;)
    if (word == "Pss:") {
      double kilobytes = 0;
      in >> kilobytes;
      return kilobytes * 1024;
    }
  throw std::runtime_error("there is no Pss in " + file);
}

} // namespace castor::benchmark
