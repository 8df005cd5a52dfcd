#include "castor/wm/memory/working_memory.hpp"

#include "castor/wm/memory/working_memory_parts.hpp"

#include <utility>

namespace castor {

namespace working_memory_parts {

Timestamp now(Self self) {
  auto& state = self->state;
  return std::chrono::duration_cast<Timestamp>(self->clock().now() - state.options.epoch) +
         state.clock_jump;
}

const WorkingMemoryActor* find_peer(const WorkingMemoryState& state, const std::string& name) {
  for (auto& peer : state.peers)
    if (!peer.removed && peer.subarchitecture == name)
      return &peer.actor;
  return nullptr;
}

Failure unknown_subarchitecture(const WorkingMemoryState& state, const Address& address) {
  if (state.absent.count(address.subarchitecture) > 0)
    return {FailureKind::working_memory_lost,
            "the working memory of " + address.subarchitecture + " is lost, and not back yet",
            address};
  std::string known = state.options.subarchitecture;
  for (auto& peer : state.peers)
    if (!peer.removed)
      known += ", " + peer.subarchitecture;
  if (address.subarchitecture.empty())
    return {FailureKind::bad_address, "an address without a subarchitecture; there are: " + known,
            address};
  return {FailureKind::unknown_subarchitecture,
          "there is no subarchitecture " + address.subarchitecture + "; there are: " + known,
          address};
}

void monitor(Self self, const caf::strong_actor_ptr& who) {
  if (self->state.monitored.insert(caf::actor_cast<caf::actor_addr>(who)).second)
    self->monitor(who);
}

namespace {

void note_change(WorkingMemoryState& state, const ChangeEvent& x) {
  auto what = x.operation == Operation::add         ? &Usage::adds
              : x.operation == Operation::overwrite ? &Usage::overwrites
                                                    : &Usage::deletes;
  state.usage.record(x.source, x.address.subarchitecture, x.type_name(), what);
}

} // namespace

void allow_writers(WorkingMemoryState& state, const std::set<std::string>& writers) {
  for (auto& writer : writers) {
    if (writer == "*")
      state.store.access().allow_all();
    else
      state.store.access().allow(writer);
  }
}

void commit(Self self, std::vector<EntryStore::Effect> effects) {
  auto& state = self->state;
  auto time = now(self);
  std::vector<Change> changes;
  changes.reserve(effects.size());
  for (auto& effect : effects) {
    if (effect.owner)
      remember_client(self, effect.owner);
    Change change{nullptr, effect.entry, effect.before};
    change.event = state.store.commit(std::move(effect), time);
    note_change(state, *change.event);
    if (change.event->operation == Operation::remove)
      state.leases.erase(change.event->address.id);
    changes.push_back(std::move(change));
  }
  if (state.journal)
    write_down(self, changes);
  emit(self, changes);
  settle(self);
  set_alarm(self);
}

} // namespace working_memory_parts

namespace {

using namespace working_memory_parts;

Outcome<Version> write(Self self, const WriteRequest& request) {
  auto& state = self->state;
  catch_up(self);
  auto refused = check_leases(state, request);
  auto effect = refused ? Outcome<EntryStore::Effect>{*refused} : state.store.prepare(request);
  if (!effect) {
    ++state.counters.refused;
    return effect.failure();
  }
  auto version = effect->entry->version;
  std::vector<EntryStore::Effect> effects;
  effects.push_back(*std::move(effect));
  commit(self, std::move(effects));
  return version;
}

Outcome<std::vector<Version>> write_all(Self self, const BatchRequest& request) {
  auto& state = self->state;
  catch_up(self);
  auto effects = state.store.prepare(request.writes);
  if (effects)
    for (auto& x : request.writes)
      if (auto refused = check_leases(state, x)) {
        effects = *refused;
        break;
      }
  if (!effects) {
    ++state.counters.refused;
    return effects.failure();
  }
  std::vector<Version> versions;
  for (auto& effect : *effects)
    versions.push_back(effect.entry->version);
  commit(self, *std::move(effects));
  return versions;
}

WorkingMemoryStatus status(const WorkingMemoryState& state) {
  auto result = state.counters;
  result.subarchitecture = state.options.subarchitecture;
  result.entries = state.store.size();
  result.filters = state.local_index.size();
  result.events = state.store.sequence();
  result.leases = state.leases.size();
  result.waiting = state.waits.size();
  result.journal = state.journal_status;
  result.journal.unsynced = state.gate.unsynced();
  result.journal.held = state.gate.waiting();
  auto add = [&](const EventBacklog& x) {
    result.backlog += x.size();
    result.suppressed += x.suppressed();
  };
  for (auto& [number, subscriber] : state.subscribers)
    add(subscriber.flow.backlog());
  for (auto& route : state.routes)
    add(route.flow.backlog());
  for (auto& entry : state.store.read_by_type({}))
    ++result.entries_by_type[entry->type_name()];
  return result;
}

} // namespace

WorkingMemoryActor::behavior_type working_memory(Self self, WorkingMemoryOptions options) {
  auto& state = self->state;
  // A journal knows which numbers there were.
  if (!options.opened_journal || !options.opened_journal->failure.empty()) {
    auto first = (options.incarnation - 1) * numbers_per_life;
    options.store.first_version = first;
    options.leases.first_token = first + 1;
  }
  state.store = EntryStore{options.subarchitecture, options.store};
  state.leases = LeaseTable{options.leases};
  // What is on its way to a former life is nothing that this one has asked for.
  state.last_interest = static_cast<InterestId>((options.incarnation - 1) << 20);
  allow_writers(state, options.writers);
  state.options = std::move(options);
  if (state.options.opened_journal)
    begin_journal(self);
  self->set_down_handler([self](const caf::down_msg& x) {
    self->state.monitored.erase(x.source);
    end_subscriber(self, x.source);
    end_route(self, x.source);
    end_client(self, x.source);
  });
  return {
    [self](const WriteRequest& x) {
      return at_owner<Version>(self, x.address, x, [&] { return write(self, x); });
    },
    [self](const BatchRequest& x) {
      return at_owner<std::vector<Version>>(self, {x.subarchitecture, {}}, x,
                                            [&] { return write_all(self, x); });
    },
    [self](const ReadRequest& x) {
      return at_owner<EntryPtr>(self, x.address, x, [&] { return read(self, x); });
    },
    [self](const QueryRequest& x) {
      return at_owner<std::vector<EntryPtr>>(self, {x.query.subarchitecture, {}}, x,
                                             [&] { return query(self, x); });
    },
    [self](const ExistsQuery& x) {
      return at_owner<bool>(self, x.address, x, [&] {
        catch_up(self);
        return Outcome<bool>{self->state.store.exists(x.address.id)};
      });
    },
    [self](const VersionQuery& x) {
      return at_owner<Version>(self, x.address, x, [&] {
        catch_up(self);
        return self->state.store.version(x.address.id);
      });
    },
    [self](const LockRequest& x) {
      return at_owner<Lease>(self, x.address, x, [&] { return lock(self, x); });
    },
    [self](const UnlockRequest& x) {
      return at_owner<Acknowledged>(self, x.address, x, [&] { return unlock(self, x); });
    },
    [self](const CancelWait& x) { cancel(self, x); },
    [self](const RenewRequest& x) { return say_reply<RenewReply>(self, renew(self, x)); },
    [self](const LockQuery& x) {
      return at_owner<LockStatus>(self, x.address, x, [&] {
        catch_up(self);
        return lock_status(self->state, x.address);
      });
    },
    [self](const DeadlockProbe& x) { follow(self, x); },
    [self](WakeUp) {
      self->state.alarm = Timestamp::max();
      catch_up(self);
      set_alarm(self);
    },
    [self](const JumpClock& x) {
      self->state.clock_jump += x.by;
      self->state.alarm = Timestamp::max();
      catch_up(self);
      set_alarm(self);
    },
    [self](const JournalFault& x) {
      if (auto& journal = self->state.journal)
        caf::anon_send(journal, x);
    },
    [self](const Subscribe& x) { return subscribe(self, x); },
    [self](const Unsubscribe& x) { unsubscribe(self, x); },
    [self](const EventsTaken& x) { acknowledge(self, x); },
    [self](const Interest& x) {
      set_interest(self->state, caf::actor_cast<caf::actor_addr>(self->current_sender()), x);
      return Acknowledged{};
    },
    [self](const ForwardedEvents& x) { receive_forwarded(self, x); },
    [self](const Peers& x) {
      allow_writers(self->state, x.writers);
      return introduce(self, x);
    },
    [self](const JournalNews& x) { hear_of_journal(self, x); },
    [self](StatusQuery) { return status(self->state); },
    [self](UsageQuery) { return UsageReport{self->state.usage.all()}; },
  };
}

} // namespace castor
