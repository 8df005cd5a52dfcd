#include "castor/wm/memory/working_memory_shell.hpp"

#include "castor/wm/memory/write_preparation.hpp"

#include <algorithm>
#include <optional>

namespace castor {

namespace {

/// Whether the journal says which numbers there were.
bool has_journal(const WorkingMemoryOptions& options) {
  return options.opened_journal && options.opened_journal->failure.empty();
}

std::uint64_t first_of_life(const WorkingMemoryOptions& options) {
  return (options.incarnation - 1) * numbers_per_life;
}

EntryStoreOptions store_options(const WorkingMemoryOptions& options) {
  auto result = options.store;
  if (!has_journal(options))
    result.first_version = first_of_life(options);
  return result;
}

LeaseTableOptions lease_options(const WorkingMemoryOptions& options, EntryTable& entries) {
  auto result = options.leases;
  // Overtaking depends on when threads wake, which a reproducible run must not.
  if (options.clock && options.clock->activity().is_one_at_a_time())
    result.overtaking = Timestamp{0};
  // A lease does not know whether its entry is still there.
  result.on_exclusion = [&entries](const std::string& id, bool is_excluded) {
    if (entries.find(id))
      entries.change(id, [&](EntryTable::Slot& x) { x.is_excluded = is_excluded; });
  };
  // Of whatever session: a lease's token is never that of another.
  result.first_token =
    (has_journal(options) ? options.opened_journal->session * numbers_per_incarnation
                          : first_of_life(options)) +
    1;
  return result;
}

} // namespace

WorkingMemoryShell::WorkingMemoryShell(WorkingMemoryActor::pointer self,
                                       const WorkingMemoryOptions& options)
  : self_(self), store_(options.subarchitecture, store_options(options)),
    leases_(store_, lease_options(options, store_.entries())),
    events_(self, outbox_, monitored_, usage_, options), epoch_(options.epoch),
    clock_(options.clock) {
  allow_writers(options.writers);
  store_.access().set_readers(options.readers);
  events_.set_broadcasts_to([this, without = options.without_components](const std::string& x) {
    return x != without && store_.access().may_read(x);
  });
  if (!options.opened_journal)
    return;
  outbox_.open(options, now());
  if (has_journal(options))
    store_.restore(options.opened_journal->image, now(), options.opened_journal->time);
  set_alarm();
}

WorkingMemoryShell::~WorkingMemoryShell() {
  store_.entries().clear();
  if (clock_)
    clock_->forget(system_alarm_key_);
}

Timestamp WorkingMemoryShell::now() const {
  return clock_ ? clock_->now() + clock_jump_ : lease_now();
}

Timestamp WorkingMemoryShell::lease_now() const {
  return std::chrono::duration_cast<Timestamp>(self_->clock().now() - epoch_) + clock_jump_;
}

// -- entries

Outcome<Version> WorkingMemoryShell::write(const WriteRequest& request) {
  catch_up();
  auto effects = prepare_writes(store_, leases_, {&request, 1});
  if (!effects) {
    ++refused_;
    return effects.failure();
  }
  auto version = effects->front().entry->version;
  commit(*std::move(effects));
  return version;
}

Outcome<std::vector<Version>> WorkingMemoryShell::write_all(const BatchRequest& request) {
  catch_up();
  auto effects = prepare_writes(store_, leases_, request.writes);
  if (!effects) {
    ++refused_;
    return effects.failure();
  }
  std::vector<Version> versions;
  for (auto& effect : *effects)
    versions.push_back(effect.entry->version);
  commit(*std::move(effects));
  return versions;
}

void WorkingMemoryShell::commit(std::vector<EntryStore::Effect> effects) {
  auto time = now();
  std::vector<CommittedChange> changes;
  changes.reserve(effects.size());
  bool are_several = effects.size() > 1;
  if (are_several)
    store_.entries().begin_atomic();
  for (auto& effect : effects) {
    if (effect.owner)
      remember_client(effect.owner);
    if (effect.testator)
      remember_client(effect.testator);
    CommittedChange change{nullptr, effect.entry, effect.before};
    change.event = store_.commit(std::move(effect), time);
    last_event_ = time;
    count_change(*change.event);
    if (change.event->operation == Operation::remove)
      leases_.erase(change.event->address.id);
    changes.push_back(std::move(change));
  }
  if (are_several)
    store_.entries().end_atomic();
  outbox_.write(changes);
  events_.dispatch(changes);
  leases_.settle();
  set_alarm();
}

caf::result<Outcome<EntryPtr>> WorkingMemoryShell::read(const ReadRequest& request) {
  catch_up();
  auto& client = request.patience.client;
  if (auto refused = check_may_read(client, request.address))
    return Outcome<EntryPtr>{*std::move(refused)};
  if (auto entry = leases_.try_read(request)) {
    if (*entry)
      count_read(client, ***entry);
    return *std::move(entry);
  }
  remember_client(client);
  auto answer = defer<Outcome<EntryPtr>>(self_);
  leases_.wait_to_read(request, lease_now(),
                       {[this, answer, client = client](Outcome<EntryPtr> x) {
                          if (x)
                            count_read(client, **x);
                          outbox_.reply(answer, std::move(x));
                        },
                        [answer] { answer->abandon(); }});
  set_alarm();
  return answer->promise();
}

caf::result<Outcome<std::vector<EntryPtr>>> WorkingMemoryShell::query(const QueryRequest& request) {
  using Entries = std::vector<EntryPtr>;
  catch_up();
  auto& client = request.patience.client;
  if (auto refused = check_may_read(client, {request.query.subarchitecture, {}}))
    return Outcome<Entries>{*std::move(refused)};
  if (auto entries = leases_.try_query(request)) {
    for (auto& entry : *entries)
      count_read(client, *entry);
    return Outcome<Entries>{*std::move(entries)};
  }
  remember_client(client);
  auto answer = defer<Outcome<Entries>>(self_);
  leases_.wait_to_query(request, lease_now(),
                        {[this, answer, client = client](Outcome<Entries> x) {
                           if (x)
                             for (auto& entry : *x)
                               count_read(client, *entry);
                           outbox_.reply(answer, std::move(x));
                         },
                         [answer] { answer->abandon(); }});
  set_alarm();
  return answer->promise();
}

Outcome<bool> WorkingMemoryShell::exists(const ExistsQuery& request) {
  catch_up();
  if (auto refused = check_may_read(request.client, request.address))
    return *std::move(refused);
  return store_.exists(request.address.id);
}

Outcome<Version> WorkingMemoryShell::version(const VersionQuery& request) {
  catch_up();
  if (auto refused = check_may_read(request.client, request.address))
    return *std::move(refused);
  return store_.version(request.address.id);
}

std::optional<Failure> WorkingMemoryShell::check_may_read(const ClientPtr& client,
                                                          const Address& address) {
  auto result = store_.check_may_read(client, address);
  refused_ += result.has_value();
  return result;
}

Outcome<Acknowledged> WorkingMemoryShell::set_interest(const Interest& interest) {
  // An interest in all subarchitectures is no mistake: it is in those that may be read.
  if (!store_.access().may_read(interest.subarchitecture)) {
    ++refused_;
    return Failure{FailureKind::not_permitted,
                   "components of " + interest.subarchitecture + " get no change events of " +
                     store_.subarchitecture() + ": " +
                     store_.access().readers_text(interest.subarchitecture),
                   {store_.subarchitecture(), interest.filter.id}};
  }
  events_.set_interest(interest);
  return Acknowledged{};
}

// -- leases

caf::result<Outcome<Lease>> WorkingMemoryShell::lock(const LockRequest& request) {
  catch_up();
  auto result = leases_.try_lock(request, lease_now());
  // The request may have ended the wait of another.
  settle();
  if (result && !*result)
    return *std::move(result);
  remember_client(request.patience.client);
  if (result) {
    set_alarm();
    return *std::move(result);
  }
  WaitingReply<Lease> reply;
  if (request.claims)
    reply.offer = [sender = self_->current_sender(),
                   offer = LeaseOffer{request.address, request.patience.number}] {
      if (sender)
        sender->enqueue(nullptr, caf::make_message_id(), caf::make_message(offer), nullptr);
    };
  auto answer = defer<Outcome<Lease>>(self_);
  reply.deliver = [this, answer](Outcome<Lease> x) { outbox_.reply(answer, std::move(x)); };
  reply.abandon = [answer] { answer->abandon(); };
  leases_.wait_to_lock(request, lease_now(), std::move(reply));
  set_alarm();
  return answer->promise();
}

Outcome<Acknowledged> WorkingMemoryShell::unlock(const UnlockRequest& request) {
  catch_up();
  auto result = leases_.unlock(request, lease_now());
  settle();
  set_alarm();
  return result;
}

Outcome<LockStatus> WorkingMemoryShell::lock_status(const LockQuery& request) {
  catch_up();
  return leases_.status(request.address);
}

void WorkingMemoryShell::claim(const ClaimLease& request) {
  if (is_for_peer(request.address, request))
    return;
  catch_up();
  leases_.claim(request, lease_now());
  settle();
}

void WorkingMemoryShell::cancel(const CancelWait& request) {
  if (is_for_peer(request.address, request))
    return;
  catch_up();
  leases_.cancel(request, lease_now());
  settle();
}

caf::result<RenewReply> WorkingMemoryShell::renew(const RenewRequest& request) {
  catch_up();
  return outbox_.reply<RenewReply>(leases_.renew(request, lease_now()));
}

void WorkingMemoryShell::follow(DeadlockProbe probe) {
  auto& edge = probe.path.back();
  if (edge.address.subarchitecture != store_.subarchitecture()) {
    if (auto* peer = events_.find_peer(edge.address.subarchitecture))
      self_->send(*peer, std::move(probe));
    return;
  }
  if (auto next = leases_.follow(edge))
    if (auto actor = actor_of(*next))
      caf::anon_send(actor, std::move(probe));
}

// -- time

void WorkingMemoryShell::catch_up() {
  if (leases_.empty() && !store_.lifetimes().next_due())
    return;
  leases_.expire(lease_now());
  auto time = now();
  if (auto due = store_.lifetimes().next_due(); due && *due <= time)
    delete_due(time);
  settle();
  tell_readers();
}

void WorkingMemoryShell::tell_readers() {
  // No clock gets there.
  constexpr Timestamp never = std::chrono::hours{24 * 365 * 100};
  auto next = leases_.next_deadline().value_or(never);
  store_.entries().set_due(next < never ? epoch_ + (next - clock_jump_) : EntryTable::Time::max());
}

void WorkingMemoryShell::delete_due(Timestamp now) {
  std::vector<EntryStore::Effect> effects;
  for (auto& id : store_.lifetimes().due(now)) {
    // What others may not delete is not forgotten either, until its lease ends.
    if (auto until = leases_.protected_until(id))
      store_.lifetimes().postpone(id, now + std::max(Timestamp{1}, *until - lease_now()));
    else
      effects.push_back(store_.prepare_due(id));
  }
  if (!effects.empty())
    commit(std::move(effects));
}

void WorkingMemoryShell::settle() {
  if (leases_.settle())
    set_alarm();
}

void WorkingMemoryShell::set_alarm() {
  tell_readers();
  auto leases = leases_.next_deadline().value_or(Timestamp::max());
  auto lifetimes = store_.lifetimes().next_due().value_or(Timestamp::max());
  if (!clock_) {
    set_lease_alarm(std::min(leases, lifetimes));
    return;
  }
  set_system_alarm(lifetimes);
  // Real time would change the order of a reproducible run; clients give up waits themselves.
  if (!clock_->activity().is_one_at_a_time())
    set_lease_alarm(leases);
}

void WorkingMemoryShell::set_lease_alarm(Timestamp next) {
  if (next >= lease_alarm_)
    return;
  lease_alarm_ = next;
  self_->delayed_send(self_, std::max(Timestamp{0}, next - lease_now()), WakeUp{});
}

void WorkingMemoryShell::set_system_alarm(Timestamp next) {
  if (next >= system_alarm_)
    return;
  clock_->forget(system_alarm_key_);
  system_alarm_ = next;
  // Before the components that are woken at that time.
  system_alarm_key_ = clock_->wake_at(next - clock_jump_, 0, [self = self_->address()] {
    if (auto actor = caf::actor_cast<caf::strong_actor_ptr>(self))
      actor->enqueue(nullptr, caf::make_message_id(), caf::make_message(WakeUp{}), nullptr);
  });
}

void WorkingMemoryShell::wake_up() {
  if (!clock_ || lease_alarm_ <= lease_now())
    lease_alarm_ = Timestamp::max();
  if (system_alarm_ <= now())
    system_alarm_ = Timestamp::max();
  catch_up();
  set_alarm();
}

void WorkingMemoryShell::jump_clock(Timestamp by) {
  clock_jump_ += by;
  wake_up();
}

// -- clients

void WorkingMemoryShell::allow_writers(const std::set<std::string>& writers) {
  for (auto& writer : writers) {
    if (writer == "*")
      store_.access().allow_all();
    else
      store_.access().allow(writer);
  }
}

void WorkingMemoryShell::remember_client(const ClientPtr& client) {
  auto& sender = self_->current_sender();
  // Is lost already, or is nobody that a peer made up; its leases last as long as any.
  if (!sender)
    return;
  if (clients_.try_emplace(caf::actor_cast<caf::actor_addr>(sender), client).second)
    monitored_.add(sender);
}

void WorkingMemoryShell::end(const caf::actor_addr& who) {
  monitored_.remove(who);
  events_.end(who);
  end_client(who);
}

void WorkingMemoryShell::end_client(const caf::actor_addr& who) {
  auto client = clients_.extract(who);
  if (!client)
    return;
  leases_.drop(*client.mapped(), lease_now());
  store_.lifetimes().end_owner(*client.mapped(), now());
  // Also if that was the last lease, when there is nothing to catch up with.
  settle();
  catch_up();
  set_alarm();
}

caf::actor WorkingMemoryShell::actor_of(const Client& client) const {
  for (auto& [address, known] : clients_)
    if (*known == client)
      return caf::actor_cast<caf::actor>(address);
  return nullptr;
}

// -- status

void WorkingMemoryShell::count_change(const ChangeEvent& x) {
  auto what = x.operation == Operation::add         ? &Usage::adds
              : x.operation == Operation::overwrite ? &Usage::overwrites
                                                    : &Usage::deletes;
  usage_.record(x.source, x.address.subarchitecture, x.type_name(), what);
}

void WorkingMemoryShell::count_read(const ClientPtr& client, const Entry& entry) {
  if (client)
    usage_.record(client->component, entry.address.subarchitecture, entry.type_name(),
                  &Usage::reads);
}

UsageReport WorkingMemoryShell::usage() const {
  auto result = usage_;
  store_.entries().counts().for_each(
    [&](const std::string& component, const std::string& type, std::uint64_t count) {
      result.record(component, store_.subarchitecture(), type, &Usage::reads, count);
    });
  return {result.all()};
}

WorkingMemoryStatus WorkingMemoryShell::status() const {
  WorkingMemoryStatus result;
  result.subarchitecture = store_.subarchitecture();
  result.entries = store_.size();
  result.entries_by_type = store_.counts_by_type();
  result.events = store_.sequence();
  result.last_event = last_event_;
  result.refused = refused_;
  result.leases = leases_.size();
  result.waiting = leases_.waiting();
  result.journal = outbox_.status();
  events_.add_to(result);
  return result;
}

} // namespace castor
