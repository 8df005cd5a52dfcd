#include "castor/wm/memory/lease_service.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

std::string describe(const LeaseTable::Holding& x) {
  return to_string(*x.holder) + " holds a lease of level " + std::string{to_string(x.lease.level)} +
         " on it";
}

std::string verb(Operation x) {
  return x == Operation::overwrite ? "overwrite" : "delete";
}

/// Its clock may have been put back to before the system's begin: `now` may be negative.
Timestamp deadline_of(Timestamp now, const Patience& patience) {
  auto most = Timestamp::max() - std::max(now, Timestamp{0});
  return patience.at_most < most ? now + patience.at_most : Timestamp::max();
}

} // namespace

std::optional<Outcome<Lease>> LeaseService::try_lock(const LockRequest& request, Timestamp now) {
  auto& [address, level, patience, claims] = request;
  auto& client = patience.client;
  if (!store_.exists(address.id))
    return Failure{FailureKind::does_not_exist,
                   to_string(*client) + " cannot lock " + to_string(address) +
                     ": there is no such entry",
                   address};
  if (auto lease = table_.try_lock(address.id, client, level, patience.number, now))
    return *lease;
  if (patience.at_most.count() == 0)
    return Failure{FailureKind::leased,
                   to_string(*client) + " cannot lock " + to_string(address) +
                     " now: " + describe_holder(address.id),
                   address};
  return std::nullopt;
}

void LeaseService::wait_to_lock(const LockRequest& request, Timestamp now,
                                WaitingReply<Lease> reply) {
  auto& [address, level, patience, claims] = request;
  auto& client = patience.client;
  bool can_claim = reply.offer != nullptr;
  waits_[key_of(*client, patience.number)] = {address.id,
                                              [this, deliver = std::move(reply.deliver),
                                               address = address,
                                               client = client](const SettledWait& x) {
                                                if (x.result == SettledWait::Result::granted)
                                                  deliver(x.lease);
                                                else
                                                  deliver(failed_wait(x, client, address, "lock"));
                                              },
                                              std::move(reply.abandon), std::move(reply.offer)};
  table_.lock(address.id, client, level, patience.number, now, deadline_of(now, patience),
              can_claim);
}

std::optional<Outcome<EntryPtr>> LeaseService::try_read(const ReadRequest& request) const {
  auto& [address, patience] = request;
  if (patience.client && !table_.may_read(address.id, *patience.client))
    return std::nullopt;
  return store_.read(address.id);
}

void LeaseService::wait_to_read(const ReadRequest& request, Timestamp now,
                                WaitingReply<EntryPtr> reply) {
  auto& [address, patience] = request;
  auto& client = patience.client;
  waits_[key_of(*client, patience.number)] = {address.id,
                                              [this, deliver = std::move(reply.deliver),
                                               address = address,
                                               client = client](const SettledWait& x) {
                                                if (x.result == SettledWait::Result::readable)
                                                  deliver(store_.read(address.id));
                                                else
                                                  deliver(failed_wait(x, client, address, "read"));
                                              },
                                              std::move(reply.abandon)};
  table_.wait_to_read(address.id, client, patience.number, deadline_of(now, patience));
}

std::optional<LeaseService::Entries> LeaseService::try_query(const QueryRequest& request) const {
  auto entries = store_.read_by_type(request.query);
  if (first_unreadable(entries, request.patience.client))
    return std::nullopt;
  return entries;
}

void LeaseService::wait_to_query(const QueryRequest& request, Timestamp now,
                                 WaitingReply<Entries> reply) {
  auto& [query, patience] = request;
  resume(std::make_shared<PendingQuery>(PendingQuery{
    query, patience.client, patience.number, deadline_of(now, patience), std::move(reply)}));
}

void LeaseService::resume(const std::shared_ptr<PendingQuery>& pending) {
  auto& [query, client, number, deadline, reply] = *pending;
  auto entries = store_.read_by_type(query);
  auto obstacle = first_unreadable(entries, client);
  if (!obstacle) {
    reply.deliver(std::move(entries));
    return;
  }
  auto address = obstacle->address;
  waits_[key_of(*client, number)] = {address.id,
                                     [this, pending, address](const SettledWait& x) {
                                       // A deleted entry is no result any more, but the others may
                                       // be.
                                       if (x.result != SettledWait::Result::timed_out)
                                         resume(pending);
                                       else
                                         pending->reply.deliver(
                                           failed_wait(x, pending->client, address, "read"));
                                     },
                                     reply.abandon};
  table_.wait_to_read(address.id, client, number, deadline);
}

Outcome<Acknowledged> LeaseService::unlock(const UnlockRequest& request, Timestamp now) {
  auto& [address, client, token] = request;
  if (table_.unlock(address.id, *client, token, now))
    return Acknowledged{};
  auto who = to_string(*client);
  if (!store_.exists(address.id))
    return Failure{FailureKind::does_not_exist,
                   who + " cannot unlock " + to_string(address) + ": it was deleted", address};
  return Failure{FailureKind::lease_lost,
                 who + " cannot unlock " + to_string(address) + ": its lease has ended, and now " +
                   describe_holder(address.id),
                 address};
}

RenewReply LeaseService::renew(const RenewRequest& request, Timestamp now) {
  RenewReply result;
  for (auto& x : request.leases)
    if (!table_.renew(x.id, *request.client, x.token, now))
      result.lost.push_back(x);
  return result;
}

void LeaseService::claim(const ClaimLease& request, Timestamp now) {
  table_.claim(request.address.id, *request.client, request.number, now);
}

void LeaseService::cancel(const CancelWait& request, Timestamp now) {
  auto& [address, client, number] = request;
  auto wait = waits_.extract(key_of(*client, number));
  table_.cancel(wait ? wait.mapped().id : address.id, *client, number, now);
  if (wait)
    wait.mapped().abandon();
}

Outcome<LockStatus> LeaseService::status(const Address& address) const {
  if (!store_.exists(address.id))
    return Failure{FailureKind::does_not_exist,
                   "there is no entry " + to_string(address) + " that could be locked", address};
  LockStatus result;
  if (auto* holding = table_.holding(address.id)) {
    result.level = holding->lease.level;
    result.holder = holding->holder;
    result.token = holding->lease.token;
  }
  if (auto* waiting = table_.waiting(address.id))
    result.waiting = waiting->size();
  return result;
}

std::optional<Failure> LeaseService::check(const WriteRequest& request) const {
  auto& id = request.address.id;
  // An addition fails if there is an entry, leased or not.
  if (request.operation == Operation::add || (table_.empty() && request.token == 0) ||
      !store_.exists(id))
    return std::nullopt;
  auto verdict = table_.check(id, *request.client, request.operation, request.token);
  if (verdict == LeaseTable::Verdict::permitted)
    return std::nullopt;
  auto begin = to_string(*request.client) + " cannot " + verb(request.operation) + " " +
               to_string(request.address) + ": ";
  if (verdict == LeaseTable::Verdict::leased)
    return Failure{FailureKind::leased,
                   begin + describe_holder(id) + ". Lock it first, which waits for that to end",
                   request.address};
  return Failure{FailureKind::lease_lost,
                 begin + "the lease it locked it with has ended, and now " + describe_holder(id) +
                   ". Unlock it, lock and read it again, and redo the change",
                 request.address};
}

std::optional<Timestamp> LeaseService::protected_until(const std::string& id) const {
  auto* holding = table_.holding(id);
  return holding && holding->lease.level != LockLevel::o ? std::optional{holding->lease.expires}
                                                         : std::nullopt;
}

ClientPtr LeaseService::follow(WaitEdge& edge) const {
  if (edge.kind == WaitEdge::Kind::owner) {
    auto owner = store_.lifetimes().owner(edge.address.id);
    if (owner)
      edge.obstacle = *store_.version(edge.address.id);
    return owner;
  }
  auto wait = waits_.find(key_of(*edge.waiter, edge.number));
  if (wait == waits_.end())
    return nullptr;
  edge.address.id = wait->second.id;
  auto* holding = table_.holding(edge.address.id);
  if (!holding)
    return nullptr;
  edge.obstacle = holding->lease.token;
  return holding->holder;
}

void LeaseService::drop(const Client& client, Timestamp now) {
  std::erase_if(waits_, [&](auto& x) {
    auto& [component, incarnation, number] = x.first;
    return component == client.component && incarnation == client.incarnation;
  });
  table_.drop(client, now);
}

bool LeaseService::settle() {
  bool any = false;
  // An answer may let the next one wait, or settle more.
  for (auto settled = table_.take_settled(); !settled.empty(); settled = table_.take_settled()) {
    any = true;
    for (auto& x : settled)
      if (auto wait = waits_.extract(key_of(*x.client, x.number)))
        wait.mapped().finish(x);
  }
  for (auto& x : table_.take_offers())
    if (auto wait = waits_.find(key_of(*x.client, x.number)); wait != waits_.end()) {
      any = true;
      wait->second.offer();
    }
  return any;
}

LeaseService::WaitKey LeaseService::key_of(const Client& client, WaitNumber number) {
  return {client.component, client.incarnation, number};
}

Failure LeaseService::failed_wait(const SettledWait& settled, const ClientPtr& client,
                                  const Address& address, const std::string& verb) const {
  auto who = to_string(*client);
  if (settled.result == SettledWait::Result::deleted)
    return {FailureKind::does_not_exist,
            to_string(address) + " was deleted while " + who + " waited to " + verb + " it",
            address};
  auto* holding = table_.holding(address.id);
  return {FailureKind::no_answer,
          who + " could not " + verb + " " + to_string(address) +
            " in time: " + (holding ? describe(*holding) : "others were before it"),
          address};
}

std::string LeaseService::describe_holder(const std::string& id) const {
  auto* holding = table_.holding(id);
  if (holding)
    return describe(*holding);
  return table_.waiting(id) ? "others wait for one" : "nobody holds one";
}

EntryPtr LeaseService::first_unreadable(const Entries& entries, const ClientPtr& client) const {
  if (!client || table_.empty())
    return nullptr;
  auto i = std::find_if(entries.begin(), entries.end(),
                        [&](auto& x) { return !table_.may_read(x->address.id, *client); });
  return i == entries.end() ? nullptr : *i;
}

} // namespace castor
