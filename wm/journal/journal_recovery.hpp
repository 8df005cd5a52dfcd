#pragma once

#include "castor/wm/journal/journal_lock.hpp"
#include "castor/wm/journal/journal_options.hpp"
#include "castor/wm/journal/journal_tables.hpp"
#include "castor/wm/journal/sqlite.hpp"
#include "castor/wm/store/store_image.hpp"

#include <string>
#include <utility>

namespace castor {

/// Reads a journal and takes it over for this process: begins a new session, and a new incarnation
/// of the working memory if acknowledged writes may have been lost.
class JournalRecovery {
public:
  /// Uses one transaction. Throws JournalError if the journal belongs to another subarchitecture,
  /// JournalCorrupt, DecodeError and sqlite::Error.
  JournalRecovery(sqlite::Database& database, const JournalOptions& options,
                  const std::string& subarchitecture, const JournalOwner& owner, UnixTime now);

  /// State of the journal after recovery.
  const journal_tables::Meta& meta() const { return meta_; }
  const journal_tables::Types& types() const { return types_; }

  /// Content of the working memory.
  StoreImage take_image() { return std::move(image_); }

private:
  void begin_session(sqlite::Database& database, const JournalOptions& options,
                     const JournalOwner& owner, UnixTime now);

  journal_tables::Meta meta_;
  journal_tables::Types types_;
  StoreImage image_;
};

} // namespace castor
