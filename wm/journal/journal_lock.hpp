#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What keeps a journal to one system, and notices that its files are not there any more.
namespace castor {

/// A process that has a journal open for writing.
struct JournalOwner {
  /// The name of its system, which differs from those of all other systems.
  std::string system;
  std::string host;
  std::uint64_t process = 0;

  /// Of this process.
  static JournalOwner here(std::string system);
};

/// "system vision-1234-77, process 1234 on robot"
std::string to_string(const JournalOwner& x);

/// The lock of a journal: a file beside it, `NAME.lock`, which the writing process keeps locked
/// (flock) and which names it. The lock ends with the process, however that ends.
///
/// One system may open its journal again while its earlier holder still has the lock, as it does
/// when a working memory is started again or moves to another node: whoever opened the journal
/// last writes it, which the journal itself sees to. Other systems are refused as long as the
/// holder lives, which file systems without locks cannot tell.
class JournalLock {
public:
  /// Throws JournalOfAnother, which names the holder, if another system holds it. With `returning`,
  /// this system has written the journal before: it is refused, too, if another system has written
  /// it since.
  JournalLock(const std::filesystem::path& journal, JournalOwner owner, bool returning);
  JournalLock(const JournalLock&) = delete;
  JournalLock& operator=(const JournalLock&) = delete;
  ~JournalLock();

  /// Tries to take what its predecessor of the same system has let go of since, or what somebody
  /// removed; costs two system calls if there is nothing to do. Whether there is still a folder for
  /// it is for others to find out.
  void renew();

  /// Lets go of it and removes the file: the end is an orderly one.
  void release();

private:
  /// `failed`: the file cannot be opened, as errno says.
  enum class Attempt : std::uint8_t { taken, held, unsupported, failed };

  Attempt attempt();
  /// Whether the lock file is still that which was locked.
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
  /// Those of these that exist are watched.
  explicit JournalFiles(const std::vector<std::filesystem::path>& files);

  /// Which of them was removed, moved or replaced since; empty if none was.
  std::string problem() const;

private:
  struct Watched {
    std::filesystem::path path;
    dev_t device;
    ino_t inode;
  };

  std::vector<Watched> watched_;
};

/// Whether somebody keeps a journal locked now. Throws JournalError if that cannot be found out.
bool is_locked(const std::filesystem::path& journal);

/// Moves the files of a journal out of the way, to NAME.WHY-1, or the next number that is free.
/// Returns where it is now. Throws std::filesystem::filesystem_error.
std::filesystem::path move_aside(const std::filesystem::path& journal, std::string_view why);

} // namespace castor
