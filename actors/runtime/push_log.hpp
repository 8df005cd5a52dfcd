#pragma once

#include "castor/wm/journal/sqlite.hpp"
#include "castor/wm/store/store_image.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

/// Log of the values that a stand-alone component hands out: a file for each, beside the journals
/// of a recording.
///
/// The file is an SQLite database. Values are cut into chunks of 64 KB, and a chunk that equals the
/// one at the same place of the value before is not stored again: a camera that looks at a still
/// picture costs next to nothing. docs/journals.md describes the tables.
namespace castor {

/// Extension of these files.
inline constexpr const char* push_log_extension = ".castor-pushes";

/// The current time, as recorded with values.
UnixTime unix_now();

/// A value that was pushed to somebody, or that somebody pulled.
struct RecordedPush {
  UnixTime time{0};
  /// Whether the value was pushed; otherwise it was pulled.
  bool pushed = true;
  Value value;
};

/// Summary of a file.
struct PushLogSummary {
  std::string provider;
  std::uint64_t pushes = 0;
  std::uint64_t pulls = 0;
  /// Times of the first and the last value.
  UnixTime first{0};
  UnixTime last{0};
  /// Size of the values in the file.
  std::uint64_t bytes = 0;
  /// Number of oldest values that were removed to keep the limit.
  std::uint64_t dropped = 0;
  /// Number of values lost because the disk was too slow.
  std::uint64_t lost = 0;
};

/// Writes such a file. Used by one thread at a time; throws sqlite::Error.
class PushLogWriter {
public:
  /// Appends to the file if there is one.
  PushLogWriter(const std::filesystem::path& file, const std::string& provider);

  /// Begin and end of a transaction, around what is appended, dropped and counted.
  void begin();
  void commit();

  void append(const RecordedPush& x);
  /// Removes the oldest value; there must be one.
  void drop_oldest();
  void count_lost(std::uint64_t count);

  std::size_t size() const { return served_.size(); }
  /// When the oldest was handed out; there must be one.
  UnixTime oldest() const { return served_.front().time; }
  /// Size of the values.
  std::uint64_t bytes() const { return bytes_; }

private:
  using ChunkNumber = std::uint64_t;

  struct Chunk {
    std::uint64_t size = 0;
    std::uint64_t users = 0;
  };
  struct Served {
    std::uint64_t number = 0;
    UnixTime time{0};
    std::vector<ChunkNumber> chunks;
  };
  /// The last value of a type, to compare the next with.
  struct Last {
    Value value;
    std::vector<ChunkNumber> chunks;
  };

  void read_content();
  std::uint64_t number_of(const TypeDescriptorPtr& type);
  ChunkNumber add_chunk(std::span<const std::uint8_t> bytes);
  void use(const Served& x);

  sqlite::Database database_;
  std::unique_ptr<sqlite::Transaction> transaction_;
  std::map<std::pair<std::string, std::uint64_t>, std::uint64_t> types_;
  std::unordered_map<ChunkNumber, Chunk> chunks_;
  std::deque<Served> served_;
  std::map<std::uint64_t, Last> last_;
  std::uint64_t last_number_ = 0;
  ChunkNumber last_chunk_ = 0;
  std::uint64_t bytes_ = 0;
};

/// Reads such a file, which may be written meanwhile. Everything throws JournalError, which names
/// the file.
class PushLogReader {
public:
  explicit PushLogReader(std::filesystem::path file);

  PushLogSummary summary();

  /// The next, in the order in which they were handed out; nothing after the last.
  std::optional<RecordedPush> next();

  /// The first of each type.
  std::vector<RecordedPush> first_of_each_type();

private:
  template <class F>
  auto guarded(F&& f);
  RecordedPush read(sqlite::Statement& row);

  std::filesystem::path file_;
  std::unique_ptr<sqlite::Database> database_;
  std::map<std::uint64_t, TypeDescriptorPtr> types_;
  std::unique_ptr<sqlite::Statement> rows_;
  std::unique_ptr<sqlite::Statement> chunk_;
};

} // namespace castor
