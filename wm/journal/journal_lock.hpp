#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Exclusive use of a journal by one system, and detection of removed files.
namespace castor {

/// A process that has a journal open for writing.
struct JournalOwner {
  /// Unique name of its system.
  std::string system;
  std::string host;
  std::uint64_t process = 0;

  /// Owner for this process.
  static JournalOwner here(std::string system);
};

/// "system vision-1234-77, process 1234 on robot"
std::string to_string(const JournalOwner& x);

/// The lock of a journal: a file beside it, `NAME.lock`, which is locked (flock) by the writing
/// process and holds its name. The lock ends with the process, also after a crash.
///
/// One system may open its journal again while an earlier process of it still holds the lock, as it
/// does when a working memory is restarted or moves to another node: the process that opened the
/// journal last may write it, which the journal itself enforces. Other systems are refused as long
/// as the holder lives; file systems without locks cannot detect that.
class JournalLock {
public:
  /// Throws JournalOfAnother, which names the holder, if another system holds the lock. With
  /// `returning` (this system has written the journal before), also if another system has written
  /// it since.
  JournalLock(const std::filesystem::path& journal, JournalOwner owner, bool returning);
  JournalLock(const JournalLock&) = delete;
  JournalLock& operator=(const JournalLock&) = delete;
  ~JournalLock();

  /// Tries to take the lock if its earlier holder of the same system has released it since, or if
  /// the lock file was removed; costs two system calls if there is nothing to do. Does not report a
  /// missing folder: JournalFiles and writes do.
  void renew();

  /// Releases the lock and removes its file, at an orderly end.
  void release();

private:
  /// `failed`: the file cannot be opened; errno has the reason.
  enum class Attempt : std::uint8_t { taken, held, unsupported, failed };

  Attempt attempt();
  /// Whether the lock file is still the one that was locked.
  bool is_in_place() const;
  void write_owner() const;
  std::optional<JournalOwner> read_owner() const;
  void close();

  std::filesystem::path file_;
  JournalOwner owner_;
  int descriptor_ = -1;
};

/// The files of a journal, as they were when it was opened.
class JournalFiles {
public:
  /// Watches those of `files` that exist.
  explicit JournalFiles(const std::vector<std::filesystem::path>& files);

  /// Message that names a file that was removed, moved or replaced since; empty if there is none.
  std::string problem() const;

private:
  struct Watched {
    std::filesystem::path path;
    dev_t device;
    ino_t inode;
  };

  std::vector<Watched> watched_;
};

/// Whether a journal is locked by a process now. Throws JournalError if that cannot be determined.
bool is_locked(const std::filesystem::path& journal);

/// Moves the files of a journal to NAME.WHY-1, or the next number that is free. Returns the new
/// path. Throws std::filesystem::filesystem_error.
std::filesystem::path move_aside(const std::filesystem::path& journal, std::string_view why);

} // namespace castor
