#pragma once

#include "castor/base/caf.hpp"
#include "castor/wm/journal/journal.hpp"
#include "castor/wm/journal/journal_writer.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::simulation {

/// The disk of a simulated machine. The journals on it outlive the processes of the machine: what
/// was appended stays, what was only handed to the writer is gone with its process.
///
/// As in castor::open_journal, a journal of which acknowledged changes may be missing is that of
/// another incarnation when it is opened again: one that was not `full`, and not closed in order.
class SimulatedDisk {
public:
  /// As castor::open_journal: takes up what the journal holds, and takes it away from whoever
  /// writes it.
  OpenedJournal open(const std::string& subarchitecture, const JournalOptions& options,
                     UnixTime now);

  /// All changes in the journal, the oldest first.
  const std::vector<JournalRecord>& records(const std::string& subarchitecture) const;

private:
  struct File {
    std::vector<JournalRecord> records;
    /// The incarnation of each time it was opened.
    std::vector<std::uint64_t> sessions;
    /// Whether whoever opened it last has closed it, or has had nothing to lose.
    bool is_complete = true;

    std::uint64_t session() const { return sessions.size(); }
  };

  class Journal;

  /// By subarchitecture.
  std::map<std::string, std::shared_ptr<File>> files_;
};

/// To a journal's writer: the working memory that it writes for is known by now.
struct BeginJournal {
  std::shared_ptr<JournalWriterParts> parts;
};

/// castor::journal_writer, made before the working memory that it is for.
caf::behavior simulated_journal_writer(caf::event_based_actor* self);

} // namespace castor::simulation

CASTOR_LOCAL_MESSAGE(castor::simulation::BeginJournal)
