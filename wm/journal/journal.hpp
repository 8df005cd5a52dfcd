#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/journal/journal_error.hpp"
#include "castor/wm/journal/journal_mode.hpp"
#include "castor/wm/store/store_image.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// What a working memory has on disk, so that it comes back with its entries after its end.
namespace castor {

/// What the names of journals' files end with.
inline constexpr const char* journal_extension = ".castor-journal";

struct JournalOptions {
  JournalMode mode = JournalMode::off;
  std::filesystem::path file;
  /// `batched`: how long a change may be acknowledged and not on disk.
  std::chrono::milliseconds delay{100};
  /// `batched`: how many changes, and how many bytes of values, may be. Beyond that nothing is
  /// acknowledged until some are on disk.
  std::size_t most_unsynced = 10'000;
  std::size_t most_unsynced_bytes = std::size_t{64} << 20;
  /// What to do when the journal fails: go on without one, or end.
  bool go_on_without = false;
  /// What the file may grow to before the oldest changes are folded into the entries that they
  /// led to; what the present entries take is needed in any case.
  std::uint64_t limit_bytes = std::uint64_t{256} << 20;
  /// The file is a recording: nothing is folded.
  bool keep = false;
  /// The file lies on a network's storage, where processes of several machines cannot share memory.
  bool shared = false;
  /// How many deleted ids keep their version.
  std::size_t remembered_deletions = 100'000;
  /// On a thread of its own; without, whoever runs actors writes the file.
  bool own_thread = true;
  /// The name of the system that writes it, which differs from those of all others: no other system
  /// is given the journal meanwhile.
  std::string system = {};
  /// The system has written it before, so it has to be there, and nobody else may have had it
  /// since.
  bool returning = false;
  /// The way to the file, for SQLite (its VFS); empty for the usual one.
  std::string vfs = {};
  /// Is told what goes wrong.
  std::function<void(const std::string&)> report = [](const std::string&) {};
};

/// A change, as it stands in a journal.
struct JournalRecord {
  /// As in the change event.
  std::uint64_t sequence = 0;
  /// The sequence number of the first change of the same write.
  std::uint64_t write = 0;
  /// The working memory's life: a journal's sessions count from 1.
  std::uint64_t session = 0;
  UnixTime time{0};
  Operation operation = Operation::add;
  std::string id;
  TypeDescriptorPtr type;
  Version version = 0;
  /// The component that made the change.
  std::string source;
  EntryLife life;
  /// Of an overwrite. Found by who writes the journal, from `before`.
  FieldMask changed = 0;
  /// The entry's content after the change; none for a deletion.
  Value value;
  /// That before an overwrite; not written down.
  Value before;
};

/// The record of a change that has just been committed; `before` for an overwrite. The write that
/// it is part of is its own, the time is counted from `began`.
JournalRecord record_of(const ChangeEvent& event, const Entry& entry, const EntryPtr& before,
                        UnixTime began);

/// The changes of one write: either all are in the journal, or none.
using JournalGroup = std::vector<JournalRecord>;
using JournalGroupPtr = std::shared_ptr<JournalGroup>;

/// A journal that can be written, by one thread at a time. Everything throws JournalError; what was
/// to be written is then not to be relied upon, and nothing more can be.
class JournalFile {
public:
  virtual ~JournalFile() = default;

  /// Writes these down; they are safe from a power cut when it returns.
  virtual void append(const std::vector<JournalGroupPtr>& groups) = 0;

  /// Does a little of what keeps the file small; returns whether there is more to do.
  virtual bool tidy() = 0;

  /// The end is an orderly one.
  virtual void close() = 0;

  virtual std::uint64_t bytes() const = 0;
};

/// A working memory that has lost acknowledged writes gets another incarnation. All that it then
/// numbers begins at another multiple of this, so that no number comes twice for different things.
inline constexpr std::uint64_t numbers_per_incarnation = 1'000'000'000'000;

/// A journal as a working memory takes it up.
struct OpenedJournal {
  std::shared_ptr<JournalFile> file;
  StoreImage image;
  /// How often it was opened: lease tokens of different sessions differ.
  std::uint64_t session = 0;
  std::uint64_t incarnation = 0;
  UnixTime time{0};
  /// Why there is no file, and the working memory goes on without.
  std::string failure = {};
};

/// Opens the journal for writing, or makes it, and takes it away from whoever of the same system
/// writes it. Throws JournalError if that cannot be, or another system writes it; with
/// `go_on_without` a file that is not sound is moved aside, and the result may have no file.
OpenedJournal open_journal(const JournalOptions& options, const std::string& subarchitecture);

} // namespace castor
