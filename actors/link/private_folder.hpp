#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

/// Folders that only their user can access, for the sockets of this user's processes.
namespace castor {

/// Why others could reach or replace what is in a folder, and what to do about it; empty if only
/// the user of this process can.
std::string why_not_private(const std::filesystem::path& folder);

/// The folder with the sockets of this user's systems: `castor` in XDG_RUNTIME_DIR if that is a
/// folder of this user, otherwise /tmp/castor-UID. Is made if there is none. Throws
/// std::runtime_error, with what to do, if it is not private.
std::filesystem::path runtime_folder();

/// The folder with the sockets of this user's nodes, which outlives the sessions of the user:
/// /tmp/castor-UID, and only if that is taken by somebody else, runtime_folder(). Throws
/// std::runtime_error, with what to do.
std::filesystem::path nodes_folder();

/// Those of both that exist and are private.
std::vector<std::filesystem::path> private_folders();

/// Keeps other processes of this user from making and sweeping sockets in a folder meanwhile. Waits
/// for `patience` at most, so that a process that hangs does not block the others.
class FolderLock {
public:
  explicit FolderLock(const std::filesystem::path& folder, std::chrono::milliseconds patience);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

  bool is_held() const { return held_; }

private:
  int fd_;
  bool held_ = false;
};

/// Removes what killed processes left in a folder: sockets at which nobody listens, and folders of
/// runs (RunFolder) whose process is gone.
void sweep(const std::filesystem::path& folder);

/// A folder for the sockets of one run: private, with a short path, removed with this object, and
/// otherwise by the next sweep after the end of its process.
class RunFolder {
public:
  /// Throws std::runtime_error.
  RunFolder() : RunFolder(runtime_folder()) {}
  explicit RunFolder(const std::filesystem::path& in);
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  ~RunFolder();

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  /// Holds a lock, by which others see that the process lives.
  int lock_ = -1;
};

} // namespace castor
