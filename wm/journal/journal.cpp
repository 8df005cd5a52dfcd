#include "castor/wm/journal/journal.hpp"

#include "castor/wm/journal/journal_lock.hpp"
#include "castor/wm/journal/journal_tables.hpp"
#include "castor/wm/journal/sqlite.hpp"
#include "castor/wm/values/encoding.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <type_traits>
#include <unordered_map>
#include <utility>

namespace castor {

using namespace journal_tables;

namespace {

/// When the write-ahead log has so many pages of 4 KB, it goes into the file itself.
constexpr int checkpoint_pages = 1000;

/// What is folded in one go, which keeps writes waiting for some milliseconds.
constexpr std::uint64_t fold_rows = 1024;
constexpr std::uint64_t fold_bytes = std::uint64_t{1} << 20;

/// Sessions of which no change is left are remembered for so long.
constexpr std::uint64_t remembered_sessions = 1000;

UnixTime unix_now() {
  return std::chrono::duration_cast<UnixTime>(std::chrono::system_clock::now().time_since_epoch());
}

/// What a power cut would otherwise take back: that there is a file of that name.
void sync_directory(const std::filesystem::path& directory) {
  int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    return; // a file system that cannot do it
  fsync(descriptor);
  ::close(descriptor);
}

/// Makes a journal without entries. Under its own name it is there once it is whole, so a file that
/// is not was damaged.
void make(const std::filesystem::path& file, const std::string& subarchitecture) {
  auto unfinished = file;
  unfinished += ".new-" + std::to_string(getpid());
  std::filesystem::remove(unfinished);
  {
    sqlite::Database database{unfinished, sqlite::OpenMode::write};
    database.run(
      ("PRAGMA synchronous=FULL; PRAGMA application_id=" + std::to_string(application_id) +
       "; PRAGMA user_version=" + std::to_string(format_version))
        .c_str());
    sqlite::Transaction transaction{database};
    database.run(schema);
    Meta meta;
    meta.subarchitecture = subarchitecture;
    sqlite::Statement row{database,
                          "INSERT INTO meta VALUES (1, ?, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, ?)"};
    row.bind(meta.subarchitecture).bind(std::uint64_t{meta.checksum()}).run();
    transaction.commit();
  }
  // Unlike a renaming, this leaves alone what somebody else has put there meanwhile.
  std::error_code exists;
  std::filesystem::create_hard_link(unfinished, file, exists);
  std::filesystem::remove(unfinished);
  if (exists && !std::filesystem::exists(file))
    throw JournalError("it cannot be made: " + exists.message());
  sync_directory(file.parent_path());
}

/// Of one type, whatever process says so.
struct TypeKey {
  std::string name;
  std::uint64_t hash = 0;
  auto operator<=>(const TypeKey&) const = default;
};

class SqliteJournal final : public JournalFile {
public:
  SqliteJournal(const JournalOptions& options, std::string subarchitecture)
    : options_(options), subarchitecture_(std::move(subarchitecture)) {
    guarded("opened", [&] {
      auto folder = options_.file.parent_path();
      if (!folder.empty() && std::filesystem::create_directories(folder))
        sync_directory(folder.parent_path());
      lock_.emplace(options_.file, owner_, options_.returning);
      if (!std::filesystem::exists(options_.file)) {
        if (options_.returning)
          throw JournalError("it has been removed or moved since the system began: put it back, or "
                             "start the system again, which then begins without its entries");
        // It would be taken for that of the new file.
        if (std::filesystem::exists(options_.file.string() + "-wal"))
          throw JournalCorrupt("there is a file of the same name that ends with -wal, but not the "
                               "journal itself");
        make(options_.file, subarchitecture_);
      }
      database_.emplace(options_.file, sqlite::OpenMode::write, options_.vfs);
      // What is not known to be sound is not written.
      database_->checkpoint_on_close(false);
      database_->run("PRAGMA cell_size_check=ON; PRAGMA trusted_schema=OFF; "
                     "PRAGMA synchronous=FULL; PRAGMA cache_size=-8000; "
                     "PRAGMA journal_size_limit=16777216");
      check_format(*database_);
      check_structure(*database_);
      database_->run(options_.shared ? "PRAGMA journal_mode=TRUNCATE" : "PRAGMA journal_mode=WAL");
      database_->count_log_pages();
      take_up();
      files_.emplace(std::vector<std::filesystem::path>{
        options_.file, options_.file.string() + "-wal", options_.file.string() + "-shm"});
      database_->checkpoint_on_close(true);
    });
  }

  /// What it held when it was opened.
  OpenedJournal opened() {
    OpenedJournal result;
    result.image = std::move(image_);
    result.session = meta_.session;
    result.incarnation = meta_.incarnation;
    result.time = unix_now();
    return result;
  }

  void append(const std::vector<JournalGroupPtr>& groups) override {
    guarded("written", [&] {
      sqlite::Transaction transaction{*database_};
      check_session();
      auto meta = meta_;
      for (auto& group : groups)
        for (auto& record : *group) {
          insert(record);
          meta.last = record.sequence;
        }
      write(meta);
      transaction.commit();
      meta_ = meta;
      // What went into files that nobody will find again is not to be acknowledged.
      if (auto problem = files_->problem(); !problem.empty())
        throw JournalError(problem);
    });
  }

  bool tidy() override {
    return guarded("written", [&] {
      lock_->renew();
      if (database_->log_pages() >= checkpoint_pages)
        database_->checkpoint();
      auto used = used_bytes();
      // Once begun, it goes on for a while.
      folding_ = !options_.keep && meta_.folded < meta_.last &&
                 used > (folding_ ? options_.limit_bytes / 8 * 7 : options_.limit_bytes);
      if (folding_)
        fold();
      return folding_;
    });
  }

  void close() override {
    guarded("closed", [&] {
      sqlite::Transaction transaction{*database_};
      check_session();
      auto meta = meta_;
      meta.clean = true;
      write(meta);
      transaction.commit();
      insert_.reset();
      write_meta_.reset();
      database_.reset();
      lock_->release();
    });
  }

  std::uint64_t bytes() const override {
    std::uint64_t result = 0;
    std::error_code error;
    for (auto* suffix : {"", "-wal"})
      if (auto size = std::filesystem::file_size(options_.file.string() + suffix, error); !error)
        result += size;
    return result;
  }

private:
  /// What goes wrong says which file it is about, and what to do.
  template <class F>
  std::invoke_result_t<F> guarded(const char* what, F&& f) {
    auto message = [&](const std::string& why, const std::string& remedy) {
      return "the journal " + options_.file.string() + " of " + subarchitecture_ + " cannot be " +
             what + ": " + why + ". " + remedy;
    };
    const std::string damaged =
      "It is damaged: put a copy in its place, or move it away to begin "
      "without entries; what can still be read shows `castor journal show`";
    const char* elsewhere = "--journal-dir puts journals elsewhere";
    try {
      return f();
    } catch (const JournalCorrupt& e) {
      throw JournalCorrupt(message(e.what(), damaged));
    } catch (const DecodeError& e) {
      throw JournalCorrupt(message(e.what(), damaged));
    } catch (const sqlite::Error& e) {
      if (e.is_corruption())
        throw JournalCorrupt(message(e.what(), damaged));
      throw JournalError(files_ && !files_->problem().empty()
                           ? message(files_->problem(), elsewhere)
                           : message(e.what(), "See to it that there is room, that the file may be "
                                               "written, and that nobody else keeps it locked"));
    } catch (const std::filesystem::filesystem_error& e) {
      throw JournalError(message(
        "the folder " + e.path1().string() + " cannot be used: " + e.code().message(), elsewhere));
    } catch (const JournalOfAnother& e) {
      throw JournalOfAnother(message(e.what(), elsewhere));
    } catch (const JournalError& e) {
      throw JournalError(message(e.what(), elsewhere));
    }
  }

  /// Reads everything and makes the journal this process's own, in one transaction.
  void take_up() {
    sqlite::Transaction transaction{*database_};
    meta_ = read_meta(*database_);
    if (meta_.subarchitecture != subarchitecture_)
      throw JournalError("it is the journal of " + meta_.subarchitecture);
    auto sessions = read_sessions(*database_);
    auto types = read_types(*database_);
    auto image = read_folded(*database_, meta_, types, options_.remembered_deletions);
    LogRows changes{*database_, meta_, sessions, types};
    while (auto x = changes.next()) {
      image.begin_incarnation(sessions.at(x->session).incarnation);
      image.apply(*std::move(x));
    }
    for (auto& [number, type] : types)
      types_[{type->name(), type->hash}] = number;
    if (!meta_.clean && !meta_.lossless)
      ++meta_.incarnation;
    image.begin_incarnation(meta_.incarnation);
    ++meta_.session;
    meta_.last = std::max(meta_.last, image.sequence());
    meta_.lossless = options_.mode == JournalMode::full && !options_.go_on_without;
    meta_.clean = false;
    write(meta_);
    begin_session();
    transaction.commit();
    image_ = image.store();
  }

  void begin_session() {
    Session x;
    x.number = meta_.session;
    x.opened = unix_now();
    x.host = owner_.host;
    x.process = owner_.process;
    x.mode = static_cast<std::uint64_t>(options_.mode);
    x.before = meta_.last;
    x.incarnation = meta_.incarnation;
    sqlite::Statement{*database_, "INSERT INTO sessions VALUES (?, ?, ?, ?, ?, ?, ?, ?)"}
      .bind(x.number)
      .bind(x.opened.count())
      .bind(x.host)
      .bind(x.process)
      .bind(x.mode)
      .bind(x.before)
      .bind(x.incarnation)
      .bind(std::uint64_t{x.checksum()})
      .run();
    if (x.number > remembered_sessions)
      sqlite::Statement{*database_, "DELETE FROM sessions WHERE number < ? AND number NOT IN "
                                    "(SELECT session FROM log)"}
        .bind(x.number - remembered_sessions)
        .run();
  }

  /// Whoever has opened the journal last may write it.
  void check_session() {
    auto newest = static_cast<std::uint64_t>(database_->number("SELECT session FROM meta"));
    if (newest == meta_.session)
      return;
    auto sessions = read_sessions(*database_);
    std::string who = "somebody";
    if (auto i = sessions.find(newest); i != sessions.end())
      who = "process " + std::to_string(i->second.process) + " on " + i->second.host;
    throw JournalError(who + " has taken it over (session " + std::to_string(newest) +
                       ", this one is session " + std::to_string(meta_.session) + ")");
  }

  void write(const Meta& x) {
    if (!write_meta_)
      write_meta_.emplace(*database_,
                          "UPDATE meta SET session=?, incarnation=?, last=?, folded=?, floor=?, "
                          "entries=?, deleted=?, entries_sum=?, deleted_sum=?, lossless=?, "
                          "clean=?, checksum=?");
    for (auto number : {x.session, x.incarnation, x.last, x.folded, x.floor, x.entries, x.deleted,
                        x.entries_sum, x.deleted_sum, std::uint64_t{x.lossless},
                        std::uint64_t{x.clean}, std::uint64_t{x.checksum()}})
      write_meta_->bind(number);
    write_meta_->run();
  }

  std::uint64_t number_of(const TypeDescriptor& type) {
    auto [i, is_new] = types_.try_emplace({type.name(), type.hash}, types_.size() + 1);
    if (is_new) {
      auto bytes = encode_descriptor(type);
      sqlite::Statement{*database_, "INSERT INTO types VALUES (?, ?, ?)"}
        .bind(i->second)
        .bind(std::span<const std::uint8_t>{bytes})
        .bind(std::uint64_t{checksum(i->second, bytes)})
        .run();
    }
    return i->second;
  }

  void insert(JournalRecord& x) {
    x.session = meta_.session;
    if (x.before.has_value())
      x.changed = changed_fields(x.before, x.value);
    auto type = number_of(*x.type);
    if (!insert_)
      insert_.emplace(*database_,
                      "INSERT INTO log VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    std::span<const std::uint8_t> value;
    if (x.value.has_value())
      value = x.value.bytes();
    insert_->bind(x.sequence)
      .bind(x.write)
      .bind(x.session)
      .bind(x.time.count())
      .bind(static_cast<std::uint64_t>(x.operation))
      .bind(x.id)
      .bind(type)
      .bind(x.version)
      .bind(x.source)
      .bind(x.life.time_to_live.count())
      .bind(flags_of(x.life))
      .bind(x.changed)
      .bind(value)
      .bind(std::uint64_t{checksum(x, type)})
      .run();
  }

  std::uint64_t used_bytes() {
    return static_cast<std::uint64_t>(
      (database_->number("PRAGMA page_count") - database_->number("PRAGMA freelist_count")) *
      database_->number("PRAGMA page_size"));
  }

  // -- folding

  struct OldChange {
    std::uint64_t sequence = 0;
    Operation operation = Operation::add;
    Version version = 0;
    std::uint64_t checksum = 0;
    std::string id;
  };

  /// Some of the oldest changes become part of the entries that they led to. Nobody relies on that,
  /// so it need not be synced; with a log that goes backwards it must be.
  void fold() {
    if (!options_.shared)
      database_->run("PRAGMA synchronous=NORMAL");
    {
      sqlite::Transaction transaction{*database_};
      check_session();
      auto meta = meta_;
      auto changes = oldest_changes();
      std::unordered_map<std::string, const OldChange*> last;
      for (auto& x : changes) {
        last[x.id] = &x;
        // One by one, so that the same deletions are forgotten as in the working memory.
        if (x.operation == Operation::remove)
          bury(meta, x);
        else if (x.operation == Operation::add)
          take_out("deleted", x.id, meta.deleted, meta.deleted_sum);
      }
      for (auto& [id, x] : last)
        fold(meta, *x);
      // What is left without changes are numbers that a new incarnation skips.
      meta.folded = changes.empty() ? meta.last : changes.back().sequence;
      sqlite::Statement{*database_, "DELETE FROM log WHERE sequence <= ?"}.bind(meta.folded).run();
      write(meta);
      transaction.commit();
      meta_ = meta;
    }
    if (!options_.shared)
      database_->run("PRAGMA synchronous=FULL");
  }

  std::vector<OldChange> oldest_changes() {
    sqlite::Statement rows{*database_, "SELECT sequence, operation, version, checksum, id, "
                                       "length(value) FROM log ORDER BY sequence LIMIT ?"};
    rows.bind(fold_rows);
    std::uint64_t bytes = 0;
    std::vector<OldChange> result;
    while (bytes < fold_bytes && rows.step()) {
      auto& x = result.emplace_back();
      x.sequence = rows.number();
      x.operation = static_cast<Operation>(rows.number());
      x.version = rows.number();
      x.checksum = rows.number();
      x.id = rows.text();
      bytes += rows.number();
    }
    return result;
  }

  /// What an entry has come to.
  void fold(Meta& meta, const OldChange& x) {
    take_out("entries", x.id, meta.entries, meta.entries_sum);
    if (x.operation == Operation::remove)
      return;
    sqlite::Statement{*database_, "INSERT INTO entries SELECT * FROM log WHERE sequence = ?"}
      .bind(x.sequence)
      .run();
    ++meta.entries;
    meta.entries_sum += x.checksum;
  }

  void bury(Meta& meta, const OldChange& x) {
    auto sum = checksum(x.id, x.version, x.sequence);
    sqlite::Statement{*database_, "INSERT INTO deleted VALUES (?, ?, ?, ?)"}
      .bind(x.sequence)
      .bind(x.id)
      .bind(x.version)
      .bind(std::uint64_t{sum})
      .run();
    ++meta.deleted;
    meta.deleted_sum += sum;
    if (meta.deleted <= options_.remembered_deletions)
      return;
    sqlite::Statement oldest{*database_, "DELETE FROM deleted WHERE sequence = (SELECT "
                                         "min(sequence) FROM deleted) RETURNING sequence, version, "
                                         "checksum"};
    while (oldest.step()) {
      auto base = meta.incarnation * numbers_per_incarnation;
      auto sequence = oldest.number();
      auto version = oldest.number();
      // As the working memory has it since its new incarnation began.
      if (sequence <= base)
        version = std::max(version, base);
      meta.floor = std::max(meta.floor, version + 1);
      meta.deleted_sum -= oldest.number();
      --meta.deleted;
    }
  }

  void take_out(const std::string& table, const std::string& id, std::uint64_t& count,
                std::uint64_t& sum) {
    sqlite::Statement row{*database_,
                          ("DELETE FROM " + table + " WHERE id = ? RETURNING checksum").c_str()};
    row.bind(id);
    while (row.step()) {
      --count;
      sum -= row.number();
    }
  }

  JournalOptions options_;
  std::string subarchitecture_;
  const JournalOwner owner_ = JournalOwner::here(options_.system);
  std::optional<JournalLock> lock_;
  std::optional<JournalFiles> files_;
  std::optional<sqlite::Database> database_;
  std::optional<sqlite::Statement> insert_;
  std::optional<sqlite::Statement> write_meta_;
  Meta meta_;
  std::map<TypeKey, std::uint64_t> types_;
  StoreImage image_;
  bool folding_ = false;
};

OpenedJournal take_up(const JournalOptions& options, const std::string& subarchitecture) {
  auto journal = std::make_shared<SqliteJournal>(options, subarchitecture);
  auto result = journal->opened();
  result.file = std::move(journal);
  return result;
}

} // namespace

JournalRecord record_of(const ChangeEvent& event, const Entry& entry, const EntryPtr& before,
                        UnixTime began) {
  JournalRecord x;
  x.sequence = x.write = event.sequence;
  x.time = began + event.time;
  x.operation = event.operation;
  x.id = event.address.id;
  x.type = event.type;
  x.version = event.version;
  x.source = event.source;
  x.life = entry.life;
  if (event.operation != Operation::remove)
    x.value = entry.value;
  if (before)
    x.before = before->value;
  return x;
}

OpenedJournal open_journal(const JournalOptions& options, const std::string& subarchitecture) {
  if (!options.go_on_without)
    return take_up(options, subarchitecture);
  try {
    try {
      return take_up(options, subarchitecture);
    } catch (const JournalCorrupt& e) {
      auto aside = move_aside(options.file, "corrupt");
      options.report(std::string{e.what()} + ". It was moved to " + aside.string() + ", and " +
                     subarchitecture + " begins without entries");
      return take_up(options, subarchitecture);
    }
  } catch (const std::runtime_error& e) {
    options.report(std::string{e.what()} + ". " + subarchitecture + " goes on without a journal");
    OpenedJournal result;
    result.failure = e.what();
    return result;
  }
}

} // namespace castor
