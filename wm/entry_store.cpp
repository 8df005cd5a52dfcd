#include "castor/wm/entry_store.hpp"

#include <algorithm>
#include <queue>

namespace castor {

namespace {

std::string name_of(const Writer& x) {
  if (x.subarchitecture.empty())
    return x.component;
  return x.component + " of " + x.subarchitecture;
}

std::string_view verb(Operation x) {
  switch (x) {
    case Operation::add:
      return "add";
    case Operation::overwrite:
      return "overwrite";
    case Operation::remove:
      return "delete";
  }
  return "change";
}

} // namespace

EntryStore::EntryStore(std::string subarchitecture, EntryStoreOptions options)
  : subarchitecture_(std::move(subarchitecture)), options_(options), access_(subarchitecture_) {}

Outcome<EntryStore::Effect> EntryStore::prepare(const WriteRequest& request) const {
  auto& writer = request.writer;
  auto& address = request.address;
  if (!access_.may_write(writer.subarchitecture))
    return Failure{FailureKind::not_permitted,
                   name_of(writer) + " may not " + std::string{verb(request.operation)} + " " +
                     to_string(address) + ": only components of " + subarchitecture_ +
                     " write there. To allow it, put ACCESS " + writer.subarchitecture +
                     " WRITES " + subarchitecture_ + " into the system's .cast file",
                   address};
  auto i = entries_.find(address.id);
  if (request.operation == Operation::add) {
    if (i != entries_.end())
      return Failure{FailureKind::already_exists,
                     name_of(writer) + " cannot add " + to_string(address) + ": " +
                       i->second.entry->writer + " put a " + i->second.entry->type_name() +
                       " there. Overwrite it, or add under a new id",
                     address};
    if (auto failure = check_type(request))
      return *failure;
    return Effect{Operation::add,
                  std::make_shared<const Entry>(
                    Entry{address, version_for_add(address.id), request.value, writer.component}),
                  writer.component};
  }
  if (i == entries_.end())
    return missing(request);
  auto& old = *i->second.entry;
  if (request.operation == Operation::remove)
    return Effect{Operation::remove, i->second.entry, writer.component};
  if (!request.last_seen)
    return Failure{FailureKind::inconsistent,
                   name_of(writer) + " cannot overwrite " + to_string(address) +
                     ", which it has never read; " + old.writer + " wrote version " +
                     std::to_string(old.version) + ". Read it first",
                   address};
  if (*request.last_seen != old.version)
    return Failure{FailureKind::inconsistent,
                   name_of(writer) + " cannot overwrite " + to_string(address) + ": it has seen " +
                     "version " + std::to_string(*request.last_seen) + ", but " + old.writer +
                     " has since written version " + std::to_string(old.version) +
                     ". Read it again and redo the change",
                   address};
  if (auto failure = check_type(request))
    return *failure;
  if (request.value.type_name() != old.type_name())
    return Failure{FailureKind::wrong_type,
                   name_of(writer) + " cannot overwrite " + to_string(address) + ", a " +
                     old.type_name() + ", with a " + request.value.type_name() +
                     ". Delete it and add the new one",
                   address};
  return Effect{
    Operation::overwrite,
    std::make_shared<const Entry>(Entry{address, old.version + 1, request.value, writer.component}),
    writer.component};
}

ChangeEventPtr EntryStore::commit(Effect effect, Timestamp now) {
  auto& entry = effect.entry;
  auto event = std::make_shared<ChangeEvent>();
  event->operation = effect.operation;
  event->address = entry->address;
  event->source = std::move(effect.source);
  event->type = entry->value.type_ptr();
  event->version = entry->version;
  event->sequence = ++sequence_;
  event->time = now;
  auto& id = entry->address.id;
  auto& table = types_[entry->type_name()];
  switch (effect.operation) {
    case Operation::add: {
      if (!table.type)
        table.type = entry->value.type_ptr();
      exhume(id);
      table.recency.push_front(entry);
      entries_[id] = {entry, sequence_, table.recency.begin()};
      break;
    }
    case Operation::overwrite: {
      auto& slot = entries_[id];
      *slot.position = entry;
      table.recency.splice(table.recency.begin(), table.recency, slot.position);
      slot.entry = entry;
      slot.written = sequence_;
      break;
    }
    case Operation::remove: {
      auto i = entries_.find(id);
      table.recency.erase(i->second.position);
      bury(id, entry->version);
      entries_.erase(i);
      break;
    }
  }
  return event;
}

Outcome<EntryPtr> EntryStore::read(const std::string& id) const {
  auto i = entries_.find(id);
  if (i != entries_.end())
    return i->second.entry;
  Address address{subarchitecture_, id};
  return Failure{FailureKind::does_not_exist,
                 "there is no entry " + to_string(address) + " to read: " + absence(id), address};
}

std::vector<EntryPtr> EntryStore::read_by_type(const TypeQuery& query) const {
  // The lists of the types asked for, merged by the time of the last write.
  struct Cursor {
    std::uint64_t written;
    Recency::const_iterator at;
    const Recency* list;
    bool operator<(const Cursor& other) const { return written < other.written; }
  };
  std::priority_queue<Cursor> cursors;
  auto push = [&](const Recency& list, Recency::const_iterator at) {
    if (at != list.end())
      cursors.push({entries_.at((*at)->address.id).written, at, &list});
  };
  for (auto& [name, table] : types_)
    if (query.type.empty() || name == query.type ||
        (query.with_derived && table.type->is_a(query.type)))
      push(table.recency, table.recency.begin());
  std::vector<EntryPtr> result;
  while (!cursors.empty() && (query.count == 0 || result.size() < query.count)) {
    auto next = cursors.top();
    cursors.pop();
    result.push_back(*next.at);
    push(*next.list, std::next(next.at));
  }
  return result;
}

Outcome<Version> EntryStore::version(const std::string& id) const {
  if (auto i = entries_.find(id); i != entries_.end())
    return i->second.entry->version;
  if (auto i = tombstones_.find(id); i != tombstones_.end())
    return i->second.version;
  Address address{subarchitecture_, id};
  return Failure{FailureKind::does_not_exist,
                 "there is no version of " + to_string(address) + ": " + absence(id), address};
}

std::string EntryStore::absence(const std::string& id) const {
  if (tombstones_.count(id) > 0)
    return "it was deleted";
  std::string result = "nothing was added there";
  if (floor_ > 0)
    result += ", or it was deleted too long ago to be remembered";
  return result;
}

Failure EntryStore::missing(const WriteRequest& request) const {
  auto& address = request.address;
  return {FailureKind::does_not_exist,
          name_of(request.writer) + " cannot " + std::string{verb(request.operation)} + " " +
            to_string(address) + ": " + absence(address.id) +
            (request.operation == Operation::overwrite ? ". Add it first" : ""),
          address};
}

std::optional<Failure> EntryStore::check_type(const WriteRequest& request) const {
  auto i = types_.find(request.value.type_name());
  if (i == types_.end() || !i->second.type || i->second.type->hash == request.value.type().hash)
    return std::nullopt;
  return Failure{FailureKind::wrong_type,
                 name_of(request.writer) + " cannot " + std::string{verb(request.operation)} + " " +
                   to_string(request.address) + ": it says " + to_string(request.value.type()) +
                   ", but " + subarchitecture_ + " knows " + to_string(*i->second.type) +
                   ". Build both sides from one declaration",
                 request.address};
}

Version EntryStore::version_for_add(const std::string& id) const {
  auto i = tombstones_.find(id);
  return i == tombstones_.end() ? floor_ : i->second.version + 1;
}

void EntryStore::bury(const std::string& id, Version version) {
  tombstones_[id] = {version, burials_.insert(burials_.end(), id)};
  if (burials_.size() <= options_.remembered_deletions)
    return;
  auto oldest = tombstones_.find(burials_.front());
  floor_ = std::max(floor_, oldest->second.version + 1);
  tombstones_.erase(oldest);
  burials_.pop_front();
}

void EntryStore::exhume(const std::string& id) {
  auto i = tombstones_.find(id);
  if (i == tombstones_.end())
    return;
  burials_.erase(i->second.burial);
  tombstones_.erase(i);
}

} // namespace castor
