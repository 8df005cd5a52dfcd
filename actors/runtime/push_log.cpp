#include "castor/actors/runtime/push_log.hpp"

#include "castor/wm/journal/journal.hpp"
#include "castor/wm/values/crc32.hpp"
#include "castor/wm/values/descriptor_encoding.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <span>
#include <system_error>
#include <utility>

namespace castor {

namespace {

constexpr std::int64_t application_id = 0x50575343; // "CSWP"
constexpr std::int64_t format_version = 1;
constexpr std::size_t chunk_size = std::size_t{64} << 10;

constexpr const char* schema = R"(
CREATE TABLE meta (one INTEGER PRIMARY KEY CHECK (one = 1), provider TEXT, dropped INTEGER,
                   lost INTEGER);
CREATE TABLE types (number INTEGER PRIMARY KEY, descriptor BLOB);
CREATE TABLE chunks (number INTEGER PRIMARY KEY, bytes BLOB);
CREATE TABLE served (number INTEGER PRIMARY KEY, time INTEGER, pushed INTEGER, type INTEGER,
                     chunks BLOB, checksum INTEGER);
)";

constexpr const char* served_columns = "time, pushed, type, chunks, checksum";

std::span<const std::uint8_t> piece(const Bytes& bytes, std::size_t number) {
  auto begin = number * chunk_size;
  return std::span{bytes}.subspan(begin, std::min(chunk_size, bytes.size() - begin));
}

bool is_equal(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size()) == 0;
}

std::span<const std::uint8_t> as_bytes(const std::vector<std::uint64_t>& numbers) {
  return {reinterpret_cast<const std::uint8_t*>(numbers.data()),
          numbers.size() * sizeof(std::uint64_t)};
}

std::vector<std::uint64_t> as_numbers(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint64_t> result(bytes.size() / sizeof(std::uint64_t));
  std::memcpy(result.data(), bytes.data(), result.size() * sizeof(std::uint64_t));
  return result;
}

std::uint32_t checksum(const Bytes& x) {
  Crc32 result;
  result.add(x);
  return result.value();
}

void make_tables(sqlite::Database& database, const std::string& provider) {
  database.run("PRAGMA page_size=16384; PRAGMA journal_mode=WAL");
  sqlite::Transaction transaction{database};
  database.run(("PRAGMA application_id=" + std::to_string(application_id) +
                "; PRAGMA user_version=" + std::to_string(format_version))
                 .c_str());
  database.run(schema);
  sqlite::Statement{database, "INSERT INTO meta VALUES (1, ?, 0, 0)"}
    .bind(std::string_view{provider})
    .run();
  transaction.commit();
}

} // namespace

UnixTime unix_now() {
  return std::chrono::duration_cast<UnixTime>(std::chrono::system_clock::now().time_since_epoch());
}

// -- writer

PushLogWriter::PushLogWriter(const std::filesystem::path& file, const std::string& provider)
  : database_(file, sqlite::OpenMode::write) {
  if (database_.number("PRAGMA application_id") == 0)
    make_tables(database_, provider);
  database_.run("PRAGMA synchronous=NORMAL; PRAGMA journal_size_limit=16777216");
  read_content();
}

void PushLogWriter::read_content() {
  sqlite::Statement types{database_, "SELECT number, descriptor FROM types"};
  while (types.step()) {
    auto number = types.number();
    auto type = decode_descriptor(types.bytes());
    types_[{type->name(), type->hash}] = number;
  }
  sqlite::Statement chunks{database_, "SELECT number, length(bytes) FROM chunks"};
  while (chunks.step()) {
    auto number = chunks.number();
    chunks_[number].size = chunks.number();
    last_chunk_ = std::max(last_chunk_, number);
  }
  sqlite::Statement served{database_, "SELECT number, time, chunks FROM served ORDER BY number"};
  while (served.step()) {
    Served x;
    x.number = last_number_ = served.number();
    x.time = UnixTime{static_cast<std::int64_t>(served.number())};
    x.chunks = as_numbers(served.bytes());
    use(x);
    served_.push_back(std::move(x));
  }
}

void PushLogWriter::begin() {
  transaction_ = std::make_unique<sqlite::Transaction>(database_);
}

void PushLogWriter::commit() {
  transaction_->commit();
  transaction_.reset();
}

void PushLogWriter::use(const Served& x) {
  for (auto number : x.chunks) {
    auto& chunk = chunks_[number];
    if (chunk.users++ == 0)
      bytes_ += chunk.size;
  }
}

std::uint64_t PushLogWriter::number_of(const TypeDescriptorPtr& type) {
  auto [i, is_new] = types_.try_emplace({type->name(), type->hash}, types_.size() + 1);
  if (is_new) {
    auto bytes = encode_descriptor(*type);
    sqlite::Statement{database_, "INSERT INTO types VALUES (?, ?)"}
      .bind(i->second)
      .bind(std::span<const std::uint8_t>{bytes})
      .run();
  }
  return i->second;
}

PushLogWriter::ChunkNumber PushLogWriter::add_chunk(std::span<const std::uint8_t> bytes) {
  sqlite::Statement{database_, "INSERT INTO chunks VALUES (?, ?)"}
    .bind(++last_chunk_)
    .bind(bytes)
    .run();
  chunks_[last_chunk_].size = bytes.size();
  return last_chunk_;
}

void PushLogWriter::append(const RecordedPush& x) {
  auto type = number_of(x.value.type_ptr());
  auto& bytes = x.value.bytes();
  auto& last = last_[type];
  Served served;
  served.number = ++last_number_;
  served.time = x.time;
  for (std::size_t i = 0; i * chunk_size < bytes.size(); ++i) {
    auto chunk = piece(bytes, i);
    auto is_old = i < last.chunks.size() && chunks_.count(last.chunks[i]) > 0 &&
                  is_equal(chunk, piece(last.value.bytes(), i));
    served.chunks.push_back(is_old ? last.chunks[i] : add_chunk(chunk));
  }
  sqlite::Statement{database_, "INSERT INTO served VALUES (?, ?, ?, ?, ?, ?)"}
    .bind(served.number)
    .bind(std::int64_t{x.time.count()})
    .bind(std::uint64_t{x.pushed ? 1U : 0U})
    .bind(type)
    .bind(as_bytes(served.chunks))
    .bind(std::uint64_t{checksum(bytes)})
    .run();
  use(served);
  last = {x.value, served.chunks};
  served_.push_back(std::move(served));
}

void PushLogWriter::drop_oldest() {
  auto& oldest = served_.front();
  for (auto number : oldest.chunks) {
    auto chunk = chunks_.find(number);
    if (--chunk->second.users > 0)
      continue;
    bytes_ -= chunk->second.size;
    chunks_.erase(chunk);
    sqlite::Statement{database_, "DELETE FROM chunks WHERE number = ?"}.bind(number).run();
  }
  sqlite::Statement{database_, "DELETE FROM served WHERE number = ?"}.bind(oldest.number).run();
  database_.run("UPDATE meta SET dropped = dropped + 1");
  served_.pop_front();
}

void PushLogWriter::count_lost(std::uint64_t count) {
  sqlite::Statement{database_, "UPDATE meta SET lost = lost + ?"}.bind(count).run();
}

// -- reader

template <class F>
auto PushLogReader::guarded(F&& f) {
  try {
    return f();
  } catch (const std::runtime_error& e) {
    throw JournalError("cannot read the recorded pushes of " + file_.string() + ": " + e.what());
  }
}

PushLogReader::PushLogReader(std::filesystem::path file) : file_(std::move(file)) {
  guarded([&] {
    std::error_code error;
    if (!std::filesystem::exists(file_, error))
      throw JournalError("there is no such file");
    try {
      database_ = std::make_unique<sqlite::Database>(file_, sqlite::OpenMode::read);
      database_->run("BEGIN; SELECT count(*) FROM sqlite_schema");
    } catch (const sqlite::Error& e) {
      if (e.is_corruption() || std::filesystem::exists(file_.string() + "-wal", error))
        throw;
      // Nothing can be written beside it, and nobody writes it.
      database_ = std::make_unique<sqlite::Database>(file_, sqlite::OpenMode::read_unchanging);
    }
    if (database_->number("PRAGMA application_id") != application_id)
      throw JournalError("it is no file of recorded pushes");
    if (auto version = database_->number("PRAGMA user_version"); version != format_version)
      throw JournalError("it is of version " + std::to_string(version) + ", this castor reads " +
                         std::to_string(format_version));
    sqlite::Statement types{*database_, "SELECT number, descriptor FROM types"};
    while (types.step()) {
      auto number = types.number();
      types_[number] = decode_descriptor(types.bytes());
    }
    rows_ = std::make_unique<sqlite::Statement>(
      *database_,
      ("SELECT " + std::string{served_columns} + " FROM served ORDER BY number").c_str());
    chunk_ =
      std::make_unique<sqlite::Statement>(*database_, "SELECT bytes FROM chunks WHERE number = ?");
  });
}

PushLogSummary PushLogReader::summary() {
  return guarded([&] {
    PushLogSummary result;
    sqlite::Statement meta{*database_, "SELECT provider, dropped, lost FROM meta"};
    if (!meta.step())
      throw JournalError("its first row is missing");
    result.provider = meta.text();
    result.dropped = meta.number();
    result.lost = meta.number();
    sqlite::Statement served{*database_,
                             "SELECT count(*), sum(pushed), min(time), max(time) FROM served"};
    served.step();
    auto count = served.number();
    result.pushes = served.number();
    result.pulls = count - result.pushes;
    result.first = UnixTime{static_cast<std::int64_t>(served.number())};
    result.last = UnixTime{static_cast<std::int64_t>(served.number())};
    result.bytes =
      static_cast<std::uint64_t>(database_->number("SELECT sum(length(bytes)) FROM chunks"));
    return result;
  });
}

RecordedPush PushLogReader::read(sqlite::Statement& row) {
  RecordedPush result;
  result.time = UnixTime{static_cast<std::int64_t>(row.number())};
  result.pushed = row.number() != 0;
  auto type = types_.find(row.number());
  Bytes bytes;
  for (auto number : as_numbers(row.bytes())) {
    chunk_->bind(number);
    if (chunk_->step()) {
      auto chunk = chunk_->bytes();
      bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    }
    chunk_->reset();
  }
  if (type == types_.end() || row.number() != checksum(bytes))
    throw JournalError("a value is damaged");
  result.value = Value::from_foreign_bytes(type->second, std::move(bytes));
  return result;
}

std::optional<RecordedPush> PushLogReader::next() {
  return guarded([&]() -> std::optional<RecordedPush> {
    if (!rows_ || !rows_->step()) {
      rows_.reset();
      return std::nullopt;
    }
    return read(*rows_);
  });
}

std::vector<RecordedPush> PushLogReader::first_of_each_type() {
  return guarded([&] {
    std::vector<RecordedPush> result;
    sqlite::Statement row{*database_,
                          ("SELECT " + std::string{served_columns} +
                           " FROM served WHERE number IN (SELECT min(number) FROM served GROUP BY "
                           "type) ORDER BY number")
                            .c_str()};
    while (row.step())
      result.push_back(read(row));
    return result;
  });
}

} // namespace castor
