#include "castor/wm/journal/journal_tables.hpp"

#include "castor/wm/journal/journal_error.hpp"
#include "castor/wm/values/descriptor_encoding.hpp"
#include "castor/wm/values/encoding.hpp"

namespace castor::journal_tables {

namespace {

/// A checksum of numbers and texts, each of which says how long it is.
class Checksum {
public:
  Checksum& add(std::uint64_t x) {
    crc_.add(&x, sizeof(x));
    return *this;
  }

  Checksum& add(std::span<const std::uint8_t> x) {
    add(x.size());
    crc_.add(x);
    return *this;
  }

  Checksum& add(const std::string& x) {
    add(x.size());
    crc_.add(x.data(), x.size());
    return *this;
  }

  std::uint32_t value() const { return crc_.value(); }

private:
  Crc32 crc_;
};

std::uint32_t record_checksum(const JournalRecord& x, std::uint64_t type,
                              std::span<const std::uint8_t> value) {
  return Checksum{}
    .add(x.sequence)
    .add(x.write)
    .add(x.session)
    .add(static_cast<std::uint64_t>(x.time.count()))
    .add(static_cast<std::uint64_t>(x.operation))
    .add(x.id)
    .add(type)
    .add(x.version)
    .add(x.source)
    .add(static_cast<std::uint64_t>(x.life.time_to_live.count()))
    .add(flags_of(x.life))
    .add(x.changed)
    .add(value)
    .value();
}

constexpr std::uint64_t ephemeral_flag = 1;
constexpr std::uint64_t only_once_flag = 2;
constexpr std::uint64_t writable_by_all_flag = 4;

sqlite::Statement select_records(sqlite::Database& database, const std::string& table) {
  return {database, ("SELECT " + std::string{record_columns} + ", checksum FROM " + table +
                     " ORDER BY sequence")
                      .c_str()};
}

void require_checksum(std::uint64_t stands, std::uint32_t should, const std::string& what) {
  if (stands != should)
    throw JournalCorrupt("the checksum of " + what + " is wrong");
}

} // namespace

const char* const schema = R"(
CREATE TABLE meta (
  one INTEGER PRIMARY KEY CHECK (one = 1), subarchitecture TEXT, session INTEGER,
  incarnation INTEGER, last INTEGER, folded INTEGER, floor INTEGER, entries INTEGER,
  deleted INTEGER, entries_sum INTEGER, deleted_sum INTEGER, lossless INTEGER, clean INTEGER,
  checksum INTEGER);
CREATE TABLE sessions (
  number INTEGER PRIMARY KEY, opened INTEGER, host TEXT, process INTEGER, mode INTEGER,
  before INTEGER, incarnation INTEGER, checksum INTEGER);
CREATE TABLE types (number INTEGER PRIMARY KEY, descriptor BLOB, checksum INTEGER);
CREATE TABLE log (
  sequence INTEGER PRIMARY KEY, write INTEGER, session INTEGER, time INTEGER, operation INTEGER,
  id TEXT, type INTEGER, version INTEGER, source TEXT, time_to_live INTEGER, life INTEGER,
  changed INTEGER, value BLOB, checksum INTEGER);
CREATE TABLE entries (
  sequence INTEGER PRIMARY KEY, write INTEGER, session INTEGER, time INTEGER, operation INTEGER,
  id TEXT UNIQUE, type INTEGER, version INTEGER, source TEXT, time_to_live INTEGER, life INTEGER,
  changed INTEGER, value BLOB, checksum INTEGER);
CREATE TABLE deleted (
  sequence INTEGER PRIMARY KEY, id TEXT UNIQUE, version INTEGER, checksum INTEGER);
)";

std::uint32_t Meta::checksum() const {
  return Checksum{}
    .add(subarchitecture)
    .add(session)
    .add(incarnation)
    .add(last)
    .add(folded)
    .add(floor)
    .add(entries)
    .add(deleted)
    .add(entries_sum)
    .add(deleted_sum)
    .add(lossless)
    .add(clean)
    .value();
}

std::uint32_t Session::checksum() const {
  return Checksum{}
    .add(number)
    .add(static_cast<std::uint64_t>(opened.count()))
    .add(host)
    .add(process)
    .add(mode)
    .add(before)
    .add(incarnation)
    .value();
}

Meta read_meta(sqlite::Database& database) {
  sqlite::Statement row{database,
                        "SELECT subarchitecture, session, incarnation, last, folded, floor, "
                        "entries, deleted, entries_sum, deleted_sum, lossless, clean, checksum "
                        "FROM meta"};
  if (!row.step())
    throw JournalCorrupt("its first row is missing");
  Meta x;
  x.subarchitecture = row.text();
  for (auto* number : {&x.session, &x.incarnation, &x.last, &x.folded, &x.floor, &x.entries,
                       &x.deleted, &x.entries_sum, &x.deleted_sum})
    *number = row.number();
  x.lossless = row.number() != 0;
  x.clean = row.number() != 0;
  require_checksum(row.number(), x.checksum(), "its first row");
  return x;
}

MetaWriter::MetaWriter(sqlite::Database& database)
  : update_(database, "UPDATE meta SET session=?, incarnation=?, last=?, folded=?, floor=?, "
                      "entries=?, deleted=?, entries_sum=?, deleted_sum=?, lossless=?, clean=?, "
                      "checksum=?") {}

void MetaWriter::write(const Meta& x) {
  for (auto number : {x.session, x.incarnation, x.last, x.folded, x.floor, x.entries, x.deleted,
                      x.entries_sum, x.deleted_sum, std::uint64_t{x.lossless},
                      std::uint64_t{x.clean}, std::uint64_t{x.checksum()}})
    update_.bind(number);
  update_.run();
}

Sessions read_sessions(sqlite::Database& database) {
  sqlite::Statement row{database, "SELECT number, opened, host, process, mode, before, "
                                  "incarnation, checksum FROM sessions ORDER BY number"};
  Sessions result;
  while (row.step()) {
    Session x;
    x.number = row.number();
    x.opened = UnixTime{static_cast<std::int64_t>(row.number())};
    x.host = row.text();
    for (auto* number : {&x.process, &x.mode, &x.before, &x.incarnation})
      *number = row.number();
    require_checksum(row.number(), x.checksum(), "session " + std::to_string(x.number));
    result[x.number] = std::move(x);
  }
  return result;
}

Types read_types(sqlite::Database& database) {
  sqlite::Statement row{database, "SELECT number, descriptor, checksum FROM types"};
  Types result;
  while (row.step()) {
    auto number = row.number();
    auto bytes = row.bytes();
    require_checksum(row.number(), checksum(number, bytes), "type " + std::to_string(number));
    result[number] = decode_descriptor(bytes);
  }
  return result;
}

JournalRecord read_record(sqlite::Statement& row, const Types& types, std::uint32_t* sum) {
  JournalRecord x;
  x.sequence = row.number();
  x.write = row.number();
  x.session = row.number();
  x.time = UnixTime{static_cast<std::int64_t>(row.number())};
  auto operation = row.number();
  x.operation = static_cast<Operation>(operation);
  x.id = row.text();
  auto type = row.number();
  x.version = row.number();
  x.source = row.text();
  x.life.time_to_live = Timestamp{static_cast<std::int64_t>(row.number())};
  auto flags = row.number();
  x.life.ephemeral = (flags & ephemeral_flag) != 0;
  x.life.only_once = (flags & only_once_flag) != 0;
  x.life.writable_by_all = (flags & writable_by_all_flag) != 0;
  x.changed = row.number();
  auto value = row.bytes();
  auto stands = row.number();
  auto should = record_checksum(x, type, value);
  auto name = "change " + std::to_string(x.sequence);
  require_checksum(stands, should, name);
  if (sum)
    *sum = should;
  auto known = types.find(type);
  if (operation > 2 || known == types.end())
    throw JournalCorrupt(name + " is of an unknown kind or type");
  x.type = known->second;
  if (x.operation != Operation::remove)
    x.value = Value::from_foreign_bytes(x.type, {value.begin(), value.end()});
  return x;
}

JournalImage read_folded(sqlite::Database& database, const Meta& meta, const Types& types,
                         std::size_t remembered_deletions) {
  JournalImage result{meta.subarchitecture, remembered_deletions};
  result.raise_floor(meta.floor);
  auto count = meta.entries;
  auto sum = meta.entries_sum;
  auto entries = select_records(database, "entries");
  while (entries.step()) {
    std::uint32_t row_sum = 0;
    result.add_folded(read_record(entries, types, &row_sum));
    --count;
    sum -= row_sum;
  }
  if (count != 0 || sum != 0)
    throw JournalCorrupt("folded entries are missing");
  count = meta.deleted;
  sum = meta.deleted_sum;
  sqlite::Statement deleted{
    database, "SELECT sequence, id, version, checksum FROM deleted ORDER BY sequence"};
  while (deleted.step()) {
    auto sequence = deleted.number();
    auto id = deleted.text();
    auto version = deleted.number();
    auto row_sum = checksum(id, version, sequence);
    require_checksum(deleted.number(), row_sum, "the deleted entry " + id);
    result.add_deleted(id, version, sequence);
    --count;
    sum -= row_sum;
  }
  if (count != 0 || sum != 0)
    throw JournalCorrupt("deleted entries are missing");
  result.set_sequence(meta.folded);
  return result;
}

LogRows::LogRows(sqlite::Database& database, const Meta& meta, const Sessions& sessions,
                 const Types& types)
  : meta_(meta), sessions_(sessions), types_(types), rows_(select_records(database, "log")),
    last_(meta.folded) {}

std::optional<JournalRecord> LogRows::next() {
  if (over_)
    return std::nullopt;
  if (!rows_.step()) {
    over_ = true;
    if (last_ != meta_.last && meta_.last != meta_.incarnation * numbers_per_incarnation)
      throw JournalCorrupt("the changes from " + std::to_string(last_ + 1) + " to " +
                           std::to_string(meta_.last) + " are missing");
    return std::nullopt;
  }
  auto record = read_record(rows_, types_, nullptr);
  if (record.session != session_) {
    session_ = record.session;
    auto session = sessions_.find(session_);
    if (session == sessions_.end())
      throw JournalCorrupt("session " + std::to_string(session_) + " is missing");
    // Numbers go on from session to session, except where a new incarnation begins.
    auto before = session->second.before;
    if (before > last_ && before == session->second.incarnation * numbers_per_incarnation)
      last_ = before;
  }
  if (record.sequence != last_ + 1)
    throw JournalCorrupt("the changes between " + std::to_string(last_) + " and " +
                         std::to_string(record.sequence) + " are missing");
  last_ = record.sequence;
  return record;
}

std::uint32_t checksum(const JournalRecord& x, std::uint64_t type) {
  return record_checksum(x, type,
                         x.value.has_value() ? std::span<const std::uint8_t>{x.value.bytes()}
                                             : std::span<const std::uint8_t>{});
}

std::uint32_t checksum(const std::string& id, Version version, std::uint64_t sequence) {
  return Checksum{}.add(id).add(version).add(sequence).value();
}

std::uint32_t checksum(std::uint64_t number, std::span<const std::uint8_t> descriptor) {
  return Checksum{}.add(number).add(descriptor).value();
}

std::uint64_t flags_of(const EntryLife& x) {
  return (x.ephemeral ? ephemeral_flag : 0) | (x.only_once ? only_once_flag : 0) |
         (x.writable_by_all ? writable_by_all_flag : 0);
}

void check_format(sqlite::Database& database) {
  if (database.number("PRAGMA application_id") != application_id)
    throw JournalCorrupt("it is no journal of a working memory");
  if (auto version = database.number("PRAGMA user_version"); version != format_version)
    throw JournalError("it is a journal of version " + std::to_string(version) +
                       ", and this Castor knows version " + std::to_string(format_version));
}

void check_structure(sqlite::Database& database) {
  if (auto verdict = database.text("PRAGMA quick_check(1)"); verdict != "ok")
    throw JournalCorrupt(verdict);
}

} // namespace castor::journal_tables
