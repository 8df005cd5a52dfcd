#include "castor/tools/chaos/descriptor_shortages.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace castor::faults {

namespace {

/// A limit below this could be less than what one poll() asks about, which would be refused.
constexpr rlim_t least_limit = 16;

std::set<rlim_t> open_descriptors(pid_t process) {
  std::set<rlim_t> result;
  std::filesystem::path folder = "/proc/" + std::to_string(process) + "/fd";
  for (auto& x : std::filesystem::directory_iterator{folder})
    result.insert(std::stoul(x.path().filename().string()));
  return result;
}

/// Descriptors are given out from the lowest number on that is free.
rlim_t lowest_free(const std::set<rlim_t>& open) {
  auto result = least_limit;
  while (open.contains(result))
    ++result;
  return result;
}

void set_limit(pid_t process, const rlimit& x) {
  if (prlimit(process, RLIMIT_NOFILE, &x, nullptr) != 0)
    throw std::system_error(errno, std::generic_category(),
                            "cannot limit the file descriptors of process " +
                              std::to_string(process));
}

rlimit limit_of(pid_t process) {
  rlimit result{};
  if (prlimit(process, RLIMIT_NOFILE, nullptr, &result) != 0)
    throw std::system_error(errno, std::generic_category(),
                            "cannot tell how many file descriptors process " +
                              std::to_string(process) + " may have");
  return result;
}

} // namespace

DescriptorShortages::~DescriptorShortages() {
  std::lock_guard guard{mutex_};
  end_now(getpid());
}

void DescriptorShortages::begin(pid_t process) {
  std::lock_guard guard{mutex_};
  if (auto i = shortages_.find(process); i != shortages_.end()) {
    ++i->second.begun;
    return;
  }
  Shortage x{limit_of(process), 1, {}};
  auto during = x.before;
  auto open = open_descriptors(process);
  if (process != getpid()) {
    during.rlim_cur = std::min(during.rlim_cur, lowest_free(open));
    set_limit(process, during);
  } else {
    // Here the numbers in between can be taken, too.
    during.rlim_cur = std::min(during.rlim_cur, std::max(least_limit, *open.rbegin() + 1));
    set_limit(process, during);
    own_before_ = x.before;
    own_during_ = during.rlim_cur;
    for (int descriptor = 0; (descriptor = ::open("/dev/null", O_RDONLY | O_CLOEXEC)) >= 0;)
      x.taken.push_back(descriptor);
  }
  shortages_.emplace(process, std::move(x));
}

void DescriptorShortages::end(pid_t process) {
  std::lock_guard guard{mutex_};
  if (auto i = shortages_.find(process); i != shortages_.end() && --i->second.begun == 0)
    end_now(process);
}

void DescriptorShortages::end_now(pid_t process) {
  auto x = shortages_.extract(process);
  if (!x)
    return;
  for (auto descriptor : x.mapped().taken)
    close(descriptor);
  // Fails if it has ended.
  prlimit(process, RLIMIT_NOFILE, &x.mapped().before, nullptr);
}

void DescriptorShortages::forget(pid_t process) {
  std::lock_guard guard{mutex_};
  shortages_.erase(process);
}

void DescriptorShortages::raise_inherited(pid_t child) {
  std::lock_guard guard{mutex_};
  rlimit present{};
  // Fails if it has ended.
  if (own_during_ && !shortages_.contains(child) &&
      prlimit(child, RLIMIT_NOFILE, nullptr, &present) == 0 && present.rlim_cur == *own_during_)
    prlimit(child, RLIMIT_NOFILE, &own_before_, nullptr);
}

} // namespace castor::faults
