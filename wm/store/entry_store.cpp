#include "castor/wm/store/entry_store.hpp"

#include "castor/wm/filters/bound_predicate.hpp"
#include "castor/wm/store/value_limit.hpp"

#include <algorithm>
#include <queue>
#include <set>
#include <string_view>
#include <utility>

namespace castor {

namespace {

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

/// Why a change that counts on another version than there is cannot be made.
Failure outdated(const WriteRequest& request, const Entry& there) {
  auto seen = *request.last_seen;
  auto& address = request.address;
  return {FailureKind::inconsistent,
          to_string(*request.client) + " cannot " + std::string{verb(request.operation)} + ' ' +
            to_string(address) + ": it has seen version " + std::to_string(seen) + ", but " +
            there.writer + (seen < there.version ? " has since written" : " wrote") + " version " +
            std::to_string(there.version) + ". Read it again and redo the change",
          address};
}

} // namespace

EntryStore::EntryStore(std::string subarchitecture, EntryStoreOptions options)
  : subarchitecture_(std::move(subarchitecture)), options_(std::move(options)),
    access_(subarchitecture_),
    entries_(options_.entries ? options_.entries : std::make_shared<EntryTable>()),
    tombstones_(options_.remembered_deletions, options_.first_version) {}

void EntryStore::restore(const StoreImage& image, Timestamp now, UnixTime time) {
  for (auto& x : image.entries) {
    auto& id = x.entry->address.id;
    auto& table = types_[x.entry->type_name()];
    table.type = x.entry->value.type_ptr();
    auto time_to_live = x.entry->life.time_to_live;
    auto ephemeral = x.entry->life.ephemeral;
    bool may_end = time_to_live.count() > 0 || ephemeral;
    // The clock that tells the time since 1970 may have been set back.
    if (may_end)
      lifetimes_.add(id, time_to_live, nullptr, now - std::max(Timestamp{0}, time - x.time));
    if (ephemeral)
      lifetimes_.orphan(id, now);
    table.recency.add(entries_->insert(x.entry, x.sequence, may_end));
  }
  for (auto& [id, version] : image.deleted)
    tombstones_.add(id, version, image.sequence);
  tombstones_.raise_floor(image.floor);
  sequence_ = image.sequence;
}

Outcome<EntryStore::Effect> EntryStore::prepare(const WriteRequest& request) const {
  auto& client = *request.client;
  auto& address = request.address;
  if (auto failure = check_address(request))
    return *failure;
  if (!may_write(request))
    return Failure{FailureKind::not_permitted,
                   to_string(client) + " may not " + std::string{verb(request.operation)} + " " +
                     to_string(address) + ": only components of " + subarchitecture_ +
                     " write there. To allow it, put ACCESS " + client.subarchitecture +
                     " WRITES " + subarchitecture_ +
                     " into the system's .cast file, or run it with --open-access",
                   address};
  auto* there = entries_->find(address.id);
  if (request.operation == Operation::add) {
    if (there)
      return Failure{FailureKind::already_exists,
                     to_string(client) + " cannot add " + to_string(address) + ": " +
                       there->entry->writer + " put a " + there->entry->type_name() +
                       " there. Overwrite it, or add under a new id",
                     address};
    if (auto failure = check_value(request))
      return *failure;
    if (auto failure = check_will(request))
      return *failure;
    auto life = request.life.value_or(EntryLife{});
    if (life.only_once && tombstones_.contains(address.id))
      return Failure{FailureKind::already_exists,
                     to_string(client) + " cannot add " + to_string(address) +
                       ": its id was used before, and this entry may be added only once",
                     address};
    return Effect{
      Operation::add,
      std::make_shared<const Entry>(Entry{address, tombstones_.version_for_add(address.id),
                                          request.value, client.component, life}),
      client.component,
      {},
      life.ephemeral ? request.client : nullptr,
      request.last_will ? request.client : nullptr,
      request.last_will};
  }
  if (!there)
    return missing(request);
  auto& old = *there->entry;
  if (request.operation == Operation::remove) {
    // Components delete whatever is there; operators may name the version that they mean.
    if (request.last_seen && *request.last_seen != old.version)
      return outdated(request, old);
    return Effect{Operation::remove, there->entry, client.component};
  }
  if (!request.last_seen)
    return Failure{FailureKind::inconsistent,
                   to_string(client) + " cannot overwrite " + to_string(address) +
                     ", which it has never read; " + old.writer + " wrote version " +
                     std::to_string(old.version) + ". Read it first",
                   address};
  if (*request.last_seen != old.version)
    return outdated(request, old);
  if (request.expected && old.writer != client.component)
    return Failure{FailureKind::inconsistent,
                   to_string(client) + " cannot overwrite " + to_string(address) +
                     ": an earlier write that this one depends on has failed, and version " +
                     std::to_string(old.version) + " is by " + old.writer +
                     ". Read it again and redo the change",
                   address};
  if (auto failure = check_value(request))
    return *failure;
  if (request.value.type_name() != old.type_name())
    return Failure{FailureKind::wrong_type,
                   to_string(client) + " cannot overwrite " + to_string(address) + ", a " +
                     old.type_name() + ", with a " + request.value.type_name() +
                     ". Delete it and add the new one",
                   address};
  if (auto failure = check_will(request))
    return *failure;
  return Effect{
    Operation::overwrite,
    std::make_shared<const Entry>(Entry{address, old.version + 1, request.value, client.component,
                                        request.life.value_or(old.life)}),
    client.component,
    there->entry,
    {},
    request.last_will ? request.client : nullptr,
    request.last_will};
}

std::optional<Failure> EntryStore::check_atomic(std::span<const WriteRequest> requests) const {
  for (auto& request : requests)
    if (request.address.subarchitecture != subarchitecture_)
      return Failure{FailureKind::not_atomic,
                     to_string(*request.client) + " cannot write " + to_string(request.address) +
                       " and entries of " + subarchitecture_ +
                       " at once: an atomic write stays within one working memory",
                     request.address};
  if (requests.size() < 2)
    return std::nullopt;
  std::set<std::string_view> ids;
  for (auto& request : requests)
    if (!ids.insert(request.address.id).second)
      return Failure{FailureKind::not_atomic,
                     to_string(*request.client) + " cannot write " + to_string(request.address) +
                       " twice in one atomic write",
                     request.address};
  return std::nullopt;
}

std::shared_ptr<ChangeEvent> EntryStore::commit(Effect effect, Timestamp now) {
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
      tombstones_.erase(id);
      auto time_to_live = entry->life.time_to_live;
      bool may_end = time_to_live.count() > 0 || effect.owner || effect.last_will;
      if (may_end)
        lifetimes_.add(id, time_to_live, std::move(effect.owner), now);
      if (effect.last_will)
        lifetimes_.set_will(id, std::move(effect.testator), *std::move(effect.last_will));
      table.recency.add(entries_->insert(entry, sequence_, may_end));
      break;
    }
    case Operation::overwrite: {
      auto time_to_live = entry->life.time_to_live;
      bool may_end = false;
      entries_->change(id, [&](EntryTable::Slot& slot) {
        table.recency.remove(slot);
        table.recency.add(slot);
        slot.entry = entry;
        slot.set_written(sequence_);
        slot.may_end = slot.may_end || time_to_live.count() > 0 || effect.last_will;
        may_end = slot.may_end;
      });
      if (event->source == last_will_source)
        lifetimes_.fulfil(id, time_to_live, now);
      else if (may_end)
        lifetimes_.restart(id, time_to_live, now);
      if (effect.last_will)
        lifetimes_.set_will(id, std::move(effect.testator), *std::move(effect.last_will));
      break;
    }
    case Operation::remove: {
      entries_->change(id, [&](EntryTable::Slot& slot) {
        table.recency.remove(slot);
        if (slot.may_end)
          lifetimes_.erase(id);
      });
      tombstones_.add(id, entry->version, sequence_);
      entries_->erase(id);
      break;
    }
  }
  return event;
}

EntryStore::Effect EntryStore::prepare_due(const std::string& id) const {
  auto there = entries_->find(id)->entry;
  auto* will = lifetimes_.due_will(id);
  if (!will)
    return {Operation::remove, there, lifetimes_.source(id)};
  return {Operation::overwrite,
          std::make_shared<const Entry>(Entry{there->address, there->version + 1, will->value,
                                              lifetimes_.owner(id)->component, will->life}),
          lifetimes_.source(id), there};
}

std::optional<Failure> EntryStore::check_may_read(const ClientPtr& client,
                                                  const Address& address) const {
  if (!client || access_.may_read(client->subarchitecture))
    return std::nullopt;
  return Failure{FailureKind::not_permitted,
                 to_string(*client) + " may not read " +
                   (address.id.empty() ? "entries of " + subarchitecture_ : to_string(address)) +
                   ": " + access_.readers_text(client->subarchitecture),
                 address};
}

bool EntryStore::may_write(const WriteRequest& request) const {
  auto& writer = request.client->subarchitecture;
  if (access_.may_write(writer))
    return true;
  if (request.operation != Operation::overwrite || writer == operators)
    return false;
  auto* there = entries_->find(request.address.id);
  return there && there->entry->life.writable_by_all;
}

Outcome<EntryPtr> EntryStore::read(const std::string& id) const {
  if (auto* there = entries_->find(id))
    return there->entry;
  Address address{subarchitecture_, id};
  return Failure{FailureKind::does_not_exist,
                 "there is no entry " + to_string(address) + " to read: " + absence(id), address};
}

std::vector<EntryPtr> EntryStore::read_by_type(const TypeQuery& query) const {
  // The slots of the types asked for, merged by the time of the last write.
  struct Cursor {
    const EntrySlot* at;
    std::shared_ptr<const BoundPredicate> predicate;
    bool operator<(const Cursor& other) const { return at->written < other.at->written; }
  };
  std::priority_queue<Cursor> cursors;
  auto push = [&](Cursor cursor) {
    while (cursor.at && !cursor.predicate->matches(cursor.at->entry->value))
      cursor.at = cursor.at->older;
    if (cursor.at)
      cursors.push(std::move(cursor));
  };
  for (auto& [name, table] : types_) {
    bool wanted = query.type.empty() || name == query.type ||
                  (query.with_derived && table.type->is_a(query.type));
    if (!wanted || !table.recency.newest())
      continue;
    if (auto bound = BoundPredicate::try_bind(query.predicate.tree(), *table.type))
      push({table.recency.newest(), std::make_shared<const BoundPredicate>(*std::move(bound))});
  }
  std::vector<EntryPtr> result;
  while (!cursors.empty() && (query.count == 0 || result.size() < query.count)) {
    auto next = cursors.top();
    cursors.pop();
    result.push_back(next.at->entry);
    next.at = next.at->older;
    push(std::move(next));
  }
  return result;
}

std::map<std::string, std::uint64_t> EntryStore::counts_by_type() const {
  std::map<std::string, std::uint64_t> result;
  for (auto& [name, table] : types_)
    if (table.recency.size() > 0)
      result[name] = table.recency.size();
  return result;
}

Outcome<Version> EntryStore::version(const std::string& id) const {
  if (auto* there = entries_->find(id))
    return there->entry->version;
  if (auto last = tombstones_.version(id))
    return *last;
  Address address{subarchitecture_, id};
  return Failure{FailureKind::does_not_exist,
                 "there is no version of " + to_string(address) + ": " + absence(id), address};
}

std::string EntryStore::absence(const std::string& id) const {
  if (tombstones_.contains(id))
    return "it was deleted";
  std::string result = "nothing was added there";
  if (tombstones_.floor() > options_.first_version)
    result += ", or it was deleted too long ago to be remembered";
  return result;
}

Failure EntryStore::missing(const WriteRequest& request) const {
  auto& address = request.address;
  return {FailureKind::does_not_exist,
          to_string(*request.client) + " cannot " + std::string{verb(request.operation)} + " " +
            to_string(address) + ": " + absence(address.id) +
            (request.operation == Operation::overwrite ? ". Add it first" : ""),
          address};
}

std::optional<Failure> EntryStore::check_address(const WriteRequest& request) const {
  if (!request.address.id.empty())
    return std::nullopt;
  return Failure{FailureKind::bad_address,
                 to_string(*request.client) + " cannot " + std::string{verb(request.operation)} +
                   " an entry of " + subarchitecture_ + " without an id; new_id() makes one",
                 request.address};
}

std::optional<Failure> EntryStore::check_value(const WriteRequest& request) const {
  if (auto failure = value_too_large(request, subarchitecture_, options_.largest_value))
    return failure;
  return check_type(request);
}

std::optional<Failure> EntryStore::check_will(const WriteRequest& request) const {
  auto& will = request.last_will;
  if (!will || !will->value.has_value() || will->value.type().hash == request.value.type().hash)
    return std::nullopt;
  return Failure{FailureKind::wrong_type,
                 to_string(*request.client) + " cannot leave a will for " +
                   to_string(request.address) + ", a " + request.value.type_name() +
                   ", that is a " + will->value.type_name() + ". A will has the entry's type",
                 request.address};
}

std::optional<Failure> EntryStore::check_type(const WriteRequest& request) const {
  auto i = types_.find(request.value.type_name());
  if (i == types_.end() || !i->second.type || i->second.type->hash == request.value.type().hash)
    return std::nullopt;
  return Failure{FailureKind::wrong_type,
                 to_string(*request.client) + " cannot " + std::string{verb(request.operation)} +
                   " " + to_string(request.address) + ": it says " +
                   to_string(request.value.type()) + ", but " + subarchitecture_ + " knows " +
                   to_string(*i->second.type) + ". Build both sides from one declaration",
                 request.address};
}

} // namespace castor
