#pragma once

#include "castor/tools/chaos/temporary_folder.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace castor::faults {

/// Journals as they are now, so that a run that is only made for comparison leaves no trace in
/// them. No process has them open, now and when they are restored.
class JournalSnapshot {
public:
  /// @param journals files by subarchitecture, as of journals_of(); there may be none yet
  /// \throws std::runtime_error if they cannot be copied.
  explicit JournalSnapshot(const std::map<std::string, std::filesystem::path>& journals);

  /// Restores them, as far as that is possible.
  ~JournalSnapshot();

  JournalSnapshot(const JournalSnapshot&) = delete;
  JournalSnapshot& operator=(const JournalSnapshot&) = delete;

private:
  /// Where the copies are.
  std::optional<TemporaryFolder> folder_;
  /// Copies by the files; those that did not exist have none.
  std::map<std::filesystem::path, std::filesystem::path> files_;
};

} // namespace castor::faults
