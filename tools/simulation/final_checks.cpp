#include "castor/tools/simulation/final_checks.hpp"

#include "castor/actors/component/health.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace castor::simulation {

namespace {

using namespace std::chrono_literals;
using linearizability::OperationKind;
using linearizability::OperationRecord;
using linearizability::Status;

/// Longer than any wait, or answer.
constexpr std::chrono::milliseconds long_time{1300};
constexpr const char* sentinel = "sentinel";

} // namespace

void FinalChecks::run() {
  world_.operations_left = 0;
  world_.tasks_left = 0;
  world_.calls.calls_left = 0;
  auto quiet_since = schedule_.time() + long_time;
  schedule_.advance(quiet_since);
  world_.recorder.deaths_are_known();
  check_ended_clients();
  check_calls();
  check_tasks();
  leave_sentinels();
  // Nobody renews any more.
  schedule_.advance(
    std::max(schedule_.time(), quiet_since + lease_ + world_.clocks_behind + 100ms));
  for (std::uint32_t entry = 0; entry < world_.entries.size(); ++entry)
    look_at(entry);
  for (auto& [name, lives] : machines_.memories())
    check_memory(name, lives.back());
  for (auto& told : world_.told)
    check_told(*told);
  check_health();
  journal_counts_ = check_journals(world_, machines_);
}

void FinalChecks::check_ended_clients() {
  for (auto& entry : world_.entries)
    if (auto status = ask<Outcome<LockStatus>>(owner_of(entry), LockQuery{entry.address});
        status && status->holder &&
        std::ranges::count(world_.dead, *status->holder, [](auto& x) { return *x; }) > 0)
      world_.find(to_string(*status->holder) + " has ended and holds a lease of " +
                  to_string(entry.address));
}

/// Now that everybody is there, a call is replied to, and nothing is left of those that are over.
void FinalChecks::check_calls() {
  if (!world_.serves_calls)
    return;
  auto& subarchitectures = architecture_.subarchitectures;
  auto& caller = subarchitectures[world_.pick(3)].components[world_.pick(2)].name;
  auto& to = subarchitectures[world_.pick(3)].name;
  auto reply = std::make_shared<std::optional<bool>>();
  auto component = caf::actor_cast<caf::actor>(world_.components.at(caller));
  stage_.system.spawn([reply, component, to](caf::event_based_actor* self) {
    self->request(component, caf::infinite, MakeCall{to}).then([reply](bool x) { *reply = x; });
  });
  if (!schedule_.advance_until(schedule_.time() + long_time, [&] { return reply->has_value(); }) ||
      !**reply)
    world_.find("the call of " + caller + " to " + to + " is not replied to");
  schedule_.advance(schedule_.time() + 100ms);
  for (auto& [name, lives] : machines_.memories())
    for (auto& type :
         {type_name<Call>(), type_name<CallProgress>(), type_name<Question>(), type_name<Reply>()})
      check_nothing_left(name, type, lives.back().actor);
}

void FinalChecks::check_nothing_left(const std::string& name, const std::string& type,
                                     const WorkingMemoryActor& memory) {
  TypeQuery query;
  query.subarchitecture = name;
  query.type = type;
  auto entries = ask<Outcome<std::vector<EntryPtr>>>(memory, QueryRequest{query, {}});
  if (!entries || !entries->empty())
    world_.find("left of finished calls: a " + type + " left in " + name +
                (entries ? ": " + to_string(entries->front()->address) : ""));
}

/// Nothing is under way any more, and what waits has a reason to.
void FinalChecks::check_tasks() {
  std::vector<ComponentLife> managers;
  for (auto& [name, component] : world_.components)
    if (auto* manager = component->task_manager()) {
      managers.push_back(component->life());
      if (manager->used() > 0)
        world_.find(name + " regards tasks as adopted that cost " +
                    std::to_string(manager->used()) + ", and all are over");
    }
  for (auto& x : world_.tasks.overlooked(managers, world_.task_rules.budget))
    world_.find(x);
}

/// Everybody has to hear of one last change in every working memory.
void FinalChecks::leave_sentinels() {
  static const auto client =
    std::make_shared<const castor::Client>(castor::Client{"looker", "a", 1});
  for (auto& [name, lives] : machines_.memories()) {
    WriteRequest request;
    request.address = {name, sentinel};
    request.value = Value::of(linearizability::Stamp{});
    request.client = client;
    if (!ask<Outcome<Version>>(lives.back().actor, request))
      world_.find("nothing can be added to " + name);
  }
  schedule_.advance(schedule_.time() + 300ms);
}

void FinalChecks::look_at(std::uint32_t entry) {
  auto& recorder = world_.recorder;
  auto& address = world_.entries[entry].address;
  auto owner = owner_of(world_.entries[entry]);
  OperationRecord x;
  x.entry = entry;
  x.kind = OperationKind::read;
  auto record = recorder.invoked(x);
  if (auto found = ask<Outcome<EntryPtr>>(owner, ReadRequest{address, {}}))
    recorder.returned(record,
                      {Status::ok, (*found)->version, linearizability::content_of(**found)});
  else
    recorder.returned(record, {Status::does_not_exist});
}

void FinalChecks::check_memory(const std::string& name, const MemoryLife& memory) {
  auto status = ask<WorkingMemoryStatus>(memory.actor, StatusQuery{});
  if (status.leases != 0 || status.waiting != 0)
    world_.find("at the end " + name + " has " + std::to_string(status.leases) + " leases, and " +
                std::to_string(status.waiting) + " operations wait there");
  for (auto& told : world_.told) {
    if (!told->alive || machines_.have_lost(told->process, memory.process))
      continue;
    auto last = std::ranges::find(told->events.rbegin(), told->events.rend(), name,
                                  [](auto& x) { return x->address.subarchitecture; });
    if (last == told->events.rend() || (*last)->sequence != status.events)
      world_.find(told->component + " was not told of the last change in " + name + ", but " +
                  (last == told->events.rend() ? "of none" : "of " + to_string(**last)));
  }
}

/// The events of each life of a working memory came one after the other.
void FinalChecks::check_told(const Told& told) {
  std::map<std::pair<std::string, std::uint64_t>, std::uint64_t> last;
  for (auto& event : told.events) {
    auto& lives = machines_.memories().at(event->address.subarchitecture);
    auto memory = life_of(*event, lives);
    if (memory == lives.end())
      throw std::runtime_error{"no working memory made this change: " + to_string(*event)};
    auto life = memory->incarnation;
    if (machines_.have_lost(told.process, memory->process))
      continue;
    auto& sequence = last[{event->address.subarchitecture, life}];
    if (sequence != 0 && event->sequence != sequence + 1)
      world_.find(told.component + " was told of " + to_string(*event) + ", number " +
                  std::to_string(event->sequence) + ", after number " + std::to_string(sequence));
    sequence = event->sequence;
  }
}

/// The last word of everybody who ever failed is that it is back.
void FinalChecks::check_health() {
  TypeQuery all;
  all.subarchitecture = health_subarchitecture;
  auto& memory = machines_.memories().at(health_subarchitecture).back();
  auto entries = ask<Outcome<std::vector<EntryPtr>>>(memory.actor, QueryRequest{all, {}});
  if (!entries)
    return world_.find("nothing is known of the system's health");
  for (auto& entry : *entries) {
    auto up = entry->value.as<ComponentUp>();
    if (entry->address.id == sentinel)
      continue;
    if (!up)
      world_.find("at the end " + entry->address.id + " is not reported as up");
    else if (auto i = world_.components.find(up->component);
             i != world_.components.end() &&
             i->second->record().identity().incarnation != up->incarnation)
      world_.find(up->component + " is reported as up in another incarnation than its own");
  }
}

WorkingMemoryActor FinalChecks::owner_of(const SystemWorld::SimulatedEntry& x) const {
  return machines_.memories().at(x.address.subarchitecture).back().actor;
}

} // namespace castor::simulation
