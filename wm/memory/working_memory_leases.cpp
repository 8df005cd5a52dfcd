#include "castor/wm/memory/working_memory_parts.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace castor::working_memory_parts {

namespace {

std::string describe(const LeaseTable::Holding& x) {
  return to_string(*x.holder) + " holds a lease of level " + std::string{to_string(x.lease.level)} +
         " on it";
}

std::string verb(Operation x) {
  return x == Operation::overwrite ? "overwrite" : "delete";
}

/// Why a wait failed.
Failure failed_wait(const WorkingMemoryState& state, const SettledWait& settled,
                    const ClientPtr& client, const Address& address, const std::string& verb) {
  auto who = to_string(*client);
  if (settled.result == SettledWait::Result::deleted)
    return {FailureKind::does_not_exist,
            to_string(address) + " was deleted while " + who + " waited to " + verb + " it",
            address};
  auto* holding = state.leases.holding(address.id);
  return {FailureKind::no_answer,
          who + " could not " + verb + " " + to_string(address) +
            " in time: " + (holding ? describe(*holding) : "others were before it"),
          address};
}

/// Its clock may have been put back to before the system's begin: `now` may be negative.
Timestamp deadline_of(Timestamp now, const Patience& patience) {
  auto most = Timestamp::max() - std::max(now, Timestamp{0});
  return patience.at_most < most ? now + patience.at_most : Timestamp::max();
}

WorkingMemoryState::WaitKey key_of(const Client& client, WaitNumber number) {
  return {client.component, client.incarnation, number};
}

template <class Reply>
void begin_wait(Self self, const Client& client, WaitNumber number, const std::string& id,
                const DeferredReplyPtr<Reply>& answer,
                std::function<void(const SettledWait&)> finish) {
  self->state.waits[key_of(client, number)] = {id, std::move(finish),
                                               [answer] { answer->forgo(); }};
}

/// A query that waits for one lease after the other, until it finds all entries readable at once.
struct PendingQuery {
  TypeQuery query;
  ClientPtr client;
  WaitNumber number = 0;
  Timestamp deadline{0};
  DeferredReplyPtr<Outcome<std::vector<EntryPtr>>> answer;
};

/// The first entry that the client has to wait for, or null.
EntryPtr first_unreadable(const WorkingMemoryState& state, const std::vector<EntryPtr>& entries,
                          const ClientPtr& client) {
  if (!client || state.leases.empty())
    return nullptr;
  auto i = std::find_if(entries.begin(), entries.end(),
                        [&](auto& x) { return !state.leases.may_read(x->address.id, *client); });
  return i == entries.end() ? nullptr : *i;
}

/// The component has read these entries.
void note_reads(WorkingMemoryState& state, const ClientPtr& client,
                const std::vector<EntryPtr>& entries) {
  if (client)
    for (auto& x : entries)
      state.usage.record(client->component, x->address.subarchitecture, x->type_name(),
                         &Usage::reads);
}

Outcome<EntryPtr> read_for(WorkingMemoryState& state, const std::string& id,
                           const ClientPtr& client) {
  auto result = state.store.read(id);
  if (result)
    note_reads(state, client, {*result});
  return result;
}

void resume_query(Self self, const std::shared_ptr<PendingQuery>& pending) {
  auto& state = self->state;
  auto entries = state.store.read_by_type(pending->query);
  auto obstacle = first_unreadable(state, entries, pending->client);
  if (!obstacle) {
    note_reads(state, pending->client, entries);
    say_reply(self, pending->answer, Outcome<std::vector<EntryPtr>>{std::move(entries)});
    return;
  }
  auto address = obstacle->address;
  begin_wait(self, *pending->client, pending->number, address.id, pending->answer,
             [self, pending, address](const SettledWait& x) {
               // A deleted entry is no result any more, but the others may be.
               if (x.result != SettledWait::Result::timed_out)
                 resume_query(self, pending);
               else
                 say_reply(self, pending->answer,
                           Outcome<std::vector<EntryPtr>>{
                             failed_wait(self->state, x, pending->client, address, "read")});
             });
  state.leases.wait_to_read(address.id, pending->client, pending->number, pending->deadline);
  set_alarm(self);
}

void forget_due(Self self, Timestamp now) {
  auto& state = self->state;
  std::vector<EntryStore::Effect> effects;
  for (auto& id : state.store.due(now)) {
    // What others may not delete is not forgotten either, until its lease ends.
    auto* holding = state.leases.holding(id);
    if (holding && holding->lease.level != LockLevel::o)
      state.store.postpone(id, holding->lease.expires);
    else
      effects.push_back(state.store.prepare_forgetting(id));
  }
  if (!effects.empty())
    commit(self, std::move(effects));
}

caf::actor actor_of(const WorkingMemoryState& state, const Client& client) {
  for (auto& [address, known] : state.clients)
    if (*known == client)
      return caf::actor_cast<caf::actor>(address);
  return nullptr;
}

} // namespace

void catch_up(Self self) {
  auto& state = self->state;
  if (state.leases.empty() && !state.store.next_due())
    return;
  auto time = now(self);
  state.leases.expire(time);
  if (auto due = state.store.next_due(); due && *due <= time)
    forget_due(self, time);
  settle(self);
}

void settle(Self self) {
  auto& state = self->state;
  // An answer may let the next one wait, or settle more.
  for (auto settled = state.leases.take_settled(); !settled.empty();
       settled = state.leases.take_settled())
    for (auto& x : settled)
      if (auto wait = state.waits.extract(key_of(*x.client, x.number)))
        wait.mapped().finish(x);
}

void set_alarm(Self self) {
  auto& state = self->state;
  auto next = std::min(state.leases.next_deadline().value_or(Timestamp::max()),
                       state.store.next_due().value_or(Timestamp::max()));
  if (next >= state.alarm)
    return;
  state.alarm = next;
  self->delayed_send(self, std::max(Timestamp{0}, next - now(self)), WakeUp{});
}

void remember_client(Self self, const ClientPtr& client) {
  auto& sender = self->current_sender();
  // Is lost already, or is nobody that a peer made up; its leases last as long as any.
  if (!sender)
    return;
  auto [i, is_new] =
    self->state.clients.try_emplace(caf::actor_cast<caf::actor_addr>(sender), client);
  if (is_new)
    monitor(self, sender);
}

void end_client(Self self, const caf::actor_addr& who) {
  auto& state = self->state;
  auto client = state.clients.extract(who);
  if (!client)
    return;
  auto time = now(self);
  auto& [component, subarchitecture, incarnation] = *client.mapped();
  std::erase_if(state.waits, [&](auto& x) {
    return std::get<0>(x.first) == component && std::get<1>(x.first) == incarnation;
  });
  state.leases.drop(*client.mapped(), time);
  state.store.end_owner(*client.mapped(), time);
  // Also if that was the last lease, when there is nothing to catch up with.
  settle(self);
  catch_up(self);
  set_alarm(self);
}

std::optional<Failure> check_leases(const WorkingMemoryState& state, const WriteRequest& request) {
  auto& id = request.address.id;
  // An addition fails if there is an entry, leased or not.
  if (request.operation == Operation::add || (state.leases.empty() && request.token == 0) ||
      !state.store.exists(id))
    return std::nullopt;
  auto begin = to_string(*request.client) + " cannot " + verb(request.operation) + " " +
               to_string(request.address) + ": ";
  auto* holding = state.leases.holding(id);
  switch (state.leases.check(id, *request.client, request.operation, request.token)) {
    case LeaseTable::Verdict::permitted:
      return std::nullopt;
    case LeaseTable::Verdict::leased:
      return Failure{FailureKind::leased,
                     begin + describe(*holding) + ". Lock it first, which waits for that to end",
                     request.address};
    case LeaseTable::Verdict::stale:
      return Failure{FailureKind::lease_lost,
                     begin + "the lease it locked it with has ended, and now " +
                       (holding ? describe(*holding) : "nobody holds one") +
                       ". Unlock it, lock and read it again, and redo the change",
                     request.address};
  }
  return std::nullopt;
}

caf::result<Outcome<EntryPtr>> read(Self self, const ReadRequest& request) {
  auto& state = self->state;
  auto& address = request.address;
  catch_up(self);
  if (!request.patience.client || state.leases.may_read(address.id, *request.patience.client))
    return read_for(state, address.id, request.patience.client);
  remember_client(self, request.patience.client);
  auto answer = defer<Outcome<EntryPtr>>(self);
  begin_wait(self, *request.patience.client, request.patience.number, address.id, answer,
             [self, answer, address, client = request.patience.client](const SettledWait& x) {
               if (x.result == SettledWait::Result::readable)
                 say_reply(self, answer, read_for(self->state, address.id, client));
               else
                 say_reply(self, answer,
                           Outcome<EntryPtr>{failed_wait(self->state, x, client, address, "read")});
             });
  state.leases.wait_to_read(address.id, request.patience.client, request.patience.number,
                            deadline_of(now(self), request.patience));
  set_alarm(self);
  return answer->promise();
}

caf::result<Outcome<std::vector<EntryPtr>>> query(Self self, const QueryRequest& request) {
  auto& state = self->state;
  catch_up(self);
  auto& client = request.patience.client;
  auto entries = state.store.read_by_type(request.query);
  if (!first_unreadable(state, entries, client)) {
    note_reads(state, client, entries);
    return Outcome<std::vector<EntryPtr>>{std::move(entries)};
  }
  remember_client(self, client);
  auto pending = std::make_shared<PendingQuery>(PendingQuery{
    request.query, client, request.patience.number, deadline_of(now(self), request.patience),
    defer<Outcome<std::vector<EntryPtr>>>(self)});
  resume_query(self, pending);
  return pending->answer->promise();
}

caf::result<Outcome<Lease>> lock(Self self, const LockRequest& request) {
  auto& state = self->state;
  auto& address = request.address;
  auto& client = request.patience.client;
  catch_up(self);
  if (!state.store.exists(address.id))
    return Outcome<Lease>{Failure{FailureKind::does_not_exist,
                                  to_string(*client) + " cannot lock " + to_string(address) +
                                    ": there is no such entry",
                                  address}};
  remember_client(self, client);
  auto time = now(self);
  if (auto lease =
        state.leases.try_lock(address.id, client, request.level, request.patience.number, time)) {
    set_alarm(self);
    return Outcome<Lease>{*lease};
  }
  if (request.patience.at_most.count() == 0)
    return Outcome<Lease>{Failure{FailureKind::leased,
                                  to_string(*client) + " cannot lock " + to_string(address) +
                                    " now: " + describe(*state.leases.holding(address.id)),
                                  address}};
  auto answer = defer<Outcome<Lease>>(self);
  begin_wait(self, *request.patience.client, request.patience.number, address.id, answer,
             [self, answer, address, client](const SettledWait& x) {
               if (x.result == SettledWait::Result::granted)
                 say_reply(self, answer, Outcome<Lease>{x.lease});
               else
                 say_reply(self, answer,
                           Outcome<Lease>{failed_wait(self->state, x, client, address, "lock")});
             });
  state.leases.lock(address.id, client, request.level, request.patience.number, time,
                    deadline_of(time, request.patience));
  set_alarm(self);
  return answer->promise();
}

Outcome<Acknowledged> unlock(Self self, const UnlockRequest& request) {
  auto& state = self->state;
  auto& address = request.address;
  catch_up(self);
  if (state.leases.unlock(address.id, *request.client, request.token, now(self))) {
    settle(self);
    set_alarm(self);
    return Acknowledged{};
  }
  auto who = to_string(*request.client);
  if (!state.store.exists(address.id))
    return Failure{FailureKind::does_not_exist,
                   who + " cannot unlock " + to_string(address) + ": it was deleted", address};
  auto* holding = state.leases.holding(address.id);
  return Failure{FailureKind::lease_lost,
                 who + " cannot unlock " + to_string(address) + ": its lease has ended, and now " +
                   (holding ? describe(*holding) : "nobody holds one"),
                 address};
}

void cancel(Self self, const CancelWait& request) {
  auto& state = self->state;
  if (auto& owner = request.address.subarchitecture; owner != state.options.subarchitecture) {
    if (auto* peer = find_peer(state, owner))
      self->send(*peer, request);
    return;
  }
  catch_up(self);
  auto wait = state.waits.extract(key_of(*request.client, request.number));
  state.leases.cancel(wait ? wait.mapped().id : request.address.id, *request.client, request.number,
                      now(self));
  if (wait)
    wait.mapped().forgo();
  settle(self);
}

RenewReply renew(Self self, const RenewRequest& request) {
  auto& state = self->state;
  catch_up(self);
  RenewReply result;
  for (auto& x : request.leases)
    if (!state.leases.renew(x.id, *request.client, x.token, now(self)))
      result.lost.push_back(x);
  return result;
}

Outcome<LockStatus> lock_status(const WorkingMemoryState& state, const Address& address) {
  auto& id = address.id;
  if (!state.store.exists(id))
    return Failure{FailureKind::does_not_exist,
                   "there is no entry " + to_string(address) + " that could be locked", address};
  LockStatus result;
  if (auto* holding = state.leases.holding(id)) {
    result.level = holding->lease.level;
    result.holder = holding->holder;
  }
  if (auto* waiting = state.leases.waiting(id))
    result.waiting = waiting->size();
  return result;
}

void follow(Self self, DeadlockProbe probe) {
  auto& state = self->state;
  auto& edge = probe.path.back();
  if (edge.address.subarchitecture != state.options.subarchitecture) {
    if (auto* peer = find_peer(state, edge.address.subarchitecture))
      self->send(*peer, std::move(probe));
    return;
  }
  ClientPtr next;
  if (edge.kind == WaitEdge::Kind::owner) {
    next = state.store.owner(edge.address.id);
    if (next)
      edge.obstacle = *state.store.version(edge.address.id);
  } else {
    auto wait = state.waits.find(key_of(*edge.waiter, edge.number));
    if (wait == state.waits.end())
      return;
    edge.address.id = wait->second.id;
    if (auto* holding = state.leases.holding(edge.address.id)) {
      next = holding->holder;
      edge.obstacle = holding->lease.token;
    }
  }
  if (next)
    if (auto actor = actor_of(state, *next))
      caf::anon_send(actor, std::move(probe));
}

} // namespace castor::working_memory_parts
