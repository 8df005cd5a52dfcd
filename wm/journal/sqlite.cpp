#include "castor/wm/journal/sqlite.hpp"

#include "castor/base/input_file.hpp"

#include <sqlite3.h>

#include <system_error>

namespace castor::sqlite {

namespace {

/// How long somebody else may keep the file from being written.
constexpr int patience_ms = 10'000;

/// What SQLite says of files and disks, in our words.
std::string in_words(int code, const char* message) {
  switch (code & 0xFF) {
    case SQLITE_IOERR:
      return "reading or writing the disk failed";
    case SQLITE_FULL:
      return "the disk is full";
    case SQLITE_CANTOPEN:
      return "the file cannot be opened";
    case SQLITE_READONLY:
      return "the file cannot be written";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another process keeps the file locked";
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return "the file may not be used";
    case SQLITE_NOTADB:
      return "the file is no journal";
    case SQLITE_CORRUPT:
      return "the content of the file is damaged";
    case SQLITE_NOMEM:
      return "there is not enough memory";
    default:
      return message;
  }
}

[[noreturn]] void fail(sqlite3* database, int code) {
  auto extended = database ? sqlite3_extended_errcode(database) : code;
  auto what = in_words(code, database ? sqlite3_errmsg(database) : sqlite3_errstr(code));
  if (auto number = database ? sqlite3_system_errno(database) : 0; number != 0)
    what += std::string{" ("} + std::generic_category().message(number) + ")";
  throw Error{extended, what};
}

void check(sqlite3* database, int code) {
  if (code != SQLITE_OK)
    fail(database, code);
}

std::string uri(const std::filesystem::path& file, OpenMode mode) {
  std::string result = "file:";
  std::error_code error;
  auto path = std::filesystem::absolute(file, error);
  for (char c : (error ? file : path).string()) {
    if (c == '%' || c == '?' || c == '#') {
      constexpr auto* digits = "0123456789ABCDEF";
      result += {'%', digits[static_cast<unsigned char>(c) >> 4], digits[c & 15]};
    } else {
      result += c;
    }
  }
  return mode == OpenMode::read_unchanging ? result + "?immutable=1" : result;
}

/// SQLite would open a named pipe, and wait for what comes from it.
void refuse_special(const std::filesystem::path& file) {
  try {
    require_input_file(file);
  } catch (const InputFileError& e) {
    // Of the rest SQLite knows more.
    if (e.reason() == InputFileError::Reason::special)
      throw Error(SQLITE_CANTOPEN, e.what());
  }
}

} // namespace

bool Error::is_corruption() const {
  auto primary = code_ & 0xFF;
  return primary == SQLITE_CORRUPT || primary == SQLITE_NOTADB || primary == SQLITE_FORMAT ||
         code_ == SQLITE_IOERR_SHORT_READ || primary == SQLITE_MISMATCH ||
         primary == SQLITE_CONSTRAINT || primary == SQLITE_ERROR;
}

Database::Database(const std::filesystem::path& file, OpenMode mode, const std::string& vfs) {
  refuse_special(file);
  sqlite3* opened = nullptr;
  auto flags =
    SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX |
    (mode == OpenMode::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY);
  auto code =
    sqlite3_open_v2(uri(file, mode).c_str(), &opened, flags, vfs.empty() ? nullptr : vfs.c_str());
  handle_.reset(opened);
  check(opened, code);
  sqlite3_extended_result_codes(opened, 1);
  sqlite3_busy_timeout(opened, patience_ms);
  // The file may come from somewhere else: what its schema says is to happen does not.
  for (int feature : {SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW,
                      SQLITE_DBCONFIG_TRUSTED_SCHEMA})
    check(opened, sqlite3_db_config(opened, feature, 0, static_cast<int*>(nullptr)));
}

void Database::run(const char* statements) {
  check(handle(), sqlite3_exec(handle(), statements, nullptr, nullptr, nullptr));
}

std::int64_t Database::number(const char* query) {
  Statement statement{*this, query};
  return statement.step() ? static_cast<std::int64_t>(statement.number()) : 0;
}

std::string Database::text(const char* query) {
  Statement statement{*this, query};
  return statement.step() ? statement.text() : std::string{};
}

void Database::count_log_pages() {
  sqlite3_wal_hook(
    handle(),
    [](void* count, sqlite3*, const char*, int pages) {
      *static_cast<int*>(count) = pages;
      return SQLITE_OK;
    },
    log_pages_.get());
}

void Database::checkpoint() {
  check(handle(),
        sqlite3_wal_checkpoint_v2(handle(), nullptr, SQLITE_CHECKPOINT_PASSIVE, nullptr, nullptr));
}

void Database::checkpoint_on_close(bool on) {
  check(handle(), sqlite3_db_config(handle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, on ? 0 : 1,
                                    static_cast<int*>(nullptr)));
}

void Database::Close::operator()(sqlite3* x) const {
  sqlite3_close_v2(x);
}

Statement::Statement(Database& database, const char* text) {
  sqlite3_stmt* prepared = nullptr;
  check(database.handle(), sqlite3_prepare_v3(database.handle(), text, -1,
                                              SQLITE_PREPARE_PERSISTENT, &prepared, nullptr));
  handle_.reset(prepared);
}

Statement& Statement::bind(std::int64_t x) {
  check(sqlite3_db_handle(handle_.get()), sqlite3_bind_int64(handle_.get(), next_parameter_++, x));
  return *this;
}

Statement& Statement::bind(std::uint64_t x) {
  return bind(static_cast<std::int64_t>(x));
}

Statement& Statement::bind(std::string_view x) {
  check(sqlite3_db_handle(handle_.get()),
        sqlite3_bind_text64(handle_.get(), next_parameter_++, x.data() ? x.data() : "", x.size(),
                            SQLITE_STATIC, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(std::span<const std::uint8_t> x) {
  check(sqlite3_db_handle(handle_.get()),
        x.empty() ? sqlite3_bind_zeroblob(handle_.get(), next_parameter_++, 0)
                  : sqlite3_bind_blob64(handle_.get(), next_parameter_++, x.data(), x.size(),
                                        SQLITE_STATIC));
  return *this;
}

bool Statement::step() {
  next_column_ = 0;
  auto code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW)
    return true;
  auto* database = sqlite3_db_handle(handle_.get());
  if (code != SQLITE_DONE) {
    // Resetting clears the message.
    try {
      fail(database, code);
    } catch (...) {
      reset();
      throw;
    }
  }
  reset();
  return false;
}

void Statement::run() {
  while (step()) {
    // The rows are of no interest.
  }
}

void Statement::reset() {
  sqlite3_reset(handle_.get());
  next_parameter_ = 1;
}

std::uint64_t Statement::number() {
  return static_cast<std::uint64_t>(sqlite3_column_int64(handle_.get(), next_column_++));
}

std::string Statement::text() {
  auto* data = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), next_column_));
  auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), next_column_++));
  return data ? std::string{data, size} : std::string{};
}

std::span<const std::uint8_t> Statement::bytes() {
  auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(handle_.get(), next_column_));
  auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), next_column_++));
  return {data, data ? size : 0};
}

void Statement::Finalize::operator()(sqlite3_stmt* x) const {
  sqlite3_finalize(x);
}

Transaction::Transaction(Database& database) : database_(&database) {
  database.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (database_)
    sqlite3_exec(database_->handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_->run("COMMIT");
  database_ = nullptr;
}

} // namespace castor::sqlite
