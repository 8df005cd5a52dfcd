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

/// The disk of a simulated machine. The journals on it outlive the processes of the machine:
/// appended changes are kept, changes still queued in the writer are lost with its process.
///
/// As in castor::open_journal, a journal that may lack acknowledged changes (not `full`, and not
/// closed in order) gets a new incarnation when it is opened again.
class SimulatedDisk {
public:
  /// As castor::open_journal: reads the journal, and revokes it from its current writer.
  OpenedJournal open(const std::string& subarchitecture, const JournalOptions& options,
                     UnixTime now);

  /// All changes in the journal, the oldest first.
  const std::vector<JournalRecord>& records(const std::string& subarchitecture) const;

private:
  struct File {
    std::vector<JournalRecord> records;
    /// Incarnation of each session.
    std::vector<std::uint64_t> sessions;
    /// Whether the last session was closed in order, or had nothing to lose.
    bool is_complete = true;

    std::uint64_t session() const { return sessions.size(); }
  };

  class Journal;

  /// By subarchitecture.
  std::map<std::string, std::shared_ptr<File>> files_;
};

/// To a journal's writer: its parts, now that its working memory exists.
struct BeginJournal {
  std::shared_ptr<JournalWriterParts> parts;
};

/// castor::journal_writer, spawned before its working memory exists.
caf::behavior simulated_journal_writer(caf::event_based_actor* self);

} // namespace castor::simulation

CASTOR_LOCAL_MESSAGE(castor::simulation::BeginJournal)
