#include "castor/benchmarks/safety/processor_wait.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace castor::benchmark {

ProcessorWait::Waits ProcessorWait::waits_of(pid_t process) {
  namespace fs = std::filesystem;
  Waits result;
  std::error_code error;
  const auto tasks = fs::path{"/proc"} / std::to_string(process) / "task";
  // Threads, and the process itself, may end meanwhile.
  for (fs::directory_iterator i{tasks, error}, end; !error && i != end; i.increment(error)) {
    std::ifstream in{i->path() / "schedstat"};
    std::int64_t ran = 0;
    std::int64_t waited = 0;
    if (in >> ran >> waited)
      result.emplace(std::stoi(i->path().filename()), waited);
  }
  return result;
}

ProcessorWait::ProcessorWait(std::vector<pid_t> processes) {
  for (const auto x : processes)
    begin_.emplace(x, waits_of(x));
}

std::chrono::nanoseconds ProcessorWait::since() const {
  std::chrono::nanoseconds result{0};
  for (const auto& [process, begin] : begin_) {
    std::chrono::nanoseconds longest{0};
    for (const auto& [thread, waited] : waits_of(process)) {
      const auto i = begin.find(thread);
      longest = std::max(longest, waited - (i == begin.end() ? Waits::mapped_type{} : i->second));
    }
    result += longest;
  }
  return result;
}

} // namespace castor::benchmark
