#include "castor/wm/journal/journal_compaction.hpp"

#include "castor/wm/journal/journal_record.hpp"
#include "castor/wm/store/tombstones.hpp"

#include <algorithm>
#include <unordered_map>

namespace castor {

using namespace journal_tables;

namespace {

/// What is folded in one go, which keeps writes waiting for some milliseconds.
constexpr std::uint64_t fold_rows = 1024;
constexpr std::uint64_t fold_bytes = std::uint64_t{1} << 20;

} // namespace

void JournalCompaction::fold(Meta& meta) {
  auto changes = oldest_changes();
  std::unordered_map<std::string, const OldChange*> last;
  for (auto& x : changes) {
    last[x.id] = &x;
    // One by one, so that the same deletions are forgotten as in the working memory.
    if (x.operation == Operation::remove)
      remember_deletion(meta, x);
    else if (x.operation == Operation::add)
      remove_row("deleted", x.id, meta.deleted, meta.deleted_sum);
  }
  for (auto& [id, x] : last)
    fold(meta, *x);
  // What is left without changes are numbers that a new incarnation skips.
  meta.folded = changes.empty() ? meta.last : changes.back().sequence;
  sqlite::Statement{database_, "DELETE FROM log WHERE sequence <= ?"}.bind(meta.folded).run();
}

std::vector<JournalCompaction::OldChange> JournalCompaction::oldest_changes() {
  sqlite::Statement rows{database_, "SELECT sequence, operation, version, checksum, id, "
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

void JournalCompaction::fold(Meta& meta, const OldChange& x) {
  remove_row("entries", x.id, meta.entries, meta.entries_sum);
  if (x.operation == Operation::remove)
    return;
  sqlite::Statement{database_, "INSERT INTO entries SELECT * FROM log WHERE sequence = ?"}
    .bind(x.sequence)
    .run();
  ++meta.entries;
  meta.entries_sum += x.checksum;
}

void JournalCompaction::remember_deletion(Meta& meta, const OldChange& x) {
  auto sum = checksum(x.id, x.version, x.sequence);
  sqlite::Statement{database_, "INSERT INTO deleted VALUES (?, ?, ?, ?)"}
    .bind(x.sequence)
    .bind(x.id)
    .bind(x.version)
    .bind(std::uint64_t{sum})
    .run();
  ++meta.deleted;
  meta.deleted_sum += sum;
  if (meta.deleted <= remembered_deletions_)
    return;
  sqlite::Statement oldest{database_, "DELETE FROM deleted WHERE sequence = (SELECT "
                                      "min(sequence) FROM deleted) RETURNING sequence, version, "
                                      "checksum"};
  while (oldest.step()) {
    auto sequence = oldest.number();
    auto version = oldest.number();
    meta.floor =
      std::max(meta.floor, Tombstones::version_in_incarnation(
                             version, sequence, meta.incarnation * numbers_per_incarnation) +
                             1);
    meta.deleted_sum -= oldest.number();
    --meta.deleted;
  }
}

void JournalCompaction::remove_row(const std::string& table, const std::string& id,
                                   std::uint64_t& count, std::uint64_t& sum) {
  sqlite::Statement row{database_,
                        ("DELETE FROM " + table + " WHERE id = ? RETURNING checksum").c_str()};
  row.bind(id);
  while (row.step()) {
    --count;
    sum -= row.number();
  }
}

} // namespace castor
