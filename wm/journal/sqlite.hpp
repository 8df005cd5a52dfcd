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

/// As much of SQLite as journals need, with exceptions.
namespace castor::sqlite {

class Error : public std::runtime_error {
public:
  Error(int code, const std::string& what) : runtime_error(what), code_(code) {}

  /// The file is not what it should be, as opposed to: it cannot be read or written now.
  bool is_corruption() const;

private:
  int code_;
};

enum class OpenMode : std::uint8_t {
  /// The file is made if there is none.
  write,
  read,
  /// Nobody else writes the file: it is read without any lock.
  read_unchanging,
};

class Database {
public:
  /// `vfs` is what the file is reached through; empty for the operating system's own.
  Database(const std::filesystem::path& file, OpenMode mode, const std::string& vfs = {});

  /// Statements without a result, or whose result is of no interest.
  void run(const char* statements);

  /// The first column of the first row.
  std::int64_t number(const char* query);
  std::string text(const char* query);

  /// From now on it is known how long the write-ahead log is, and it is left to `checkpoint`.
  void count_log_pages();
  int log_pages() const { return *log_pages_; }

  /// Moves what can be moved from the write-ahead log into the file.
  void checkpoint();

  /// Whether what the write-ahead log holds goes into the file itself when it is closed.
  void checkpoint_on_close(bool on);

  sqlite3* handle() const { return handle_.get(); }

private:
  struct Close {
    void operator()(sqlite3* x) const;
  };

  std::unique_ptr<int> log_pages_ = std::make_unique<int>(0);
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A statement that is used again and again. Columns and parameters are taken in their order.
class Statement {
public:
  Statement(Database& database, const char* text);

  Statement& bind(std::uint64_t x);
  Statement& bind(std::int64_t x);
  /// What is bound must stay until the next `step` or `run`.
  Statement& bind(std::string_view x);
  Statement& bind(std::span<const std::uint8_t> x);

  /// The next row, if there is one; otherwise the statement can be bound anew.
  bool step();

  /// To the end; for statements without a result.
  void run();

  /// Gives up the rows that are left.
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

/// Undone, unless it is committed.
class Transaction {
public:
  /// Takes the right to write, and waits for it if somebody else has it.
  explicit Transaction(Database& database);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();

  void commit();

private:
  Database* database_;
};

} // namespace castor::sqlite
