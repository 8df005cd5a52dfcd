#include "castor/tools/simulation/simulated_client.hpp"

#include "castor/base/plain_words.hpp"

#include <algorithm>
#include <utility>

namespace castor::linearizability {

namespace {

using StepAtom = caf::atom_constant<caf::atom("step")>;
using RestAtom = caf::atom_constant<caf::atom("rest")>;

constexpr std::size_t most_outstanding = 6;

} // namespace

SimulatedClient::SimulatedClient(caf::actor_config& config, SimulatedClientParts parts)
  : event_based_actor(config), world_(*parts.world), parts_(std::move(parts)),
    number_(++world_.last_client),
    identity_(std::make_shared<const castor::Client>(castor::Client{
      parts_.component, world_.working_memories[parts_.home].subarchitecture, parts_.incarnation})),
    views_(std::move(parts_.views)), choice_(world_, parts_.traits), outstanding_(world_) {
  world_.identities.push_back(identity_);
  views_.resize(world_.entries.size());
}

void SimulatedClient::let_rest(const caf::actor& client) {
  caf::anon_send(client, RestAtom::value);
}

void SimulatedClient::spawn(caf::actor_system& system, SimulatedClientParts parts) {
  auto& world = *parts.world;
  auto actor = system.spawn<SimulatedClient>(std::move(parts));
  world.alive.push_back(actor);
  caf::anon_send(actor, StepAtom::value);
}

caf::behavior SimulatedClient::make_behavior() {
  return {
    [this](StepAtom) { step(); },
    [this](RestAtom) { rest(); },
    [this](const LeaseOffer& x) { claim(x); },
  };
}

// -- what to do

void SimulatedClient::step() {
  stepping_ = false;
  if (parts_.traits.may_end && world_.chance(6)) {
    die();
    return;
  }
  if (parts_.traits.gives_up_waits && world_.chance(30))
    give_up_something();
  if (!parts_.traits.never_renews && world_.chance(60))
    renew();
  for (auto operations = world_.chance(70) ? 1 : 1 + world_.pick(4);
       operations > 0 && world_.operations_left > 0; --operations)
    act();
  auto patient = outstanding_.size() >= most_outstanding || world_.chance(50);
  if (!patient || !outstanding_.is_awaited())
    go_on();
}

void SimulatedClient::go_on() {
  if (stepping_ || world_.operations_left == 0)
    return;
  stepping_ = true;
  if (auto delay = pause(); delay.count() > 0)
    delayed_send(this, delay, StepAtom::value);
  else
    send(this, StepAtom::value);
}

void SimulatedClient::act() {
  if (world_.chance(4)) {
    read_all();
  } else if (world_.chance(8)) {
    write_several();
  } else {
    --world_.operations_left;
    auto entry = std::uint32_t(world_.pick(views_.size()));
    begin(entry, choice_.kind(views_[entry]));
  }
}

void SimulatedClient::end_of_life() {
  world_.recorder.died(number_);
  world_.dead.push_back(identity_);
}

void SimulatedClient::die() {
  end_of_life();
  std::erase(world_.alive, caf::actor_cast<caf::actor>(this));
  auto successor = parts_;
  ++successor.incarnation;
  if (parts_.traits.shows_wrong_tokens)
    for (auto& view : successor.views = views_)
      view.lose_lease();
  if (world_.chance(70))
    spawn(system(), std::move(successor));
  quit(caf::exit_reason::kill);
}

void SimulatedClient::rest() {
  outstanding_.settle(to_string(*identity_));
}

// -- operations

Route SimulatedClient::route_to(std::uint32_t entry) {
  auto via =
    parts_.traits.uses_any_memory ? world_.pick(world_.working_memories.size()) : parts_.home;
  return {via, world_.entries[entry].owner};
}

Patience SimulatedClient::patience(WaitNumber number) {
  constexpr std::chrono::milliseconds long_time{300};
  return {identity_, number, std::chrono::milliseconds{1 + world_.pick(long_time.count())}};
}

OperationRecord SimulatedClient::planned_write(std::uint32_t entry, OperationKind kind) {
  auto& view = views_[entry];
  OperationRecord x;
  x.client = number_;
  x.entry = entry;
  x.kind = kind;
  if (kind != OperationKind::remove)
    x.content = Content(++world_.stamps);
  if (kind == OperationKind::overwrite)
    x.last_seen = choice_.version_to_show(view);
  if (kind != OperationKind::add)
    x.token = choice_.token_to_show(view, entry);
  // It counts on its success, as what it sends before the answer should.
  view.present = kind != OperationKind::remove;
  return x;
}

WriteRequest SimulatedClient::request_for(const OperationRecord& x) const {
  auto operation = x.kind == OperationKind::add      ? Operation::add
                   : x.kind == OperationKind::remove ? Operation::remove
                                                     : Operation::overwrite;
  auto value = operation == Operation::remove ? Value{} : Value::of(Stamp{std::int64_t(x.content)});
  return {operation, world_.entries[x.entry].address, std::move(value), x.last_seen, identity_,
          x.token};
}

/// What was asked for may have been done, or not.
void SimulatedClient::not_answered(std::uint64_t number, const caf::error& e) {
  if (deadline() == caf::infinite)
    world_.find("no answer: " + plain_words(e, system()));
  for (auto record : outstanding_.drop(number))
    views_[world_.recorder[record].entry].unsure = true;
  if (!outstanding_.is_awaited())
    go_on();
}

void SimulatedClient::begin(std::uint32_t entry, OperationKind kind) {
  auto& view = views_[entry];
  auto& address = world_.entries[entry].address;
  auto& recorder = world_.recorder;
  OperationRecord x;
  x.client = number_;
  x.entry = entry;
  x.kind = kind;
  switch (kind) {
    case OperationKind::add:
    case OperationKind::overwrite:
    case OperationKind::remove:
      write(entry, kind);
      break;
    case OperationKind::lock:
    case OperationKind::try_lock:
      lock(x);
      break;
    case OperationKind::unlock:
      x.token = choice_.token_to_show(view, entry);
      unlock(x);
      break;
    case OperationKind::read:
      read(entry);
      break;
    case OperationKind::exists: {
      auto record = recorder.invoked(x);
      ask<bool>(route_to(entry), ExistsQuery{address}, {record}, 0,
                [this, record, &view](const Outstanding&, const Outcome<bool>& answer) {
                  if (!answer)
                    return failed(record, answer.failure());
                  view.present = *answer;
                  world_.recorder.returned(record, {*answer ? Status::ok : Status::does_not_exist});
                });
      break;
    }
    default: {
      auto record = recorder.invoked(x);
      ask<Version>(route_to(entry), VersionQuery{address}, {record}, 0,
                   [this, record](const Outstanding&, const Outcome<Version>& answer) {
                     if (!answer)
                       return failed(record, answer.failure());
                     world_.recorder.returned(record, {Status::ok, *answer});
                   });
    }
  }
}

void SimulatedClient::read(std::uint32_t entry) {
  if (read_here(entry))
    return;
  OperationRecord x;
  x.client = number_;
  x.entry = entry;
  x.kind = OperationKind::read;
  auto record = world_.recorder.invoked(x);
  auto number = ++last_wait_;
  ask<EntryPtr>(route_to(entry), ReadRequest{world_.entries[entry].address, patience(number)},
                {record}, number,
                [this, record](const Outstanding&, const Outcome<EntryPtr>& answer) {
                  if (answer)
                    was_read(record, **answer);
                  else
                    failed(record, answer.failure());
                });
}

bool SimulatedClient::read_here(std::uint32_t entry) {
  auto& table = world_.working_memories[world_.entries[entry].owner].entries;
  // As components do: no read overtakes an earlier operation.
  if (!table || outstanding_.size() > 0 || world_.chance(30))
    return false;
  auto found = table->read(world_.entries[entry].address.id, [this] { return clock().now(); });
  if (!found)
    return false;
  OperationRecord x;
  x.client = number_;
  x.entry = entry;
  x.kind = OperationKind::read;
  was_read(world_.recorder.invoked(x), *found);
  return true;
}

void SimulatedClient::was_read(Index record, const Entry& entry) {
  auto& view = views_[world_.recorder[record].entry];
  view.present = true;
  view.seen = entry.version;
  world_.recorder.returned(record, {Status::ok, entry.version, content_of(entry)});
}

void SimulatedClient::write(std::uint32_t entry, OperationKind kind) {
  auto x = planned_write(entry, kind);
  auto& view = views_[entry];
  auto record = world_.recorder.invoked(x);
  auto request = request_for(x);
  // As components do: the next in the pipeline counts on this one.
  if (x.last_seen)
    view.seen = *x.last_seen + 1;
  ask<Version>(route_to(x.entry), request, {record}, 0,
               [this, record](const Outstanding&, const Outcome<Version>& answer) {
                 if (answer)
                   wrote(record, *answer);
                 else
                   failed(record, answer.failure());
               });
}

void SimulatedClient::write_several() {
  auto owner = world_.entries[world_.pick(world_.entries.size())].owner;
  BatchRequest batch{world_.working_memories[owner].subarchitecture, {}};
  std::vector<Index> records;
  for (std::uint32_t entry = 0; entry < views_.size(); ++entry) {
    if (world_.entries[entry].owner != owner || world_.operations_left == 0 || world_.chance(20))
      continue;
    --world_.operations_left;
    auto kind = !views_[entry].present ? OperationKind::add
                : world_.chance(15)    ? OperationKind::remove
                                       : OperationKind::overwrite;
    auto x = planned_write(entry, kind);
    batch.writes.push_back(request_for(x));
    records.push_back(world_.recorder.invoked(x));
  }
  if (records.empty())
    return;
  auto via =
    parts_.traits.uses_any_memory ? world_.pick(world_.working_memories.size()) : parts_.home;
  world_.batches.push_back(records);
  ask<std::vector<Version>>(
    {via, owner}, batch, records, 0,
    [this](const Outstanding& x, const Outcome<std::vector<Version>>& answer) {
      for (std::size_t i = 0; i < x.records.size(); ++i) {
        auto& record = world_.recorder[x.records[i]];
        if (answer)
          wrote(x.records[i], (*answer)[i]);
        else if (answer.failure().address == world_.entries[record.entry].address)
          failed(x.records[i], answer.failure());
        else
          world_.recorder.did_not_happen(x.records[i]);
      }
    });
}

void SimulatedClient::read_all() {
  auto owner = world_.entries[world_.pick(world_.entries.size())].owner;
  auto via =
    parts_.traits.uses_any_memory ? world_.pick(world_.working_memories.size()) : parts_.home;
  auto number = ++last_wait_;
  auto invoked = world_.recorder.tick();
  TypeQuery query{world_.working_memories[owner].subarchitecture, type_name<Stamp>()};
  ask<std::vector<EntryPtr>>(
    {via, owner}, QueryRequest{query, patience(number)}, {}, number,
    [this, owner, invoked](const Outstanding&, const Outcome<std::vector<EntryPtr>>& answer) {
      if (!answer)
        return;
      for (std::uint32_t entry = 0; entry < views_.size(); ++entry) {
        if (world_.entries[entry].owner != owner)
          continue;
        auto found = std::ranges::find(*answer, world_.entries[entry].address,
                                       [](auto& e) { return e->address; });
        OperationRecord x;
        x.client = number_;
        x.entry = entry;
        x.kind = found == answer->end() ? OperationKind::exists : OperationKind::read;
        auto record = world_.recorder.invoked(x, invoked);
        views_[entry].present = found != answer->end();
        if (found == answer->end()) {
          world_.recorder.returned(record, {Status::does_not_exist});
        } else {
          views_[entry].seen = (*found)->version;
          world_.recorder.returned(record, {Status::ok, (*found)->version, content_of(**found)});
        }
      }
    });
}

// -- what came of it

void SimulatedClient::wrote(Index index, Version version) {
  world_.recorder.returned(index, {Status::ok, version});
  auto& record = world_.recorder[index];
  auto& view = views_[record.entry];
  view.present = record.kind != OperationKind::remove;
  if (view.present) {
    view.seen = std::max(version, view.seen.value_or(0));
  } else {
    view.seen.reset();
    view.lose_lease();
  }
}

void SimulatedClient::failed(Index index, const Failure& failure) {
  if (failure.kind == FailureKind::working_memory_lost && deadline() != caf::infinite) {
    // The working memory is lost, which its own one knows.
    world_.recorder.did_not_happen(index);
    return;
  }
  auto status = status_of(failure.kind, world_.recorder[index].kind);
  if (!status) {
    world_.find("an operation that cannot end so: " + failure.message);
    status = Status::timed_out;
  }
  world_.recorder.returned(index, {*status});
  auto& record = world_.recorder[index];
  auto& view = views_[record.entry];
  if (failure.kind == FailureKind::does_not_exist) {
    view.present = false;
    view.seen.reset();
  } else if (failure.kind == FailureKind::already_exists) {
    view.present = true;
  } else if (failure.kind == FailureKind::inconsistent) {
    view.present = true;
    view.seen.reset();
  }
  auto in_hand = record.token != 0 && record.token == view.token;
  if (record.kind == OperationKind::unlock && in_hand)
    view.lose_lease();
}

} // namespace castor::linearizability
