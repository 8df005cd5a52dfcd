#include "castor/wm/journal/journal.hpp"

#include "castor/wm/journal/journal_lock.hpp"
#include "castor/wm/journal/sqlite_journal.hpp"

#include <memory>
#include <utility>

namespace castor {

namespace {

OpenedJournal take_up(const JournalOptions& options, const std::string& subarchitecture) {
  auto journal = std::make_shared<SqliteJournal>(options, subarchitecture);
  auto result = journal->take_opened();
  result.file = std::move(journal);
  return result;
}

} // namespace

OpenedJournal open_journal(const JournalOptions& options, const std::string& subarchitecture) {
  if (!options.go_on_without)
    return take_up(options, subarchitecture);
  try {
    try {
      return take_up(options, subarchitecture);
    } catch (const JournalCorrupt& e) {
      auto aside = move_aside(options.file, "corrupt");
      options.report(std::string{e.what()} + ". It was moved to " + aside.string() + ", and " +
                     subarchitecture + " begins without entries");
      return take_up(options, subarchitecture);
    }
  } catch (const std::runtime_error& e) {
    options.report(std::string{e.what()} + ". " + subarchitecture + " goes on without a journal");
    OpenedJournal result;
    result.failure = e.what();
    return result;
  }
}

} // namespace castor
