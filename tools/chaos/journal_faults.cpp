#include "castor/tools/chaos/journal_faults.hpp"

#include "castor/actors/node/working_memory_class.hpp"
#include "castor/wm/journal/journal.hpp"
#include "castor/wm/journal/journal_lock.hpp"

#include <stdexcept>

namespace castor::faults {

std::map<std::string, std::filesystem::path>
journals_of(const ArchitectureDescription& architecture) {
  std::map<std::string, std::filesystem::path> result;
  for (auto& x : architecture.subarchitectures)
    if (auto options = WorkingMemoryClass{x.working_memory}.journal_of(x.name);
        options.mode != JournalMode::off)
      result[x.name] = std::filesystem::absolute(options.file);
  return result;
}

std::filesystem::path remove_journal(const std::filesystem::path& journal) {
  if (!std::filesystem::exists(journal))
    throw std::runtime_error("there is no file " + journal.string());
  return move_aside(journal, "removed");
}

JournalClaim claim_journal(const std::filesystem::path& journal,
                           const std::string& subarchitecture) {
  JournalOptions options;
  options.mode = JournalMode::full;
  options.file = journal;
  options.system = "a second system";
  // The system that writes it may let go of it between the two calls, but not each time.
  constexpr int attempts = 3;
  for (int i = 0; i < attempts; ++i) {
    if (!is_locked(journal))
      return {};
    try {
      open_journal(options, subarchitecture).file->close();
    } catch (const JournalOfAnother& e) {
      return {JournalClaim::Kind::refused, e.what()};
    }
  }
  return {JournalClaim::Kind::taken};
}

} // namespace castor::faults
