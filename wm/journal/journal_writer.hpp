#pragma once

#include "castor/base/caf.hpp"
#include "castor/wm/journal/journal.hpp"
#include "castor/wm/journal/journal_fault.hpp"
#include "castor/wm/journal/journal_news.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace castor {

/// From a working memory to its journal: the changes of a write, in the order of the writes.
struct JournalWrite {
  JournalGroupPtr changes;
  /// What their values take.
  std::size_t bytes = 0;
};

struct JournalWriterParts {
  std::shared_ptr<JournalFile> file;
  JournalMode mode = JournalMode::full;
  /// How long changes may wait for others, and how many, of how many bytes.
  std::chrono::milliseconds delay{0};
  std::size_t most_changes = 0;
  std::size_t most_bytes = 0;
  /// The working memory; when it ends, so does the journal, in order.
  caf::strong_actor_ptr owner;
  /// Is told what goes wrong when nobody hears news any more.
  std::function<void(const std::string&)> report = [](const std::string&) {};
};

/// What the journal of a working memory is written by.
JournalWriterParts journal_writer_parts(const JournalOptions& options,
                                        std::shared_ptr<JournalFile> file,
                                        caf::strong_actor_ptr owner);

/// Writes a journal. What arrives while one group of writes is being synced is the next group.
/// Takes JournalWrite, and JournalFault on purpose; tells its owner JournalNews.
caf::behavior journal_writer(caf::event_based_actor* self, JournalWriterParts parts);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::JournalWrite)
