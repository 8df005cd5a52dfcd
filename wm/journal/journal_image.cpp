#include "castor/wm/journal/journal_image.hpp"

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
  bury(id, version, sequence);
}

void JournalImage::apply(JournalRecord record) {
  if (record.sequence <= sequence_)
    impossible(record, "change " + std::to_string(sequence_) + " came before it");
  auto i = entries_.find(record.id);
  if (record.operation == Operation::add) {
    if (i != entries_.end())
      impossible(record, "there is an entry already");
    if (auto old = deleted_.find(record.id); old != deleted_.end()) {
      if (record.version != raised(old->second->version, old->second->sequence) + 1)
        impossible(record, "it was deleted with version " + std::to_string(old->second->version));
      burials_.erase(old->second);
      deleted_.erase(old);
    }
  } else {
    if (i == entries_.end())
      impossible(record, "there is no such entry");
    auto version = raised(i->second.version, i->second.sequence);
    if (record.version != version + (record.operation == Operation::overwrite ? 1 : 0))
      impossible(record, "it has version " + std::to_string(version));
  }
  sequence_ = record.sequence;
  if (record.operation == Operation::remove) {
    entries_.erase(i);
    bury(record.id, record.version, record.sequence);
    return;
  }
  auto id = record.id;
  entries_.insert_or_assign(std::move(id), std::move(record));
}

void JournalImage::begin_incarnation(std::uint64_t number) {
  base_ = std::max(base_, number * numbers_per_incarnation);
  sequence_ = std::max(sequence_, base_);
  floor_ = std::max(floor_, base_);
}

StoreImage JournalImage::store() const {
  StoreImage result;
  for (auto& [id, x] : entries_)
    result.entries.push_back(
      {std::make_shared<const Entry>(
         Entry{{subarchitecture_, id}, raised(x.version, x.sequence), x.value, x.source, x.life}),
       x.sequence, x.time});
  std::sort(result.entries.begin(), result.entries.end(),
            [](auto& a, auto& b) { return a.sequence < b.sequence; });
  for (auto& x : burials_)
    result.deleted.emplace_back(x.id, raised(x.version, x.sequence));
  result.floor = floor_;
  result.sequence = sequence_;
  return result;
}

Version JournalImage::raised(Version version, std::uint64_t sequence) const {
  return sequence <= base_ ? std::max(version, base_) : version;
}

void JournalImage::bury(const std::string& id, Version version, std::uint64_t sequence) {
  deleted_[id] = burials_.insert(burials_.end(), {id, version, sequence});
  if (burials_.size() <= remembered_)
    return;
  auto& oldest = burials_.front();
  floor_ = std::max(floor_, raised(oldest.version, oldest.sequence) + 1);
  deleted_.erase(oldest.id);
  burials_.pop_front();
}

} // namespace castor
