#include "castor/wm/journal/journal_reader.hpp"

#include "castor/wm/journal/journal_tables.hpp"
#include "castor/wm/journal/sqlite.hpp"
#include "castor/wm/values/encoding.hpp"

#include <system_error>

namespace castor {

using namespace journal_tables;

namespace {

/// A file that lies where nothing can be written beside it, and that nobody writes, is read as it
/// is.
std::unique_ptr<sqlite::Database> open_for_reading(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw JournalError("there is no such file");
  try {
    auto result = std::make_unique<sqlite::Database>(file, sqlite::OpenMode::read);
    result->run("BEGIN; SELECT count(*) FROM sqlite_schema");
    return result;
  } catch (const sqlite::Error& e) {
    if (e.is_corruption() || std::filesystem::exists(file.string() + "-wal", error))
      throw;
    auto result = std::make_unique<sqlite::Database>(file, sqlite::OpenMode::read_unchanging);
    result->run("BEGIN");
    return result;
  }
}

} // namespace

template <class F>
auto JournalReader::guarded(F&& f) {
  try {
    return f();
  } catch (const std::runtime_error& e) {
    // Of SQLite, of the encoding, or of what the rows say.
    throw JournalError("cannot read the journal " + file_.string() + ": " + e.what());
  }
}

JournalReader::JournalReader(std::filesystem::path file) : file_(std::move(file)) {
  guarded([&] {
    database_ = open_for_reading(file_);
    check_format(*database_);
    meta_ = std::make_unique<Meta>(read_meta(*database_));
    sessions_ = read_sessions(*database_);
    types_ = read_types(*database_);
    rows_ = std::make_unique<LogRows>(*database_, *meta_, sessions_, types_);
  });
}

JournalReader::~JournalReader() = default;

JournalSummary JournalReader::summary() {
  return guarded([&] {
    JournalSummary result;
    result.subarchitecture = meta_->subarchitecture;
    result.session = meta_->session;
    result.incarnation = meta_->incarnation;
    result.sequence = meta_->last;
    result.clean = meta_->clean;
    sqlite::Statement row{*database_, "SELECT count(*), min(time), max(time) FROM log"};
    row.step();
    result.changes = row.number();
    result.first = UnixTime{static_cast<std::int64_t>(row.number())};
    result.last = UnixTime{static_cast<std::int64_t>(row.number())};
    row.reset();
    std::error_code error;
    for (auto* suffix : {"", "-wal"})
      if (auto size = std::filesystem::file_size(file_.string() + suffix, error); !error)
        result.bytes += size;
    return result;
  });
}

JournalImage JournalReader::begin() {
  return guarded([&] { return read_folded(*database_, *meta_, types_, ~std::size_t{0}); });
}

std::optional<JournalRecord> JournalReader::next() {
  return guarded([&] { return rows_->next(); });
}

JournalImage JournalReader::replay(const std::function<void(const JournalRecord&)>& f) {
  auto result = begin();
  guarded([&] {
    while (auto x = rows_->next()) {
      if (f)
        f(*x);
      result.begin_incarnation(sessions_.at(x->session).incarnation);
      result.apply(*std::move(x));
    }
    result.begin_incarnation(meta_->incarnation);
  });
  return result;
}

} // namespace castor
