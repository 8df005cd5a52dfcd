#include "castor/actors/link/private_folder.hpp"

#include "castor/actors/link/local_socket.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace castor {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* run_prefix = "links-";
constexpr const char* lock_name = "lock";
/// What is put into the folders has short names, and has to fit into a socket's path.
constexpr std::size_t longest_folder = 80;

/// Whether others can put something else in the place of what is in a folder.
bool others_can_replace_in(const fs::path& folder) {
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0)
    return true;
  bool others_write = (status.st_mode & 022) != 0 && (status.st_mode & S_ISVTX) == 0;
  return others_write || (status.st_uid != geteuid() && status.st_uid != 0);
}

fs::path folder_in_tmp() {
  return fs::path{"/tmp"} / ("castor-" + std::to_string(geteuid()));
}

/// A folder of another user, such as that of whoever became root, is as none.
fs::path folder_of_environment() {
  auto* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code error;
  if (!runtime || !fs::is_directory(runtime, error) || others_can_replace_in(runtime))
    return {};
  auto result = fs::path{runtime} / "castor";
  return result.string().size() > longest_folder ? fs::path{} : result;
}

void make(const fs::path& folder) {
  mkdir(folder.c_str(), 0700);
  if (auto problem = why_not_private(folder); !problem.empty())
    throw std::runtime_error(problem);
}

int lock_file_of(const fs::path& run_folder, int flags) {
  return open((run_folder / lock_name).c_str(), flags | O_CLOEXEC | O_NOFOLLOW, 0600);
}

/// Whether the process that made the folder of a run is gone.
bool is_left_behind(const fs::path& run_folder) {
  int lock = lock_file_of(run_folder, O_RDWR);
  if (lock < 0)
    return errno == ENOENT;
  bool result = flock(lock, LOCK_EX | LOCK_NB) == 0;
  close(lock);
  return result;
}

} // namespace

std::string why_not_private(const fs::path& folder) {
  struct stat status {};
  if (lstat(folder.c_str(), &status) != 0)
    return folder.string() + " cannot be made: " + std::strerror(errno) +
           "; set XDG_RUNTIME_DIR to a folder of your own";
  if (!S_ISDIR(status.st_mode))
    return folder.string() + " is no folder: remove it, or set XDG_RUNTIME_DIR to a folder of your "
                             "own";
  if (status.st_uid != geteuid())
    return folder.string() + " belongs to " + user_called(status.st_uid) +
           ": set XDG_RUNTIME_DIR to a folder of your own, or have it removed";
  if ((status.st_mode & 077) != 0)
    return folder.string() + " is open to others: remove it, or run chmod 700 " + folder.string();
  if (others_can_replace_in(folder.parent_path()))
    return "others may write to " + folder.parent_path().string() +
           ", so what is in it may be replaced: set XDG_RUNTIME_DIR to a folder of your own";
  return {};
}

fs::path runtime_folder() {
  auto result = folder_of_environment();
  if (result.empty())
    result = folder_in_tmp();
  make(result);
  return result;
}

fs::path nodes_folder() {
  auto result = folder_in_tmp();
  mkdir(result.c_str(), 0700);
  return why_not_private(result).empty() ? result : runtime_folder();
}

std::vector<fs::path> private_folders() {
  std::vector<fs::path> result;
  for (auto& x : {folder_in_tmp(), folder_of_environment()})
    if (!x.empty() && why_not_private(x).empty())
      result.push_back(x);
  return result;
}

FolderLock::FolderLock(const fs::path& folder, std::chrono::milliseconds patience)
  : fd_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)) {
  auto until = std::chrono::steady_clock::now() + patience;
  while (fd_ >= 0 && !(held_ = flock(fd_, LOCK_EX | LOCK_NB) == 0) &&
         std::chrono::steady_clock::now() < until)
    poll(nullptr, 0, 2);
}

FolderLock::~FolderLock() {
  if (fd_ >= 0)
    close(fd_);
}

void sweep(const fs::path& folder) {
  const FolderLock lock{folder, 200ms};
  if (!lock.is_held())
    return;
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator i{folder, error}, end; !error && i != end; i.increment(error)) {
    auto& x = i->path();
    std::error_code unknown;
    auto type = i->symlink_status(unknown).type();
    if (type == fs::file_type::socket
          ? is_abandoned(x)
          : type == fs::file_type::directory && x.filename().string().starts_with(run_prefix) &&
              is_left_behind(x))
      left.push_back(x);
  }
  for (auto& x : left)
    fs::remove_all(x, error);
}

RunFolder::RunFolder(const fs::path& in) {
  sweep(in);
  const FolderLock lock{in, 2s};
  auto text = (in / (std::string{run_prefix} + "XXXXXX")).string();
  if (!mkdtemp(text.data()))
    throw std::runtime_error("cannot make a folder in " + in.string() + ": " +
                             std::strerror(errno));
  path_ = text;
  lock_ = lock_file_of(path_, O_RDWR | O_CREAT | O_EXCL);
  if (lock_ < 0 || flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    std::string problem = std::strerror(errno);
    if (lock_ >= 0)
      close(lock_);
    std::error_code error;
    fs::remove_all(path_, error);
    throw std::runtime_error("cannot lock the folder " + path_.string() + ": " + problem);
  }
}

RunFolder::~RunFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
  close(lock_);
}

} // namespace castor
