#pragma once

#include "castor/wm/journal/journal_mode.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace castor {

/// What the names of journals' files end with.
inline constexpr const char* journal_extension = ".castor-journal";

struct JournalOptions {
  JournalMode mode = JournalMode::off;
  std::filesystem::path file;
  /// `batched`: how long a change may be acknowledged and not on disk.
  std::chrono::milliseconds delay{100};
  /// `batched`: how many changes, and how many bytes of values, may be. Beyond that nothing is
  /// acknowledged until some are on disk.
  std::size_t most_unsynced = 10'000;
  std::size_t most_unsynced_bytes = std::size_t{64} << 20;
  /// What to do when the journal fails: go on without one, or end.
  bool go_on_without = false;
  /// What the file may grow to before the oldest changes are folded into the entries that they
  /// led to; what the present entries take is needed in any case.
  std::uint64_t limit_bytes = std::uint64_t{256} << 20;
  /// The file is a recording: nothing is folded.
  bool keep = false;
  /// The file lies on a network's storage, where processes of several machines cannot share memory.
  bool shared = false;
  /// How many deleted ids keep their version.
  std::size_t remembered_deletions = 100'000;
  /// On a thread of its own; without, whoever runs actors writes the file.
  bool own_thread = true;
  /// The name of the system that writes it, which differs from those of all others: no other system
  /// is given the journal meanwhile.
  std::string system = {};
  /// The system has written it before, so it has to be there, and nobody else may have had it
  /// since.
  bool returning = false;
  /// The way to the file, for SQLite (its VFS); empty for the usual one.
  std::string vfs = {};
  /// Is told what goes wrong.
  std::function<void(const std::string&)> report = [](const std::string&) {};
};

} // namespace castor
