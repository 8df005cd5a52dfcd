#pragma once

#include "castor/wm/journal/journal.hpp"
#include "castor/wm/journal/journal_image.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace castor {

namespace sqlite {
class Database;
}
namespace journal_tables {
struct Meta;
struct Session;
class LogRows;
} // namespace journal_tables

/// Key figures of a journal.
struct JournalSummary {
  std::string subarchitecture;
  std::uint64_t session = 0;
  std::uint64_t incarnation = 0;
  /// Sequence number of the last change.
  std::uint64_t sequence = 0;
  /// Number of changes that are not folded, and the times of the first and the last of them.
  std::uint64_t changes = 0;
  UnixTime first{0};
  UnixTime last{0};
  std::uint64_t bytes = 0;
  /// No process writes it, and the last writer ended in order.
  bool clean = false;
};

/// Reads a snapshot of a journal, which another process may write meanwhile. Throws JournalError,
/// which names the file.
class JournalReader {
public:
  explicit JournalReader(std::filesystem::path file);
  ~JournalReader();

  JournalSummary summary();

  /// The entries that the working memory had before the first of the changes.
  JournalImage begin();

  /// The next change; nothing after the last.
  std::optional<JournalRecord> next();

  /// The state after all changes; to be called instead of `next`. Calls `f` with each change.
  JournalImage replay(const std::function<void(const JournalRecord&)>& f = {});

private:
  template <class F>
  auto guarded(F&& f);

  std::filesystem::path file_;
  std::unique_ptr<sqlite::Database> database_;
  std::unique_ptr<journal_tables::Meta> meta_;
  std::map<std::uint64_t, journal_tables::Session> sessions_;
  std::map<std::uint64_t, TypeDescriptorPtr> types_;
  std::unique_ptr<journal_tables::LogRows> rows_;
};

} // namespace castor
