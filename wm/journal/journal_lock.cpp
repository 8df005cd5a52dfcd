#include "castor/wm/journal/journal_lock.hpp"

#include "castor/wm/journal/journal_error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <sstream>
#include <string_view>
#include <thread>
#include <utility>

namespace castor {

namespace {

/// Between locking the file and writing its name into it, the holder takes no longer than this.
constexpr std::chrono::milliseconds time_to_sign{200};
constexpr std::chrono::milliseconds poll_interval{5};

bool is_same_file(int descriptor, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat present {};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &present) == 0 &&
         opened.st_dev == present.st_dev && opened.st_ino == present.st_ino;
}

} // namespace

JournalOwner JournalOwner::here(std::string system) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return {std::move(system), host.data(), static_cast<std::uint64_t>(getpid())};
}

std::string to_string(const JournalOwner& x) {
  return (x.system.empty() ? "" : "system " + x.system + ", ") + "process " +
         std::to_string(x.process) + " on " + x.host;
}

JournalLock::JournalLock(const std::filesystem::path& journal, JournalOwner owner, bool returning)
  : file_(journal.string() + ".lock"), owner_(std::move(owner)) {
  auto refuse = [this](const std::string& who, const char* since) {
    close();
    throw JournalOfAnother(who + since + ". End that system, or give this one a folder of its own");
  };
  auto signed_until = std::chrono::steady_clock::now() + time_to_sign;
  for (;;) {
    // Whoever wrote it last has signed it, also if that one is gone.
    auto last = read_owner();
    auto result = attempt();
    if (result == Attempt::failed)
      throw JournalError("its lock " + file_.string() +
                         " cannot be opened: " + std::strerror(errno));
    bool by_another = last && last->system != owner_.system;
    if (returning && by_another)
      refuse(to_string(*last), " has taken it over");
    if (result != Attempt::held)
      write_owner();
    if (result != Attempt::held || (last && !by_another))
      return;
    if (last)
      refuse(to_string(*last), " writes it");
    if (std::chrono::steady_clock::now() > signed_until)
      refuse("another process", " writes it");
    std::this_thread::sleep_for(poll_interval);
  }
}

JournalLock::~JournalLock() {
  close();
}

void JournalLock::renew() {
  if (is_in_place())
    return;
  close();
  auto result = attempt();
  if (result == Attempt::taken || result == Attempt::unsupported)
    write_owner();
}

void JournalLock::release() {
  // Removed while it is locked, so that nobody locks a file that is about to go; who has opened it
  // meanwhile sees that it is not in its place.
  if (is_in_place())
    unlink(file_.c_str());
  close();
}

/// Opens and locks the file. One that was removed in between counts for nothing; where there are no
/// locks it is open all the same.
JournalLock::Attempt JournalLock::attempt() {
  for (;;) {
    descriptor_ =
      ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
    if (descriptor_ < 0)
      return Attempt::failed;
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK && errno != EINTR)
        return Attempt::unsupported;
      bool held = errno == EWOULDBLOCK;
      close();
      if (held)
        return Attempt::held;
      continue;
    }
    if (is_in_place())
      return Attempt::taken;
    close();
  }
}

bool JournalLock::is_in_place() const {
  return descriptor_ >= 0 && is_same_file(descriptor_, file_);
}

void JournalLock::write_owner() const {
  std::ostringstream text;
  text << owner_.process << ' ' << owner_.host << ' ' << owner_.system << '\n';
  auto line = text.str();
  // Nothing depends on it but what a refusal says, and whether it is one's own.
  if (ftruncate(descriptor_, 0) != 0 ||
      pwrite(descriptor_, line.data(), line.size(), 0) != static_cast<ssize_t>(line.size()))
    throw JournalError("its lock " + file_.string() +
                       " cannot be written: " + std::strerror(errno));
}

std::optional<JournalOwner> JournalLock::read_owner() const {
  int descriptor = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0)
    return std::nullopt;
  std::array<char, 1024> text{};
  auto count = pread(descriptor, text.data(), text.size(), 0);
  ::close(descriptor);
  if (count <= 0 || text[static_cast<std::size_t>(count) - 1] != '\n')
    return std::nullopt;
  std::istringstream words{std::string{text.data(), static_cast<std::size_t>(count) - 1}};
  JournalOwner result;
  if (!(words >> result.process >> result.host))
    return std::nullopt;
  words.get();
  std::getline(words, result.system);
  return result;
}

void JournalLock::close() {
  if (descriptor_ >= 0)
    ::close(std::exchange(descriptor_, -1));
}

JournalFiles::JournalFiles(const std::vector<std::filesystem::path>& files) {
  for (auto& path : files) {
    struct stat state {};
    if (stat(path.c_str(), &state) == 0)
      watched_.push_back({path, state.st_dev, state.st_ino});
  }
}

std::string JournalFiles::problem() const {
  for (auto& x : watched_) {
    struct stat state {};
    if (stat(x.path.c_str(), &state) != 0)
      return x.path.string() + " was removed or moved while it was in use (" +
             std::strerror(errno) + ")";
    if (state.st_dev != x.device || state.st_ino != x.inode)
      return x.path.string() + " was replaced by another file while it was in use";
  }
  return {};
}

bool is_locked(const std::filesystem::path& journal) {
  auto file = journal.string() + ".lock";
  int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0 && errno == ENOENT)
    return false;
  if (descriptor < 0)
    throw JournalError("its lock " + file + " cannot be opened: " + std::strerror(errno));
  bool result = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return result;
}

std::filesystem::path move_aside(const std::filesystem::path& journal, std::string_view why) {
  for (int i = 1;; ++i) {
    auto target = journal;
    target += "." + std::string{why} + "-" + std::to_string(i);
    if (std::filesystem::exists(target) || std::filesystem::exists(target.string() + "-wal"))
      continue;
    for (auto* suffix : {"", "-wal", "-shm"})
      if (std::filesystem::exists(journal.string() + suffix))
        std::filesystem::rename(journal.string() + suffix, target.string() + suffix);
    return target;
  }
}

} // namespace castor
