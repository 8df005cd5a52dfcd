#include "castor/actors/runtime/component_operations.hpp"

#include "castor/actors/runtime/injected_faults.hpp"
#include "castor/base/log.hpp"

#include <memory>
#include <string>
#include <utility>

namespace castor {

namespace {

/// Gives a reply's slot back when nobody takes the reply.
class Claim {
public:
  Claim(OperationsClient& client, std::uint64_t id, Address address)
    : client_(client), id_(id), address_(std::move(address)) {}
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  ~Claim() {
    if (id_ != 0)
      client_.abandon(id_, address_);
  }

  std::uint64_t take() { return std::exchange(id_, 0); }

private:
  OperationsClient& client_;
  std::uint64_t id_;
  Address address_;
};

const char* name_of(Operation x) {
  switch (x) {
    case Operation::add:
      return "add";
    case Operation::overwrite:
      return "overwrite";
    case Operation::remove:
      break;
  }
  return "delete";
}

std::string result_of(const char* operation, const Address& address) {
  return "the callback for the result of " + std::string{operation} + " " + to_string(address);
}

} // namespace

// -- results

template <class T>
Pending<T> ComponentOperations::pending(std::uint64_t id, const char* what, const Address& address,
                                        std::function<T()> finish) {
  if (parts_.waits)
    // Captures that need no memory: most operations are finished by `get`.
    return Pending<T>{std::move(finish), [this, id](std::function<void()> f) {
                        auto file = [this, f = std::move(f)] {
                          parts_.inbox.put(Inbox::Task{"the callback for a result", f});
                        };
                        id == 0 ? file() : parts_.client.on_answer(id, std::move(file));
                      }};
  auto opened = open(id, what, address, finish);
  auto finish_settled = [this, id, finish = std::move(finish), address] {
    parts_.client.check_settled(id, address);
    return finish();
  };
  return Pending<T>{std::move(finish_settled),
                    [opened](std::function<void()> f) { opened->call_back = std::move(f); }};
}

OpenOperations::OpenPtr ComponentOperations::open(std::uint64_t id, const char* what,
                                                  const Address& address,
                                                  std::function<void()> finish) {
  OpenOperations::Open x{id, result_of(what, address), std::move(finish)};
  if (id == 0)
    return parts_.open.begin_done(std::move(x));
  // Longer than the working memory's own patience, whose reply knows more.
  constexpr std::chrono::seconds grace{1};
  auto result = parts_.open.begin(std::move(x), ComponentContext::Clock::now() +
                                                  parts_.context.deadline() + grace);
  parts_.client.on_answer(id, [this, id] { parts_.open.answered(id); });
  return result;
}

// -- writing

WriteRequest ComponentOperations::write_request(Operation operation, const Address& address,
                                                Value value, std::optional<EntryLife> life) const {
  auto seen = operation == Operation::overwrite ? seen_.find(address) : std::nullopt;
  // What has to be encoded on its way is encoded here: in the own working memory, which hands it
  // on, others would wait for that.
  if (operation != Operation::remove &&
      address.subarchitecture != parts_.context.identity().subarchitecture &&
      parts_.context.is_in_another_process(address.subarchitecture))
    value.bytes();
  return {operation,
          address,
          std::move(value),
          seen ? std::optional{seen->version} : std::nullopt,
          parts_.context.client(),
          parts_.context.leases().token(address),
          life,
          seen && seen->expected};
}

void ComponentOperations::remember_write(Operation operation, const Address& address,
                                         Version version) {
  auto& counters = parts_.context.counters();
  switch (operation) {
    case Operation::add:
      ++counters.adds;
      seen_.set(address, version);
      break;
    case Operation::overwrite:
      ++counters.overwrites;
      seen_.set(address, version);
      break;
    case Operation::remove:
      ++counters.deletes;
      seen_.erase(address);
      parts_.context.leases().forget(address);
      break;
  }
}

Pending<Version> ComponentOperations::write(Operation operation, const Address& address,
                                            Value value, std::optional<EntryLife> life) {
  auto request = write_request(operation, address, std::move(value), life);
  auto last_seen = request.last_seen;
  auto expected = request.expected;
  auto id = parts_.client.begin(request);
  // The next operation in the pipeline counts on this one; should it fail, so will they.
  if (last_seen)
    seen_.set(address, *last_seen + 1, true);
  auto claim = std::make_shared<Claim>(parts_.client, id, address);
  return pending<Version>(
    id, name_of(operation), address, [this, claim, operation, address, last_seen, expected] {
      auto seen_meanwhile = seen_.find(address);
      auto outcome = parts_.client.finish<Version>(claim->take(), address);
      if (!outcome) {
        if (last_seen && seen_meanwhile && seen_meanwhile->expected &&
            seen_meanwhile->version > *last_seen)
          seen_.set(address, *last_seen, expected);
        throw_failure(outcome.failure());
      }
      remember_write(operation, address, *outcome);
      // Of several overwrites in flight, the latest counts.
      if (operation == Operation::overwrite && seen_meanwhile && seen_meanwhile->version > *outcome)
        seen_.set(address, seen_meanwhile->version, seen_meanwhile->expected);
      return *outcome;
    });
}

Pending<std::vector<Version>> ComponentOperations::write(const WriteBatch& batch) {
  auto& items = batch.items();
  Address where{items.empty() ? std::string{} : items.front().address.subarchitecture, {}};
  BatchRequest request{where.subarchitecture, {}};
  for (auto& x : items) {
    request.writes.push_back(write_request(x.operation, x.address, x.value, x.life));
    request.writes.back().last_will = x.last_will;
  }
  if (items.empty())
    return pending<std::vector<Version>>(0, "write", where, [] { return std::vector<Version>{}; });
  auto id = parts_.client.begin(request);
  auto claim = std::make_shared<Claim>(parts_.client, id, where);
  return pending<std::vector<Version>>(id, "write", where, [this, claim, where, items] {
    auto versions =
      value_or_throw(parts_.client.finish<std::vector<Version>>(claim->take(), where));
    for (std::size_t i = 0; i < items.size(); ++i)
      remember_write(items[i].operation, items[i].address, versions[i]);
    return versions;
  });
}

// -- reading

Pending<EntryPtr> ComponentOperations::read(const Address& address) {
  if (!parts_.waits)
    if (auto entry = parts_.client.read_here(address)) {
      note_read(*entry);
      return pending<EntryPtr>(0, "read", address, [entry] { return entry; });
    }
  auto patience = parts_.client.patience(parts_.context.deadline());
  auto id = parts_.client.begin(ReadRequest{address, patience});
  auto claim = std::make_shared<Claim>(parts_.client, id, address);
  return pending<EntryPtr>(id, "read", address, [this, claim, address, patience] {
    WaitEdge wait;
    wait.kind = WaitEdge::Kind::read;
    wait.address = address;
    wait.what = "waits to read " + to_string(address);
    auto outcome = parts_.client.finish_wait<EntryPtr>(claim->take(), std::move(wait), patience);
    if (!outcome) {
      if (outcome.failure().kind == FailureKind::does_not_exist)
        seen_.erase(address);
      throw_failure(outcome.failure());
    }
    note_read(**outcome);
    return *outcome;
  });
}

void ComponentOperations::note_read(const Entry& entry) {
  ++parts_.context.counters().reads;
  seen_.set(entry.address, entry.version);
}

EntryPtr ComponentOperations::read_now(const Address& address) {
  auto entry = parts_.client.read_here(address);
  if (!entry)
    return read(address).get();
  note_read(*entry);
  return entry;
}

Pending<std::vector<EntryPtr>> ComponentOperations::query(TypeQuery query) {
  WaitEdge wait;
  wait.kind = WaitEdge::Kind::read;
  wait.address = {query.subarchitecture, {}};
  wait.what = "waits to read every " + query.type + " of " + query.subarchitecture;
  auto where = wait.address;
  auto patience = parts_.client.patience(parts_.context.deadline());
  auto id = parts_.client.begin(QueryRequest{std::move(query), patience});
  auto claim = std::make_shared<Claim>(parts_.client, id, where);
  return pending<std::vector<EntryPtr>>(id, "query", where, [this, claim, wait, patience] {
    auto entries = value_or_throw(
      parts_.client.finish_wait<std::vector<EntryPtr>>(claim->take(), wait, patience));
    parts_.context.counters().reads += entries.size();
    for (auto& entry : entries)
      seen_.set(entry->address, entry->version);
    return entries;
  });
}

Pending<bool> ComponentOperations::exists(const Address& address) {
  auto id = parts_.client.begin(ExistsQuery{address, parts_.context.client()});
  auto claim = std::make_shared<Claim>(parts_.client, id, address);
  return pending<bool>(id, "exists", address, [this, claim, address] {
    return value_or_throw(parts_.client.finish<bool>(claim->take(), address));
  });
}

Pending<Version> ComponentOperations::version(const Address& address) {
  auto id = parts_.client.begin(VersionQuery{address, parts_.context.client()});
  auto claim = std::make_shared<Claim>(parts_.client, id, address);
  return pending<Version>(id, "version", address, [this, claim, address] {
    return value_or_throw(parts_.client.finish<Version>(claim->take(), address));
  });
}

// -- leases

void ComponentOperations::lock(const Address& address, LockLevel level,
                               std::optional<std::chrono::nanoseconds> timeout) {
  auto patience = parts_.client.patience(timeout.value_or(parts_.context.deadline()));
  WaitEdge wait;
  wait.kind = WaitEdge::Kind::lock;
  wait.address = address;
  wait.what = "waits to lock " + to_string(address);
  auto lease = value_or_throw(parts_.client.finish_wait<Lease>(
    parts_.client.begin(LockRequest{address, level, patience, true}), std::move(wait), patience));
  parts_.context.leases().add(address, lease.token);
}

bool ComponentOperations::try_lock(const Address& address, LockLevel level) {
  auto outcome = parts_.client.finish<Lease>(
    parts_.client.begin(LockRequest{address, level, parts_.client.patience({})}), address);
  if (!outcome && outcome.failure().kind == FailureKind::leased)
    return false;
  parts_.context.leases().add(address, value_or_throw(std::move(outcome)).token);
  return true;
}

void ComponentOperations::unlock(const Address& address) {
  if (auto token = lease(address); token != 0)
    release(address, token);
}

std::optional<LockLevel> ComponentOperations::level_of_others(const Address& address) {
  auto status = value_or_throw(
    parts_.client.finish<LockStatus>(parts_.client.begin(LockQuery{address}), address));
  return status.holder && !(*status.holder == *parts_.context.client()) ? status.level
                                                                        : std::nullopt;
}

LeaseToken ComponentOperations::lease(const Address& address) const {
  return parts_.context.leases().token(address);
}

bool ComponentOperations::holds(const Address& address, LeaseToken token) const {
  auto x = parts_.context.leases().find(address);
  return x && x->token == token && !x->lost;
}

void ComponentOperations::release(const Address& address, LeaseToken token) {
  if (parts_.context.leases().release(address, token))
    value_or_throw(parts_.client.try_unlock(address, token));
}

void ComponentOperations::release_quietly(const Address& address, LeaseToken token) {
  if (!parts_.context.leases().release(address, token))
    return;
  try {
    auto outcome = parts_.client.try_unlock(address, token);
    if (!outcome)
      log_runtime(LogLevel::warning, parts_.context.identity().full_name(),
                  "a lease did not last as long as its guard: " + outcome.failure().message);
  } catch (const InjectedCrash&) {
    // It comes again where it can be thrown.
  }
}

// -- change events

FilterId ComponentOperations::subscribe(const ChangeFilter& filter, EventStream stream) {
  auto& identity = parts_.context.identity();
  Subscribe request{++last_filter_, filter, stream};
  request.component = identity.name;
  // The option is about the component's own queue.
  if (stream == EventStream::component)
    request.queue_limit = parts_.queue_limit;
  Address where{filter.subarchitecture.value_or(identity.subarchitecture), filter.id};
  auto id = parts_.client.begin(request);
  auto finish = [this, id, where] {
    value_or_throw(parts_.client.finish<Acknowledged>(id, where));
  };
  if (parts_.waits)
    finish();
  else
    open(id, "subscribe to", where, finish);
  return request.id;
}

ReceiverId ComponentOperations::add_receiver(const ChangeFilter& filter, ChangeCallback callback,
                                             Priority priority) {
  // Events may arrive before the answer does.
  auto id = last_filter_ + 1;
  parts_.receivers.add(id, std::move(callback), priority);
  if (parts_.receivers.is_broadcast() && filter.predicate.empty()) {
    auto own = filter;
    if (!own.subarchitecture)
      own.subarchitecture = parts_.context.identity().subarchitecture;
    parts_.receivers.add_filter(id, own);
    return last_filter_ = id;
  }
  try {
    return subscribe(filter, EventStream::component);
  } catch (const WorkingMemoryException&) {
    parts_.receivers.remove(id);
    throw;
  }
}

void ComponentOperations::receive_broadcasts() {
  parts_.receivers.set_broadcast(last_filter_ + 1);
  subscribe(any_change().anywhere(), EventStream::component);
}

void ComponentOperations::add_listener(const ChangeFilter& filter, ChangeCallback f) {
  parts_.receivers.add_listener(last_filter_ + 1, std::move(f));
  subscribe(filter, EventStream::runtime);
}

void ComponentOperations::remove_receiver(ReceiverId id) {
  if (parts_.receivers.remove(id))
    parts_.client.send(Unsubscribe{id});
}

std::size_t ComponentOperations::receiver_count() const {
  return parts_.receivers.size();
}

void ComponentOperations::receive_changes(bool on) {
  parts_.inbox.receive_changes(on);
}

} // namespace castor
