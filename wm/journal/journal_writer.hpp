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

/// Message from a working memory to its journal: the changes of one write, in the order of the
/// writes.
struct JournalWrite {
  JournalGroupPtr changes;
  /// Size of their values, in bytes.
  std::size_t bytes = 0;
};

struct JournalWriterParts {
  std::shared_ptr<JournalFile> file;
  JournalMode mode = JournalMode::full;
  /// Limits of a batch of changes that wait to be synced: time, number, and bytes of values.
  std::chrono::milliseconds delay{0};
  std::size_t most_changes = 0;
  std::size_t most_bytes = 0;
  /// The working memory; when it ends, the journal is closed in order.
  caf::strong_actor_ptr owner;
  /// Called with messages about errors after the owner has ended.
  std::function<void(const std::string&)> report = [](const std::string&) {};
};

/// Arguments for `journal_writer`, from a working memory's options.
JournalWriterParts journal_writer_parts(const JournalOptions& options,
                                        std::shared_ptr<JournalFile> file,
                                        caf::strong_actor_ptr owner);

/// Actor that writes a journal. Writes that arrive while one group is being synced form the next
/// group. Receives JournalWrite, and JournalFault for fault injection; sends JournalNews to its
/// owner.
caf::behavior journal_writer(caf::event_based_actor* self, JournalWriterParts parts);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::JournalWrite)
