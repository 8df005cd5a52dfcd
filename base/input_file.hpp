#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

/// Input files, opened without blocking: opening a named pipe would wait for its writer, reading a
/// terminal for its user, and neither could be interrupted when the system stops. All files are
/// read with these functions, or by a library after `require_input_file`. Header only, because the
/// libraries that use it have no common dependency.
namespace castor {

/// A file cannot be read as input. `what()` is the reason, without the path: "there is no such
/// file", "it is a named pipe, not a regular file".
class InputFileError : public std::runtime_error {
public:
  enum class Reason : std::uint8_t { missing, folder, special, unreadable, too_long };

  InputFileError(Reason reason, const std::string& what)
    : std::runtime_error(what), reason_(reason) {}

  Reason reason() const { return reason_; }

private:
  Reason reason_;
};

/// A regular file that is open for reading. Never blocks, other than for the disk.
class InputFile {
public:
  /// Throws InputFileError. Links are followed.
  explicit InputFile(const std::filesystem::path& file) {
    struct stat status {};
    // Checked before opening, because opening a device or a pipe may have side effects.
    if (::stat(file.c_str(), &status) == 0)
      require_regular(status);
    // Non-blocking nevertheless: the path may have been replaced since the check.
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor_ < 0 && (errno == ENOENT || errno == ENOTDIR))
      throw InputFileError(InputFileError::Reason::missing, "there is no such file");
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0)
      fail(errno);
    try {
      require_regular(status);
    } catch (const InputFileError&) {
      ::close(descriptor_);
      throw;
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
  }
  InputFile(InputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}
  InputFile& operator=(InputFile&&) = delete;
  ~InputFile() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }

  /// Size when it was opened, in bytes.
  std::uint64_t size() const { return size_; }

  /// Reads the next `most` bytes: fewer only at the end of the file. Throws InputFileError.
  std::string read(std::size_t most) const {
    constexpr std::size_t chunk = std::size_t{64} << 10;
    std::string result;
    while (result.size() < most) {
      auto before = result.size();
      result.resize(before + std::min(chunk, most - before));
      auto got = ::read(descriptor_, result.data() + before, result.size() - before);
      auto error = errno;
      result.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
      if (got == 0)
        break;
      if (got < 0 && error != EINTR)
        throw InputFileError(InputFileError::Reason::unreadable, message(error));
    }
    return result;
  }

private:
  static std::string message(int error) { return std::generic_category().message(error); }

  [[noreturn]] void fail(int error) {
    if (descriptor_ >= 0)
      ::close(descriptor_);
    throw InputFileError(InputFileError::Reason::unreadable, message(error));
  }

  static void require_regular(const struct stat& status) {
    if (S_ISREG(status.st_mode))
      return;
    if (S_ISDIR(status.st_mode))
      throw InputFileError(InputFileError::Reason::folder, "it is a directory");
    const char* kind = S_ISFIFO(status.st_mode)   ? "a named pipe"
                       : S_ISCHR(status.st_mode)  ? "a character device"
                       : S_ISBLK(status.st_mode)  ? "a block device"
                       : S_ISSOCK(status.st_mode) ? "a socket"
                                                  : "something else";
    throw InputFileError(InputFileError::Reason::special,
                         std::string{"it is "} + kind + ", not a regular file");
  }

  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Reads a whole file. Throws InputFileError, also if it has more than `most` bytes.
inline std::string read_input_file(const std::filesystem::path& path,
                                   std::size_t most = std::numeric_limits<std::size_t>::max() - 1) {
  auto result = InputFile{path}.read(most + 1);
  if (result.size() > most)
    throw InputFileError(InputFileError::Reason::too_long,
                         "it is longer than " + std::to_string(most) + " bytes");
  return result;
}

/// Check before a library opens a file by its path. Throws InputFileError if it is not a readable
/// regular file.
inline void require_input_file(const std::filesystem::path& path) {
  InputFile{path};
}

} // namespace castor
