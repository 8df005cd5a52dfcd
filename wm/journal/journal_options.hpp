#pragma once

#include "castor/wm/journal/journal_mode.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace castor {

/// Extension of journal files.
inline constexpr const char* journal_extension = ".castor-journal";

struct JournalOptions {
  JournalMode mode = JournalMode::off;
  std::filesystem::path file;
  /// `batched`: maximum time from the acknowledgement of a change until it is on disk.
  std::chrono::milliseconds delay{100};
  /// `batched`: maximum number, and bytes of values, of changes that are acknowledged and not on
  /// disk. Beyond that nothing is acknowledged until some are on disk.
  std::size_t most_unsynced = 10'000;
  std::size_t most_unsynced_bytes = std::size_t{64} << 20;
  /// When the journal fails, the working memory goes on without one; otherwise it ends.
  bool go_on_without = false;
  /// Size of the file beyond which the oldest changes are folded into the entries that resulted
  /// from them, in bytes; the present entries may need more.
  std::uint64_t limit_bytes = std::uint64_t{256} << 20;
  /// The file is a recording: nothing is folded.
  bool keep = false;
  /// The file is on network storage, where processes of several machines cannot share memory.
  bool shared = false;
  /// Maximum number of deleted ids whose version is kept.
  std::size_t remembered_deletions = 100'000;
  /// The file is written by a thread of its own, instead of the threads of the actor system.
  bool own_thread = true;
  /// Unique name of the system that writes it; other systems are refused meanwhile.
  std::string system = {};
  /// The system has written it before: opening fails if the file is missing, or another system has
  /// written it since.
  bool returning = false;
  /// SQLite VFS by which the file is accessed; empty for the default.
  std::string vfs = {};
  /// Called with messages about errors.
  std::function<void(const std::string&)> report = [](const std::string&) {};
};

} // namespace castor
