#include "castor/tools/chaos/journal_snapshot.hpp"

#include <system_error>

namespace castor::faults {

JournalSnapshot::JournalSnapshot(const std::map<std::string, std::filesystem::path>& journals) {
  if (journals.empty())
    return;
  folder_.emplace("journals");
  for (auto& [subarchitecture, journal] : journals)
    for (auto* suffix : {"", "-wal", "-shm"}) {
      const std::filesystem::path file = journal.string() + suffix;
      std::filesystem::path copy;
      if (std::filesystem::exists(file)) {
        copy = folder_->path() / std::to_string(files_.size());
        std::filesystem::copy_file(file, copy);
      }
      files_[file] = copy;
    }
}

JournalSnapshot::~JournalSnapshot() {
  std::error_code error;
  for (auto& [file, copy] : files_) {
    std::filesystem::remove(file, error);
    if (!copy.empty())
      std::filesystem::copy_file(copy, file, error);
  }
}

} // namespace castor::faults
