#include "castor/wm/journal/sqlite_journal.hpp"

#include "castor/wm/journal/journal_creation.hpp"
#include "castor/wm/journal/journal_error.hpp"
#include "castor/wm/journal/journal_recovery.hpp"
#include "castor/wm/values/descriptor_encoding.hpp"
#include "castor/wm/values/encoding.hpp"

#include <chrono>
#include <filesystem>
#include <span>
#include <system_error>
#include <utility>

namespace castor {

using namespace journal_tables;

namespace {

/// When the write-ahead log has so many pages of 4 KB, it goes into the file itself.
constexpr int checkpoint_pages = 1000;

UnixTime unix_now() {
  return std::chrono::duration_cast<UnixTime>(std::chrono::system_clock::now().time_since_epoch());
}

} // namespace

template <class F>
auto SqliteJournal::guarded(const char* what, F&& f) {
  auto message = [&](const std::string& why, const std::string& remedy) {
    return "the journal " + options_.file.string() + " of " + subarchitecture_ + " cannot be " +
           what + ": " + why + ". " + remedy;
  };
  const std::string damaged = "It is damaged: put a copy in its place, or move it away to begin "
                              "without entries; `castor journal show` shows what can still be read";
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

SqliteJournal::SqliteJournal(const JournalOptions& options, std::string subarchitecture)
  : options_(options), subarchitecture_(std::move(subarchitecture)) {
  guarded("opened", [&] { open(); });
}

void SqliteJournal::open() {
  make_journal_folder(options_.file);
  lock_.emplace(options_.file, owner_, options_.returning);
  if (!std::filesystem::exists(options_.file)) {
    if (options_.returning)
      throw JournalError("it has been removed or moved since the system began: put it back, or "
                         "start the system again, which then begins without its entries");
    // It would be taken for that of the new file.
    if (std::filesystem::exists(options_.file.string() + "-wal"))
      throw JournalCorrupt("there is a file of the same name that ends with -wal, but not the "
                           "journal itself");
    make_journal(options_.file, subarchitecture_);
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
  recover();
  files_.emplace(std::vector<std::filesystem::path>{options_.file, options_.file.string() + "-wal",
                                                    options_.file.string() + "-shm"});
  database_->checkpoint_on_close(true);
}

void SqliteJournal::recover() {
  JournalRecovery recovery{*database_, options_, subarchitecture_, owner_, unix_now()};
  meta_ = recovery.meta();
  for (auto& [number, type] : recovery.types())
    types_[{type->name(), type->hash}] = number;
  image_ = recovery.take_image();
  meta_writer_.emplace(*database_);
  compaction_.emplace(*database_, options_.remembered_deletions);
}

OpenedJournal SqliteJournal::take_opened() {
  OpenedJournal result;
  result.image = std::move(image_);
  result.session = meta_.session;
  result.incarnation = meta_.incarnation;
  result.time = unix_now();
  return result;
}

void SqliteJournal::append(const std::vector<JournalGroupPtr>& groups) {
  guarded("written", [&] {
    sqlite::Transaction transaction{*database_};
    check_session();
    auto meta = meta_;
    for (auto& group : groups)
      for (auto& record : *group) {
        insert(record);
        meta.last = record.sequence;
      }
    meta_writer_->write(meta);
    transaction.commit();
    meta_ = meta;
    // What went into files that nobody will find again is not to be acknowledged.
    if (auto problem = files_->problem(); !problem.empty())
      throw JournalError(problem);
  });
}

bool SqliteJournal::tidy() {
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

void SqliteJournal::close() {
  guarded("closed", [&] {
    sqlite::Transaction transaction{*database_};
    check_session();
    auto meta = meta_;
    meta.clean = true;
    meta_writer_->write(meta);
    transaction.commit();
    insert_.reset();
    meta_writer_.reset();
    compaction_.reset();
    database_.reset();
    lock_->release();
  });
}

std::uint64_t SqliteJournal::bytes() const {
  std::uint64_t result = 0;
  std::error_code error;
  for (auto* suffix : {"", "-wal"})
    if (auto size = std::filesystem::file_size(options_.file.string() + suffix, error); !error)
      result += size;
  return result;
}

void SqliteJournal::check_session() {
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

void SqliteJournal::insert(JournalRecord& x) {
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

std::uint64_t SqliteJournal::number_of(const TypeDescriptor& type) {
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

/// Nobody relies on what is folded, so it need not be synced; with a log that goes backwards it
/// must be.
void SqliteJournal::fold() {
  if (!options_.shared)
    database_->run("PRAGMA synchronous=NORMAL");
  {
    sqlite::Transaction transaction{*database_};
    check_session();
    auto meta = meta_;
    compaction_->fold(meta);
    meta_writer_->write(meta);
    transaction.commit();
    meta_ = meta;
  }
  if (!options_.shared)
    database_->run("PRAGMA synchronous=FULL");
}

std::uint64_t SqliteJournal::used_bytes() {
  return static_cast<std::uint64_t>(
    (database_->number("PRAGMA page_count") - database_->number("PRAGMA freelist_count")) *
    database_->number("PRAGMA page_size"));
}

} // namespace castor
