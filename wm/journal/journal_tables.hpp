#pragma once

#include "castor/wm/journal/journal_image.hpp"
#include "castor/wm/journal/journal_record.hpp"
#include "castor/wm/journal/sqlite.hpp"
#include "castor/wm/values/crc32.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

/// Tables of a journal's file. Every row has a checksum of its content.
namespace castor::journal_tables {

inline constexpr std::int64_t application_id = 0x4A575343; // "CSWJ"
inline constexpr std::int64_t format_version = 1;

/// Tables and indices of an empty file.
extern const char* const schema;

/// The one row of `meta`: the state of the journal. It is written with every transaction, so that
/// missing rows are detected.
struct Meta {
  std::string subarchitecture;
  /// Number of times the journal was opened for writing; only the last session may write it.
  std::uint64_t session = 0;
  std::uint64_t incarnation = 0;
  /// Sequence numbers of the last change, and of the last that was folded into `entries` and
  /// `deleted`.
  std::uint64_t last = 0;
  std::uint64_t folded = 0;
  Version floor = 0;
  std::uint64_t entries = 0;
  std::uint64_t deleted = 0;
  /// Sums of the checksums of the rows of `entries` and `deleted`.
  std::uint64_t entries_sum = 0;
  std::uint64_t deleted_sum = 0;
  /// Whether every acknowledged change is in the journal.
  bool lossless = true;
  /// Whether the last session ended in order.
  bool clean = true;

  std::uint32_t checksum() const;
};

/// One session of the working memory.
struct Session {
  std::uint64_t number = 0;
  /// Time at which the journal was opened.
  UnixTime opened{0};
  std::string host;
  std::uint64_t process = 0;
  std::uint64_t mode = 0;
  /// Sequence number of the last change before this session.
  std::uint64_t before = 0;
  std::uint64_t incarnation = 0;

  std::uint32_t checksum() const;
};

using Sessions = std::map<std::uint64_t, Session>;
using Types = std::map<std::uint64_t, TypeDescriptorPtr>;

/// Writes the row of `meta`; to be called in every transaction.
class MetaWriter {
public:
  explicit MetaWriter(sqlite::Database& database);

  void write(const Meta& x);

private:
  sqlite::Statement update_;
};

/// Throws JournalCorrupt.
Meta read_meta(sqlite::Database& database);
Sessions read_sessions(sqlite::Database& database);
Types read_types(sqlite::Database& database);

/// The folded entries: the state before the first change of `log`. Throws JournalCorrupt.
JournalImage read_folded(sqlite::Database& database, const Meta& meta, const Types& types,
                         std::size_t remembered_deletions);

/// The columns of `log` and `entries`, in their order; `checksum` follows them.
inline constexpr const char* record_columns =
  "sequence, write, session, time, operation, id, type, version, source, time_to_live, life, "
  "changed, value";

/// Reads a row of `log` or `entries` with the columns above and the checksum, and checks it. Throws
/// JournalCorrupt.
JournalRecord read_record(sqlite::Statement& row, const Types& types, std::uint32_t* checksum);

/// The changes of `log`, one after the other.
class LogRows {
public:
  LogRows(sqlite::Database& database, const Meta& meta, const Sessions& sessions,
          const Types& types);

  /// The next change; nothing after the last. Throws JournalCorrupt, also if a change is missing.
  std::optional<JournalRecord> next();

private:
  const Meta& meta_;
  const Sessions& sessions_;
  const Types& types_;
  sqlite::Statement rows_;
  std::uint64_t last_;
  std::uint64_t session_ = 0;
  bool over_ = false;
};

std::uint32_t checksum(const JournalRecord& x, std::uint64_t type);
std::uint32_t checksum(const std::string& id, Version version, std::uint64_t sequence);
std::uint32_t checksum(std::uint64_t number, std::span<const std::uint8_t> descriptor);

/// Encoded flags of an entry's life.
std::uint64_t flags_of(const EntryLife& x);

/// Throws JournalError if the file is not a journal, or is of another version.
void check_format(sqlite::Database& database);

/// Throws JournalCorrupt if the file's own structure is damaged.
void check_structure(sqlite::Database& database);

} // namespace castor::journal_tables
