#include "castor/tools/simulation/simulated_client.hpp"

#include <algorithm>
#include <array>
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
    views_(std::move(parts_.views)) {
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
  };
}

// -- what to do

void SimulatedClient::step() {
  stepping_ = false;
  if (parts_.temper.mortal && world_.chance(6)) {
    die();
    return;
  }
  if (parts_.temper.impatient && world_.chance(30))
    give_up_something();
  if (!parts_.temper.negligent && world_.chance(60))
    renew();
  for (auto operations = world_.chance(70) ? 1 : 1 + world_.pick(4);
       operations > 0 && world_.operations_left > 0; --operations)
    act();
  auto patient = outstanding_.size() >= most_outstanding || world_.chance(50);
  if (!patient || !is_waiting())
    go_on();
}

bool SimulatedClient::is_waiting() const {
  return std::ranges::any_of(outstanding_, [](auto& x) { return x.given_up_by == 0; });
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
    begin(entry, pick_kind(views_[entry]));
  }
}

OperationKind SimulatedClient::pick_kind(const EntryView& view) {
  using enum OperationKind;
  if (!view.present && world_.chance(30))
    return add;
  if (view.times > 0 && world_.chance(35))
    return unlock;
  // Who has not seen the entry reads it rather than failing to overwrite it.
  if (!view.seen && world_.chance(40))
    return read;
  static constexpr std::array kinds{
    add,  overwrite, overwrite, overwrite, overwrite, overwrite, remove,   read,
    read, exists,    version,   lock,      lock,      lock,      try_lock, unlock,
  };
  return kinds[world_.pick(kinds.size())];
}

std::optional<Version> SimulatedClient::version_to_show(const EntryView& view) {
  if (parts_.temper.forges && world_.chance(20))
    return world_.chance(20) ? std::nullopt : std::optional{view.seen.value_or(0) + world_.pick(3)};
  return view.seen;
}

Token SimulatedClient::token_to_show(std::uint32_t entry) {
  auto& view = views_[entry];
  if (!parts_.temper.forges || !world_.chance(25))
    return view.token;
  // Somebody else's, perhaps.
  if (world_.chance(30))
    return world_.entries[entry].last_token;
  return view.old_tokens.empty() ? 0 : view.old_tokens[world_.pick(view.old_tokens.size())];
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
  if (parts_.temper.forges)
    for (auto& view : successor.views = views_)
      lost(view);
  if (world_.chance(70))
    spawn(system(), std::move(successor));
  quit(caf::exit_reason::kill);
}

void SimulatedClient::rest() {
  for (auto& x : outstanding_) {
    if (x.given_up_by == 0)
      world_.find(to_string(*identity_) + " was never answered its message " +
                  std::to_string(x.number));
    else
      for (auto record : x.records)
        world_.recorder.returned(record, {Status::timed_out});
  }
  outstanding_.clear();
  for (auto& x : unwanted_)
    world_.recorder.has_ended(x.entry, x.token);
  unwanted_.clear();
}

// -- operations

SimulatedClient::Route SimulatedClient::route_to(std::uint32_t entry) {
  auto via = parts_.temper.roams ? world_.pick(world_.working_memories.size()) : parts_.home;
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
    x.last_seen = version_to_show(view);
  if (kind != OperationKind::add)
    x.token = token_to_show(entry);
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

template <class Reply, class Request, class F>
void SimulatedClient::ask(Route route, const Request& message, std::vector<Index> records,
                          WaitNumber wait, F answered) {
  auto number = ++sent_;
  outstanding_.push_back({number, route, std::move(records), wait});
  request(way_to(route.via), deadline(), message)
    .then(
      [this, number, answered](const Outcome<Reply>& x) {
        auto arrived = x || x.failure().kind != FailureKind::working_memory_lost;
        answered(take_outstanding(number, arrived), x);
        if (!is_waiting())
          go_on();
      },
      [this, number](const caf::error& e) { not_answered(number, e); });
}

/// What was asked for may have been done, or not.
void SimulatedClient::not_answered(std::uint64_t number, const caf::error& e) {
  if (deadline() == caf::infinite)
    world_.find("no answer: " + system().render(e));
  std::erase_if(outstanding_, [&](auto& x) {
    if (x.number == number)
      for (auto record : x.records)
        views_[world_.recorder[record].entry].unsure = true;
    return x.number == number;
  });
  if (!is_waiting())
    go_on();
}

/// Of messages that take one route, the answer to a later one says that the earlier have arrived,
/// if that one has.
SimulatedClient::Outstanding SimulatedClient::take_outstanding(std::uint64_t number, bool arrived) {
  auto& recorder = world_.recorder;
  Outstanding result = *std::ranges::find(outstanding_, number, &Outstanding::number);
  std::erase_if(outstanding_, [&](auto& x) {
    if (x.number == number)
      return true;
    if (!arrived || !(x.route == result.route) || x.number > number)
      return false;
    auto was_given_up = x.given_up_by != 0 && x.given_up_by < number;
    for (auto record : x.records)
      if (was_given_up)
        recorder.returned(record, {Status::timed_out});
      else
        recorder.known_to_have_arrived(record);
    return was_given_up;
  });
  std::erase_if(unwanted_, [&](auto& x) {
    auto has_ended = arrived && x.route == result.route && x.given_up_by < number;
    if (has_ended)
      recorder.has_ended(x.entry, x.token);
    return has_ended;
  });
  return result;
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
      x.token = token_to_show(entry);
      unlock(x);
      break;
    case OperationKind::read: {
      auto record = recorder.invoked(x);
      auto number = ++last_wait_;
      ask<EntryPtr>(
        route_to(entry), ReadRequest{address, patience(number)}, {record}, number,
        [this, record, &view](const Outstanding&, const Outcome<EntryPtr>& answer) {
          if (!answer)
            return failed(record, answer.failure());
          view.present = true;
          view.seen = (*answer)->version;
          world_.recorder.returned(record, {Status::ok, (*answer)->version, content_of(**answer)});
        });
      break;
    }
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
  auto via = parts_.temper.roams ? world_.pick(world_.working_memories.size()) : parts_.home;
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
  auto via = parts_.temper.roams ? world_.pick(world_.working_memories.size()) : parts_.home;
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

void SimulatedClient::lock(OperationRecord x) {
  x.level = LockLevel(1 + world_.pick(3));
  auto record = world_.recorder.invoked(x);
  auto number = ++last_wait_;
  auto wait = patience(number);
  if (x.kind == OperationKind::try_lock)
    wait.at_most = Timestamp{0};
  ask<castor::Lease>(
    route_to(x.entry), LockRequest{world_.entries[x.entry].address, level_of(x.level), wait},
    {record}, number, [this, record](const Outstanding& out, const Outcome<castor::Lease>& answer) {
      if (answer)
        obtained(out, answer->token);
      else
        failed(record, answer.failure());
    });
}

void SimulatedClient::unlock(const OperationRecord& x) {
  auto record = world_.recorder.invoked(x);
  ask<Acknowledged>(route_to(x.entry),
                    UnlockRequest{world_.entries[x.entry].address, identity_, x.token}, {record}, 0,
                    [this, record](const Outstanding&, const Outcome<Acknowledged>& answer) {
                      if (!answer)
                        return failed(record, answer.failure());
                      world_.recorder.returned(record, {});
                      auto& operation = world_.recorder[record];
                      auto& view = views_[operation.entry];
                      if (view.token == operation.token && --view.times == 0) {
                        view.returned_tokens.push_back(view.token);
                        lost(view);
                      }
                    });
}

/// Directly, as the keeper does.
void SimulatedClient::renew() {
  auto& recorder = world_.recorder;
  for (std::size_t owner = 0; owner < world_.working_memories.size(); ++owner) {
    RenewRequest message{identity_, {}};
    std::vector<std::pair<std::uint32_t, Token>> renewed;
    for (std::uint32_t entry = 0; entry < views_.size(); ++entry) {
      auto& view = views_[entry];
      if (world_.entries[entry].owner != owner)
        continue;
      for (auto token : {view.token, view.returned_tokens.empty() ? 0 : view.returned_tokens[0]}) {
        if (token == 0)
          continue;
        message.leases.push_back({world_.entries[entry].address.id, token});
        renewed.emplace_back(entry, token);
        recorder.renewing(entry, token);
      }
    }
    auto to = way_to(owner);
    if (renewed.empty() || !to)
      continue;
    request(to, deadline(), message)
      .then(
        [this, renewed, sent = recorder.now()](const RenewReply& answer) {
          for (auto& [entry, token] : renewed) {
            auto is_lost = std::ranges::count(answer.lost, token, &HeldToken::token) > 0;
            if (is_lost)
              world_.recorder.not_renewed(entry, token);
            else
              world_.recorder.renewed(entry, token, sent);
            if (!is_lost && !may_hold_unawares(entry) &&
                std::ranges::count(views_[entry].returned_tokens, token) > 0)
              world_.find("client " + std::to_string(number_) + " renewed token " +
                          std::to_string(token) + ", which it had given back");
          }
        },
        // Whether they were renewed is not known then.
        [](const caf::error&) {});
  }
}

bool SimulatedClient::may_hold_unawares(std::uint32_t entry) const {
  return views_[entry].unsure ||
         (deadline() != caf::infinite && std::ranges::any_of(outstanding_, [&](auto& x) {
            return std::ranges::any_of(
              x.records, [&](auto record) { return world_.recorder[record].entry == entry; });
          }));
}

void SimulatedClient::give_up_something() {
  // What comes through another working memory may overtake.
  if (parts_.temper.roams)
    return;
  auto can_be_given_up = [&](const Outstanding& x) {
    if (x.wait == 0 || x.given_up_by != 0 || x.records.empty())
      return false;
    auto& record = world_.recorder[x.records.front()];
    if (record.kind == OperationKind::read)
      return true;
    // A lease that it has or will have is not to be given up with the wait.
    return record.kind == OperationKind::lock && views_[record.entry].times == 0 &&
           std::ranges::count_if(outstanding_, [&](auto& y) {
             return y.given_up_by == 0 && !y.records.empty() &&
                    world_.recorder[y.records.front()].entry == record.entry &&
                    (world_.recorder[y.records.front()].kind == OperationKind::lock ||
                     world_.recorder[y.records.front()].kind == OperationKind::try_lock);
           }) == 1;
  };
  auto i = std::ranges::find_if(outstanding_, can_be_given_up);
  if (i == outstanding_.end())
    return;
  i->given_up_by = ++sent_;
  i->given_up_at = world_.recorder.tick();
  auto& address = world_.entries[world_.recorder[i->records.front()].entry].address;
  send(way_to(i->route.via), CancelWait{address, identity_, i->wait});
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
    lost(view);
  }
}

void SimulatedClient::obtained(const Outstanding& x, Token token) {
  auto& recorder = world_.recorder;
  auto record = x.records.front();
  recorder.returned(record, {.token = token});
  recorder.obtained(record);
  auto entry = recorder[record].entry;
  world_.entries[entry].last_token = token;
  if (x.given_up_by != 0) {
    recorder.may_end(entry, token, x.given_up_at);
    unwanted_.push_back({entry, token, x.route, x.given_up_by});
    return;
  }
  auto& view = views_[entry];
  view.present = true;
  if (view.token != token) {
    lost(view);
    view.token = token;
  }
  ++view.times;
}

void SimulatedClient::lost(EntryView& view) {
  if (view.token != 0)
    view.old_tokens.push_back(view.token);
  view.token = 0;
  view.times = 0;
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
    lost(view);
}

} // namespace castor::linearizability
