#include "castor/wm/journal/journal_image.hpp"

#include "castor/wm/journal/journal_error.hpp"

#include <algorithm>

namespace castor {

namespace {

[[noreturn]] void impossible(const JournalRecord& x, const std::string& why) {
  throw JournalCorrupt("change " + std::to_string(x.sequence) + ", " +
                       std::string{to_string(x.operation)} + " of " + x.id + " version " +
                       std::to_string(x.version) + ", cannot have happened: " + why);
}

} // namespace

void JournalImage::add_folded(JournalRecord record) {
  sequence_ = std::max(sequence_, record.sequence);
  auto id = record.id;
  entries_.insert_or_assign(std::move(id), std::move(record));
}

void JournalImage::add_deleted(const std::string& id, Version version, std::uint64_t sequence) {
  sequence_ = std::max(sequence_, sequence);
  tombstones_.add(id, version, sequence);
}

void JournalImage::apply(JournalRecord record) {
  if (record.sequence <= sequence_)
    impossible(record, "change " + std::to_string(sequence_) + " came before it");
  auto i = entries_.find(record.id);
  if (record.operation == Operation::add) {
    if (i != entries_.end())
      impossible(record, "there is an entry already");
    if (auto last = tombstones_.version(record.id)) {
      if (record.version != *last + 1)
        impossible(record, "it was deleted with version " + std::to_string(*last));
      tombstones_.erase(record.id);
    }
  } else {
    if (i == entries_.end())
      impossible(record, "there is no such entry");
    auto version = version_of(i->second);
    if (record.version != version + (record.operation == Operation::overwrite ? 1 : 0))
      impossible(record, "it has version " + std::to_string(version));
  }
  sequence_ = record.sequence;
  if (record.operation == Operation::remove) {
    entries_.erase(i);
    tombstones_.add(record.id, record.version, record.sequence);
    return;
  }
  auto id = record.id;
  entries_.insert_or_assign(std::move(id), std::move(record));
}

void JournalImage::begin_incarnation(std::uint64_t number) {
  base_ = std::max(base_, number * numbers_per_incarnation);
  sequence_ = std::max(sequence_, base_);
  tombstones_.begin_incarnation(base_);
}

StoreImage JournalImage::store() const {
  StoreImage result;
  for (auto& [id, x] : entries_)
    result.entries.push_back({std::make_shared<const Entry>(Entry{
                                {subarchitecture_, id}, version_of(x), x.value, x.source, x.life}),
                              x.sequence, x.time});
  std::sort(result.entries.begin(), result.entries.end(),
            [](auto& a, auto& b) { return a.sequence < b.sequence; });
  tombstones_.for_each([&](auto& id, auto version) { result.deleted.emplace_back(id, version); });
  result.floor = tombstones_.floor();
  result.sequence = sequence_;
  return result;
}

Version JournalImage::version_of(const JournalRecord& x) const {
  return Tombstones::version_in_incarnation(x.version, x.sequence, base_);
}

} // namespace castor
