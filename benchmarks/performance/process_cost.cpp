#include "castor/benchmarks/performance/process_cost.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace castor::benchmark {

namespace {

std::string folder_of(pid_t process) {
  return "/proc/" + std::to_string(process);
}

} // namespace

double processor_seconds(pid_t process) {
  double nanoseconds = 0;
  for (auto& x : std::filesystem::directory_iterator{folder_of(process) + "/task"}) {
    std::ifstream in{x.path() / "schedstat"};
    double on_processor = 0;
    in >> on_processor;
    nanoseconds += on_processor;
  }
  return nanoseconds / 1e9;
}

double memory_bytes(pid_t process) {
  auto file = folder_of(process) + "/smaps_rollup";
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
