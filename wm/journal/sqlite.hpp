#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

/// The part of SQLite that journals need, with exceptions.
namespace castor::sqlite {

class Error : public std::runtime_error {
public:
  Error(int code, const std::string& what) : runtime_error(what), code_(code) {}

  /// Whether the file is damaged or of another format, rather than not readable or writable now.
  bool is_corruption() const;

private:
  int code_;
};

enum class OpenMode : std::uint8_t {
  /// The file is created if there is none.
  write,
  read,
  /// No process writes the file: it is read without any lock.
  read_unchanging,
};

class Database {
public:
  /// `vfs` is the SQLite VFS by which the file is accessed; empty for the default.
  Database(const std::filesystem::path& file, OpenMode mode, const std::string& vfs = {});

  /// Runs statements and ignores their results.
  void run(const char* statements);

  /// First column of the first row of the result.
  std::int64_t number(const char* query);
  std::string text(const char* query);

  /// From now on `log_pages` is the length of the write-ahead log, and only `checkpoint` moves it
  /// into the file.
  void count_log_pages();
  int log_pages() const { return *log_pages_; }

  /// Moves pages from the write-ahead log into the file, as far as readers allow.
  void checkpoint();

  /// Sets whether the write-ahead log is moved into the file when it is closed.
  void checkpoint_on_close(bool on);

  sqlite3* handle() const { return handle_.get(); }

private:
  struct Close {
    void operator()(sqlite3* x) const;
  };

  std::unique_ptr<int> log_pages_ = std::make_unique<int>(0);
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Columns and parameters are read and bound in their order.
class Statement {
public:
  Statement(Database& database, const char* text);

  Statement& bind(std::uint64_t x);
  Statement& bind(std::int64_t x);
  /// The bound bytes must stay valid until the next `step` or `run`.
  Statement& bind(std::string_view x);
  Statement& bind(std::span<const std::uint8_t> x);

  /// Advances to the next row. Returns false at the end; then the statement can be bound anew.
  bool step();

  /// Runs to the end; for statements without a result.
  void run();

  /// Skips the remaining rows.
  void reset();

  std::uint64_t number();
  std::string text();
  std::span<const std::uint8_t> bytes();

private:
  struct Finalize {
    void operator()(sqlite3_stmt* x) const;
  };

  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
  int next_parameter_ = 1;
  int next_column_ = 0;
};

/// A transaction; rolled back unless it is committed.
class Transaction {
public:
  /// Takes the write lock; waits while another connection holds it.
  explicit Transaction(Database& database);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();

  void commit();

private:
  Database* database_;
};

} // namespace castor::sqlite
