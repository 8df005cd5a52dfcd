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

/// How a journal stands in its file. Every row carries a checksum of what it says.
namespace castor::journal_tables {

inline constexpr std::int64_t application_id = 0x4A575343; // "CSWJ"
inline constexpr std::int64_t format_version = 1;

/// Tables and indices of an empty file.
extern const char* const schema;

/// The one row that tells how things stand. It is written with every transaction, so that rows that
/// are missing are missed.
struct Meta {
  std::string subarchitecture;
  /// How often the journal was opened for writing; who opened it last may write it.
  std::uint64_t session = 0;
  std::uint64_t incarnation = 0;
  /// The last change, and the last that was folded into `entries` and `deleted`.
  std::uint64_t last = 0;
  std::uint64_t folded = 0;
  Version floor = 0;
  std::uint64_t entries = 0;
  std::uint64_t deleted = 0;
  /// Of the checksums of their rows.
  std::uint64_t entries_sum = 0;
  std::uint64_t deleted_sum = 0;
  /// Whether everything that is acknowledged is here.
  bool lossless = true;
  /// Whether the last session ended in order.
  bool clean = true;

  std::uint32_t checksum() const;
};

/// One of the working memory's lives.
struct Session {
  std::uint64_t number = 0;
  /// When its journal was opened.
  UnixTime opened{0};
  std::string host;
  std::uint64_t process = 0;
  std::uint64_t mode = 0;
  /// The number of the change before its first.
  std::uint64_t before = 0;
  std::uint64_t incarnation = 0;

  std::uint32_t checksum() const;
};

using Sessions = std::map<std::uint64_t, Session>;
using Types = std::map<std::uint64_t, TypeDescriptorPtr>;

/// Writes the row of `meta`, as a part of every transaction.
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

/// What was folded: the entries before the first change of `log`. Throws JournalCorrupt.
JournalImage read_folded(sqlite::Database& database, const Meta& meta, const Types& types,
                         std::size_t remembered_deletions);

/// The columns of `log` and `entries`, in their order; `checksum` stands after them.
inline constexpr const char* record_columns =
  "sequence, write, session, time, operation, id, type, version, source, time_to_live, life, "
  "changed, value";

/// A row of `log` or `entries` with the columns above and the checksum, which is checked. Throws
/// JournalCorrupt.
JournalRecord read_record(sqlite::Statement& row, const Types& types, std::uint32_t* checksum);

/// The changes of `log`, one after the other.
class LogRows {
public:
  LogRows(sqlite::Database& database, const Meta& meta, const Sessions& sessions,
          const Types& types);

  /// Nothing after the last. Throws JournalCorrupt, also if one is missing.
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

/// The life's flags, as they are written.
std::uint64_t flags_of(const EntryLife& x);

/// Refuses a file that is no journal, or of another version. Throws JournalError.
void check_format(sqlite::Database& database);

/// Throws JournalCorrupt if the file's own structure is damaged.
void check_structure(sqlite::Database& database);

} // namespace castor::journal_tables
