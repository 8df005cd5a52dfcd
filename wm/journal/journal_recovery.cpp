#include "castor/wm/journal/journal_recovery.hpp"

#include "castor/wm/journal/journal_error.hpp"

#include <algorithm>

namespace castor {

using namespace journal_tables;

namespace {

/// Sessions of which no change is left are remembered for so long.
constexpr std::uint64_t remembered_sessions = 1000;

} // namespace

JournalRecovery::JournalRecovery(sqlite::Database& database, const JournalOptions& options,
                                 const std::string& subarchitecture, const JournalOwner& owner,
                                 UnixTime now) {
  sqlite::Transaction transaction{database};
  meta_ = read_meta(database);
  if (meta_.subarchitecture != subarchitecture)
    throw JournalError("it is the journal of " + meta_.subarchitecture);
  auto sessions = read_sessions(database);
  types_ = read_types(database);
  auto image = read_folded(database, meta_, types_, options.remembered_deletions);
  LogRows changes{database, meta_, sessions, types_};
  while (auto x = changes.next()) {
    image.begin_incarnation(sessions.at(x->session).incarnation);
    image.apply(*std::move(x));
  }
  if (!meta_.clean && !meta_.lossless)
    ++meta_.incarnation;
  image.begin_incarnation(meta_.incarnation);
  ++meta_.session;
  meta_.last = std::max(meta_.last, image.sequence());
  meta_.lossless = options.mode == JournalMode::full && !options.go_on_without;
  meta_.clean = false;
  MetaWriter{database}.write(meta_);
  begin_session(database, options, owner, now);
  transaction.commit();
  image_ = image.store();
}

void JournalRecovery::begin_session(sqlite::Database& database, const JournalOptions& options,
                                    const JournalOwner& owner, UnixTime now) {
  Session x;
  x.number = meta_.session;
  x.opened = now;
  x.host = owner.host;
  x.process = owner.process;
  x.mode = static_cast<std::uint64_t>(options.mode);
  x.before = meta_.last;
  x.incarnation = meta_.incarnation;
  sqlite::Statement{database, "INSERT INTO sessions VALUES (?, ?, ?, ?, ?, ?, ?, ?)"}
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
    sqlite::Statement{database, "DELETE FROM sessions WHERE number < ? AND number NOT IN "
                                "(SELECT session FROM log)"}
      .bind(x.number - remembered_sessions)
      .run();
}

} // namespace castor
