#pragma once

#include "castor/wm/journal/journal_compaction.hpp"
#include "castor/wm/journal/journal_file.hpp"
#include "castor/wm/journal/journal_lock.hpp"
#include "castor/wm/journal/journal_options.hpp"
#include "castor/wm/journal/journal_tables.hpp"
#include "castor/wm/journal/sqlite.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace castor {

/// A journal in an SQLite file that this process writes.
class SqliteJournal final : public JournalFile {
public:
  /// Opens the journal, or creates it. Throws JournalError.
  SqliteJournal(const JournalOptions& options, std::string subarchitecture);

  /// Content at the time of opening, without `file`; to be called once.
  OpenedJournal take_opened();

  void append(const std::vector<JournalGroupPtr>& groups) override;
  bool tidy() override;
  void close() override;
  std::uint64_t bytes() const override;

private:
  /// Identity of an entry type across processes.
  struct TypeKey {
    std::string name;
    std::uint64_t hash = 0;
    auto operator<=>(const TypeKey&) const = default;
  };

  /// Calls `f`; its exceptions are thrown again as JournalError with the file and the remedy.
  template <class F>
  auto guarded(const char* what, F&& f);

  void open();
  void recover();

  /// Throws JournalError if another process has opened the journal since.
  void check_session();
  void insert(JournalRecord& x);
  std::uint64_t number_of(const TypeDescriptor& type);
  void fold();
  std::uint64_t used_bytes();

  JournalOptions options_;
  std::string subarchitecture_;
  const JournalOwner owner_ = JournalOwner::here(options_.system);
  std::optional<JournalLock> lock_;
  std::optional<JournalFiles> files_;
  std::optional<sqlite::Database> database_;
  std::optional<sqlite::Statement> insert_;
  std::optional<journal_tables::MetaWriter> meta_writer_;
  std::optional<JournalCompaction> compaction_;
  journal_tables::Meta meta_;
  std::map<TypeKey, std::uint64_t> types_;
  StoreImage image_;
  bool folding_ = false;
};

} // namespace castor
