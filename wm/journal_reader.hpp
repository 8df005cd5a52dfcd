#pragma once

#include "castor/wm/journal.hpp"
#include "castor/wm/journal_image.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor {

namespace sqlite {
class Database;
}
namespace journal_tables {
struct Meta;
struct Session;
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

  /// Calls `f` with every change, in order.
  void read(const std::function<void(JournalRecord)>& f);

  /// All of both; `f` is called before each change, if there is one.
  JournalImage replay(const std::function<void(const JournalRecord&)>& f = {});

private:
  template <class F>
  auto guarded(F&& f);

  std::filesystem::path file_;
  std::unique_ptr<sqlite::Database> database_;
  std::unique_ptr<journal_tables::Meta> meta_;
  std::map<std::uint64_t, journal_tables::Session> sessions_;
  std::map<std::uint64_t, TypeDescriptorPtr> types_;
};

} // namespace castor
