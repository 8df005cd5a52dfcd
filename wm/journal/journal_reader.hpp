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

/// What a journal is, at a glance.
struct JournalSummary {
  std::string subarchitecture;
  std::uint64_t session = 0;
  std::uint64_t incarnation = 0;
  /// The last change.
  std::uint64_t sequence = 0;
  /// The changes that it has one by one, and the times of the first and the last of them.
  std::uint64_t changes = 0;
  UnixTime first{0};
  UnixTime last{0};
  std::uint64_t bytes = 0;
  /// Nobody writes it, and the last who did ended in order.
  bool clean = false;
};

/// Reads a journal, which somebody else may write meanwhile: as it stands at one moment. Throws
/// JournalError, which names the file.
class JournalReader {
public:
  explicit JournalReader(std::filesystem::path file);
  ~JournalReader();

  JournalSummary summary();

  /// The entries that the working memory had before the first of the changes.
  JournalImage begin();

  /// The next of the changes; nothing after the last.
  std::optional<JournalRecord> next();

  /// Where all of it leads; to be called instead of `next`. `f` is called with each change.
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
