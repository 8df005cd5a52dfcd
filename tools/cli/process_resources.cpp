#include "castor/tools/cli/process_resources.hpp"

#include "castor/actors/node/usage.hpp"

#include <filesystem>
#include <system_error>

namespace castor::cli {

namespace {

using Clock = std::chrono::steady_clock;

std::optional<std::uint64_t> count_in(const std::filesystem::path& folder) {
  std::error_code error;
  std::uint64_t result = 0;
  for (std::filesystem::directory_iterator i{folder, error}, end; !error && i != end;
       i.increment(error))
    ++result;
  return error ? std::nullopt : std::optional{result};
}

} // namespace

std::optional<faults::ResourceSample> sample_of(pid_t process) {
  std::filesystem::path folder{"/proc/" + std::to_string(process)};
  faults::ResourceSample result;
  auto memory = resident_bytes(process);
  auto files = count_in(folder / "fd");
  auto threads = count_in(folder / "task");
  if (!memory || !files || !threads)
    return std::nullopt;
  result.memory = *memory;
  result.files = *files;
  result.threads = *threads;
  return result;
}

ResourceWatch::ResourceWatch(std::function<std::map<std::string, pid_t>()> processes)
  : processes_(std::move(processes)), thread_([this] { watch(); }) {}

ResourceWatch::~ResourceWatch() {
  stop();
}

void ResourceWatch::watch() {
  std::unique_lock guard{mutex_};
  while (!over_) {
    for (auto& [name, id] : processes_())
      if (auto sample = sample_of(id)) {
        sample->at = std::chrono::duration_cast<Timestamp>(Clock::now() - begin_);
        samples_[{name, id}].push_back(*sample);
      }
    changed_.wait_for(guard, std::chrono::milliseconds{500}, [this] { return over_; });
  }
}

std::vector<faults::ProcessResources> ResourceWatch::stop() {
  {
    std::lock_guard guard{mutex_};
    over_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable())
    thread_.join();
  std::vector<faults::ProcessResources> result;
  for (auto& [who, samples] : samples_)
    result.push_back({who.first, samples, who.second});
  return result;
}

} // namespace castor::cli
