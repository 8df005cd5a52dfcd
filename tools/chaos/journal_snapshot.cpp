#include "castor/tools/chaos/journal_snapshot.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace castor::faults {

JournalSnapshot::JournalSnapshot(const std::map<std::string, std::filesystem::path>& journals) {
  if (journals.empty())
    return;
  auto name = (std::filesystem::temp_directory_path() / "castor-journals-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw std::runtime_error("cannot make the folder " + name + ": " + std::strerror(errno) +
                             "; give the variable TMPDIR a folder that you may write to");
  folder_ = name;
  for (auto& [subarchitecture, journal] : journals)
    for (auto* suffix : {"", "-wal", "-shm"}) {
      const std::filesystem::path file = journal.string() + suffix;
      std::filesystem::path copy;
      if (std::filesystem::exists(file)) {
        copy = folder_ / std::to_string(files_.size());
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
  if (!folder_.empty())
    std::filesystem::remove_all(folder_, error);
}

} // namespace castor::faults
