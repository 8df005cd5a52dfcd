#include "castor/tools/simulation/system_simulation.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/actors/node/part_agent.hpp"
#include "castor/actors/supervision/supervisor.hpp"
#include "castor/base/log.hpp"
#include "castor/tools/chaos/minimise.hpp"
#include "castor/tools/simulation/simulated_architecture.hpp"
#include "castor/tools/simulation/simulated_machines.hpp"
#include "castor/tools/simulation/testing_system.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <caf/actor_registry.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace castor::simulation {

namespace {

using namespace std::chrono_literals;
using linearizability::OperationKind;
using linearizability::OperationRecord;
using linearizability::Status;

/// So short that leases run out while the system runs, or so long that only their holders end them.
constexpr std::array<std::chrono::milliseconds, 3> lease_durations{300ms, 300ms, 3000ms};
/// The system is whole again so long after everything works.
constexpr Timestamp most_recovery{20s};
/// A component is back so soon if nothing but components fails.
constexpr Timestamp most_downtime{2s};
/// Longer than any wait, or answer.
constexpr std::chrono::milliseconds long_time{1300};
/// Far more than a run takes.
constexpr std::size_t most_steps = 400'000;
constexpr const char* sentinel = "sentinel";
/// A journal is written so long after its delay at the latest, if nothing goes wrong.
constexpr std::chrono::milliseconds most_journal_latency{100};

/// The changes in a journal.
class JournalContents {
public:
  explicit JournalContents(const std::vector<JournalRecord>& records) {
    for (auto& x : records) {
      records_[x.sequence] = &x;
      last_[x.session] = x.sequence;
    }
  }

  bool has(const ChangeEvent& event) const {
    auto i = records_.find(event.sequence);
    return i != records_.end() && i->second->id == event.address.id &&
           i->second->version == event.version && i->second->operation == event.operation;
  }

  /// The number of the last change of a session, if it has made any.
  std::optional<std::uint64_t> last_of(std::uint64_t session) const {
    auto i = last_.find(session);
    return i == last_.end() ? std::nullopt : std::optional{i->second};
  }

private:
  std::map<std::uint64_t, const JournalRecord*> records_;
  std::map<std::uint64_t, std::uint64_t> last_;
};

} // namespace

/// The actor system, which outlasts a seed, and what plays on it.
class SystemSimulation::Stage : private TestingSystem {
public:
  Stage() { set_log_level(LogLevel::off); }

  SystemResult run(std::uint64_t seed, const faults::FaultPlan& faults) {
    auto actors_before = system.registry().running();
    lease_ = lease_durations[seed % lease_durations.size()];
    SystemWorld world{seed, lease_};
    world_ = &world;
    SystemResult result;
    result.faults = faults;
    result.seed = seed;
    result_ = &result;
    begin_ = scheduler.clock().now();
    SimulatedMachines simulated{system, world, machine_count(seed)};
    machines_ = &simulated;
    world.run_jobs_of = [this](Life x) { run_jobs_of(x); };
    try {
      set_up();
      play();
      if (world.findings.empty())
        look_back();
    } catch (const std::exception& error) {
      world.find(error.what());
    }
    note_losses();
    result.history = world.recorder.finish();
    result.verdict = checker_.check(result.history);
    count(result);
    for (auto& x : result.history)
      world.note(to_string(x));
    result.digest = world.digest;
    clear();
    if (auto actors = system.registry().running(); actors != actors_before)
      world.find(std::to_string(actors - actors_before) + " actors are left");
    result.findings = std::move(world.findings);
    machines_ = nullptr;
    world_ = nullptr;
    return result;
  }

private:
  // -- setting up

  void set_up() {
    auto& world = *world_;
    world.recorder.set_time(Timestamp{0});
    auto strategy = world.pick(3);
    auto escalates = world.chance(30);
    architecture_ = simulated_architecture({lease_, strategy, escalates, world.chance(40),
                                            machines_->count(), journal_mode(result_->seed)});
    for_each_component(architecture_, [&](ComponentDescription& x) {
      auto home = std::size_t(x.subarchitecture.front() - 'a');
      auto strays = x.kind == ComponentKind::managed && world.chance(20);
      x.host = machines[(strays ? world.pick(machines.size()) : home) % machines_->count()];
      if (x.host == machines[0])
        x.host = "localhost";
    });
    for (auto& x : architecture_.subarchitectures)
      world.working_memories.push_back({x.name, {}});
    for (std::size_t entries = 2 + world.pick(3), i = 0; i < entries; ++i) {
      auto owner = world.pick(3);
      world.entries.push_back(
        {{world.working_memories[owner].subarchitecture, std::string(1, char('w' + i))}, owner});
    }
    world.longest_pause = std::chrono::milliseconds{1 + world.pick(200)};
    world.operations_left = 20 + world.pick(50);
    if (world.chance(50))
      world.tasks_left = 3 + world.pick(10);
    world.task_rules.budget = 2;
    world.task_rules.backfill = world.chance(50);
    world.tasks.set_have_lost([this](Life a, Life b) { return machines_->have_lost(a, b); });
    world.serves_calls = world.chance(40);
    if (world.serves_calls)
      world.calls.calls_left = 1 + world.pick(3);
    world.calls.find = [&world](std::string what) { world.find(std::move(what)); };
    world.calls.note = [&world](const std::string& what) { world.note(what); };
    machines_->network().set_delays(unsigned(world.pick(50)),
                                    std::chrono::milliseconds{world.pick(20)});
    set_up_processes();
  }

  void set_up_processes() {
    options_ = {};
    options_.open_access = true;
    options_.part_patience = 5s;
    // Longer than anybody hangs: who does not stop is not started again.
    options_.stop_patience = 3s;
    options_.link = SimulatedMachines::link_options();
    options_.on_down = [this](const ComponentDown& x) { went_down(x); };
    options_.on_up = [this](const ComponentUp& x) { came_up(x); };
    for (std::size_t x = 1; x < machines_->count(); ++x)
      machines_->start_node(x);
    processes_.emplace(
      system, options_, "simulated", [this](const LinkNews& x) { caf::anon_send(supervisor_, x); },
      machines_->spawn_link(0));
    end_listener_ = system.spawn([this]() -> caf::behavior {
      return {[this](const EndSystem& x) { ended_.emplace(x.reason); }};
    });
    SupervisorParts parts;
    parts.processes = &*processes_;
    parts.options = &options_;
    parts.epoch = begin_;
    parts.seed = world_->random();
    parts.end_listener = end_listener_;
    parts.on_change = [](const SystemRosterPtr&) {};
    supervisor_ = system.spawn(supervisor, std::move(parts));
    world_->expect_no_exception(supervisor_, "the supervisor");
    PartAgentParts agent;
    agent.mesh = processes_->mesh();
    agent.messages = processes_->messages();
    agent.spawn = machines_->spawn(0);
    agent_ = system.spawn(part_agent, std::move(agent));
    world_->expect_no_exception(agent_, "the agent of the coordinator's part");
    processes_->set_own_agent(agent_);
    std::map<std::string, Endpoint> nodes;
    for (std::size_t x = 1; x < machines_->count(); ++x)
      nodes[std::string{machines[x]}] = SimulatedMachines::endpoint_of(x);
    auto placement = place(architecture_, nodes);
    processes_->open(placement);
    StartComponents start;
    for_each_component(architecture_, [&](auto& x) { start.names.push_back(x.name); });
    phase_controller_ = system.spawn([this, start, deploy = Deploy{architecture_, placement}](
                                       caf::event_based_actor* self) -> caf::behavior {
      self->request(supervisor_, caf::infinite, deploy)
        .then([this, self, start](const Deployed& x) {
          if (!x.problems.empty())
            throw std::runtime_error(render(x.problems));
          self->request(supervisor_, caf::infinite, start).then([this](ComponentsStarted) {
            started_ = true;
          });
        });
      return {[](Acknowledged) {}};
    });
    if (!advance_until(time() + 20s, [this] { return started_; }))
      throw std::runtime_error{"the system does not start"};
  }

  // -- playing

  void play() {
    auto& faults = result_->faults.statements;
    due_.clear();
    auto start = time();
    for (auto& x : faults)
      due_.emplace(start + std::get<faults::At>(x.trigger).time, x.faults.front());
    advance(start + time_of_faults);
    // The last of them may take its time.
    auto lasts_until = time();
    for (auto& x : faults)
      if (auto duration = faults::duration_of(x.faults.front()))
        lasts_until =
          std::max(lasts_until, start + std::get<faults::At>(x.trigger).time + *duration);
    advance(lasts_until);
    machines_->heal();
    recover();
  }

  void recover() {
    auto until = time() + most_recovery;
    constexpr Timestamp calm{500ms};
    while (time() < until && world_->findings.empty()) {
      advance_until(until, [this] { return why_not_whole().empty(); });
      auto failures = result_->failures;
      advance(time() + calm);
      if (failures == result_->failures && why_not_whole().empty())
        return;
    }
    if (!world_->findings.empty())
      return;
    auto why = why_not_whole();
    world_->find("it is not whole again: " +
                 (why.empty() ? "components fail again and again" : why));
  }

  /// Empty if all of the system is there.
  std::string why_not_whole() const {
    if (ended_)
      return "it has ended: " + *ended_;
    for (auto& x : architecture_.subarchitectures) {
      auto lives = machines_->memories().find(x.name);
      if (lives == machines_->memories().end() || !lives->second.back().alive())
        return "there is no working memory of " + x.name;
      for (auto* component : {&x.task_manager, &x.components[0], &x.components[1]}) {
        auto i = world_->components.find(component->name);
        if (i == world_->components.end())
          return component->name + " is not there";
        if (i->second->record().state() != ComponentState::running)
          return component->name + " does not run";
      }
    }
    if (!down_.empty())
      return down_.begin()->first + " is not known to be back";
    return {};
  }

  Timestamp time() const {
    return std::chrono::duration_cast<Timestamp>(scheduler.clock().now() - begin_);
  }

  void advance(Timestamp until) {
    advance_until(until, [] { return false; });
  }

  /// Runs who is ready, in any order, until then; true as soon as it is enough.
  template <class F>
  bool advance_until(Timestamp until, F&& enough) {
    auto& world = *world_;
    auto& jobs = scheduler.jobs;
    for (;;) {
      if (++result_->steps > most_steps)
        throw std::runtime_error{"it does not come to rest"};
      while (!due_.empty() && due_.begin()->first <= time()) {
        auto fault = due_.extract(due_.begin());
        machines_->inject(fault.mapped(), result_->seed);
      }
      machines_->catch_up();
      auto job = ready_job();
      if (job == jobs.size()) {
        if (enough())
          return true;
        if (time() >= until)
          return false;
        let_time_pass(std::max(Timestamp{1}, std::min(until, next_event()) - time()));
        continue;
      }
      if (world.chance(1))
        let_time_pass(std::chrono::milliseconds{1 + world.pick(5)});
      else
        run_one(job);
    }
  }

  /// One of those that may run; as many as there are if none may.
  std::size_t ready_job() {
    auto& jobs = scheduler.jobs;
    if (jobs.empty())
      return 0;
    auto first = world_->pick(jobs.size());
    if (machines_->all_may_run())
      return first;
    for (std::size_t i = 0; i < jobs.size(); ++i)
      if (auto job = (first + i) % jobs.size(); machines_->may_run(jobs[job]))
        return job;
    return jobs.size();
  }

  Timestamp next_event() {
    auto& clock = scheduler.clock();
    auto result = machines_->next_event();
    if (clock.has_pending_timeout())
      result = std::min(result, clock.schedule().begin()->first);
    auto next = result == caf::actor_clock::time_point::max()
                  ? Timestamp::max()
                  : std::chrono::ceil<Timestamp>(result - begin_);
    return due_.empty() ? next : std::min(next, due_.begin()->first);
  }

  void run_jobs_of(Life x) {
    scheduler.run_jobs_filtered([&](caf::resumable* job) {
      auto owner = world_->owners.find(job);
      return owner != world_->owners.end() && owner->second == x;
    });
  }

  void let_time_pass(Timestamp x) {
    scheduler.advance_time(x);
    world_->recorder.set_time(time());
  }

  // -- what is made known

  void went_down(const ComponentDown& x) {
    ++result_->failures;
    world_->note(x.component);
    world_->note(std::uint64_t(time().count()));
    if (!x.will_restart)
      world_->find(x.component + " is not started again: " + x.reason);
    down_.emplace(x.component, time());
  }

  void came_up(const ComponentUp& x) {
    ++result_->returns;
    world_->note(x.component);
    auto since = down_.extract(x.component);
    if (!since)
      world_->find(x.component + " is said to be back and was not down");
    else if (!machines_->are_processes_affected() && time() - since.mapped() > most_downtime)
      world_->find(x.component + " was not there for " +
                   std::to_string((time() - since.mapped()).count() / 1000) + " ms");
  }

  // -- looking back

  void look_back() {
    world_->operations_left = 0;
    world_->tasks_left = 0;
    world_->calls.calls_left = 0;
    auto quiet_since = time() + long_time;
    advance(quiet_since);
    world_->recorder.deaths_are_known();
    check_the_dead();
    check_calls();
    check_tasks();
    leave_sentinels();
    // Nobody renews any more.
    advance(std::max(time(), quiet_since + lease_ + world_->clocks_behind + 100ms));
    for (std::uint32_t entry = 0; entry < world_->entries.size(); ++entry)
      look_at(entry);
    for (auto& [name, lives] : machines_->memories())
      check_memory(name, lives.back());
    for (auto& told : world_->told)
      check_told(*told);
    check_health();
    check_journals();
  }

  void check_the_dead() {
    for (auto& entry : world_->entries)
      if (auto status = ask<Outcome<LockStatus>>(owner_of(entry), LockQuery{entry.address});
          status && status->holder &&
          std::ranges::count(world_->dead, *status->holder, [](auto& x) { return *x; }) > 0)
        world_->find(to_string(*status->holder) + " is dead and holds a lease of " +
                     to_string(entry.address));
  }

  /// Now that everybody is there, a call is replied to, and nothing is left of those that are over.
  void check_calls() {
    if (!world_->serves_calls)
      return;
    auto& subarchitectures = architecture_.subarchitectures;
    auto& caller = subarchitectures[world_->pick(3)].components[world_->pick(2)].name;
    auto& to = subarchitectures[world_->pick(3)].name;
    auto reply = std::make_shared<std::optional<bool>>();
    auto component = caf::actor_cast<caf::actor>(world_->components.at(caller));
    system.spawn([reply, component, to](caf::event_based_actor* self) {
      self->request(component, caf::infinite, MakeCall{to}).then([reply](bool x) { *reply = x; });
    });
    if (!advance_until(time() + long_time, [&] { return reply->has_value(); }) || !**reply)
      world_->find("the call of " + caller + " to " + to + " is not replied to");
    advance(time() + 100ms);
    for (auto& [name, lives] : machines_->memories())
      for (auto& type : {type_name<Call>(), type_name<CallProgress>(), type_name<Question>(),
                         type_name<Reply>()})
        check_nothing_left(name, type, lives.back().actor);
  }

  void check_nothing_left(const std::string& name, const std::string& type,
                          const WorkingMemoryActor& memory) {
    TypeQuery query;
    query.subarchitecture = name;
    query.type = type;
    auto entries = ask<Outcome<std::vector<EntryPtr>>>(memory, QueryRequest{query, {}});
    if (!entries || !entries->empty())
      world_->find("of calls that are over there is a " + type + " left in " + name +
                   (entries ? ": " + to_string(entries->front()->address) : ""));
  }

  /// Nothing is under way any more, and what waits has a reason to.
  void check_tasks() {
    std::vector<ComponentLife> managers;
    for (auto& [name, component] : world_->components)
      if (auto* manager = component->task_manager()) {
        managers.push_back(component->life());
        if (manager->used() > 0)
          world_->find(name + " takes tasks for adopted that cost " +
                       std::to_string(manager->used()) + ", and all are over");
      }
    for (auto& x : world_->tasks.overlooked(managers, world_->task_rules.budget))
      world_->find(x);
  }

  /// Everybody has to hear of one last change in every working memory.
  void leave_sentinels() {
    static const auto client =
      std::make_shared<const castor::Client>(castor::Client{"looker", "a", 1});
    for (auto& [name, lives] : machines_->memories()) {
      WriteRequest request;
      request.address = {name, sentinel};
      request.value = Value::of(linearizability::Stamp{});
      request.client = client;
      if (!ask<Outcome<Version>>(lives.back().actor, request))
        world_->find("nothing can be added to " + name);
    }
    advance(time() + 300ms);
  }

  void look_at(std::uint32_t entry) {
    auto& recorder = world_->recorder;
    auto& address = world_->entries[entry].address;
    auto owner = owner_of(world_->entries[entry]);
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

  void check_memory(const std::string& name, const MemoryLife& memory) {
    auto status = ask<WorkingMemoryStatus>(memory.actor, StatusQuery{});
    if (status.leases != 0 || status.waiting != 0)
      world_->find("at the end " + name + " has " + std::to_string(status.leases) +
                   " leases, and " + std::to_string(status.waiting) + " operations wait there");
    for (auto& told : world_->told) {
      if (!told->alive || machines_->have_lost(told->process, memory.process))
        continue;
      auto last = std::ranges::find(told->events.rbegin(), told->events.rend(), name,
                                    [](auto& x) { return x->address.subarchitecture; });
      if (last == told->events.rend() || (*last)->sequence != status.events)
        world_->find(told->component + " was not told of the last change in " + name + ", but " +
                     (last == told->events.rend() ? "of none" : "of " + to_string(**last)));
    }
  }

  /// The events of each life of a working memory came one after the other.
  void check_told(const Told& told) {
    std::map<std::pair<std::string, std::uint64_t>, std::uint64_t> last;
    for (auto& event : told.events) {
      auto& lives = machines_->memories().at(event->address.subarchitecture);
      auto memory = life_of(*event, lives);
      if (memory == lives.end())
        throw std::runtime_error{"nobody has made this change: " + to_string(*event)};
      auto life = memory->incarnation;
      if (machines_->have_lost(told.process, memory->process))
        continue;
      auto& sequence = last[{event->address.subarchitecture, life}];
      if (sequence != 0 && event->sequence != sequence + 1)
        world_->find(told.component + " was told of " + to_string(*event) + ", number " +
                     std::to_string(event->sequence) + ", after number " +
                     std::to_string(sequence));
      sequence = event->sequence;
    }
  }

  /// The life of a working memory in which it made a change.
  static std::vector<MemoryLife>::const_iterator life_of(const ChangeEvent& event,
                                                         const std::vector<MemoryLife>& lives) {
    if (lives.front().session == 0)
      return std::ranges::find(lives, event.version / numbers_per_life + 1,
                               &MemoryLife::incarnation);
    auto later = std::ranges::upper_bound(lives, event.sequence, {}, &MemoryLife::first_sequence);
    return later == lives.begin() ? lives.end() : std::prev(later);
  }

  /// Nobody was told of a change that is not in the journal, but for those that `batched` may lose.
  void check_journals() {
    for (auto& [name, lives] : machines_->memories()) {
      if (lives.front().session == 0)
        continue;
      JournalContents journal{machines_->disk_of(lives.front().process).records(name)};
      for (auto& told : world_->told)
        for (std::size_t i = 0; i < told->events.size(); ++i) {
          auto& event = *told->events[i];
          if (event.address.subarchitecture != name)
            continue;
          if (journal.has(event)) {
            ++journaled_;
            continue;
          }
          auto& life = *life_of(event, lives);
          auto why = why_not_to_be_lost(event, told->times[i], life, journal);
          if (why.empty()) {
            ++lost_;
            at_bound_ += number_among_lost(event, life, journal) == life.journal.most_unsynced;
          } else {
            world_->find(told->component + " was told of " + to_string(event) + ", number " +
                         std::to_string(event.sequence) + ", which is not in the journal" + why);
          }
        }
    }
  }

  /// The last change in the journal of the life of a working memory.
  static std::uint64_t last_journaled(const MemoryLife& life, const JournalContents& journal) {
    return journal.last_of(life.session).value_or(life.first_sequence - 1);
  }

  /// 1 is the first change that the journal lacks.
  static std::uint64_t number_among_lost(const ChangeEvent& event, const MemoryLife& life,
                                         const JournalContents& journal) {
    return event.sequence - last_journaled(life, journal);
  }

  /// Why a change that somebody was told of by then cannot be missing in the journal; empty if it
  /// can.
  static std::string why_not_to_be_lost(const ChangeEvent& event, Timestamp told,
                                        const MemoryLife& life, const JournalContents& journal) {
    if (life.journal.mode == JournalMode::full)
      return " though it is a full one";
    if (life.alive())
      return ", of a working memory that has not ended";
    if (event.sequence < last_journaled(life, journal))
      return ", which has later ones";
    if (auto number = number_among_lost(event, life, journal); number > life.journal.most_unsynced)
      return ", nor are the " + std::to_string(number - 1) + " before it, of which only " +
             std::to_string(life.journal.most_unsynced) + " may be lost";
    auto age = life.end_time - told;
    if (life.is_written_in_time && age > life.journal.delay + most_journal_latency)
      return ", " + std::to_string(age.count() / 1000) + " ms before the working memory ended";
    return {};
  }

  /// The last word of everybody who ever failed is that it is back.
  void check_health() {
    TypeQuery all;
    all.subarchitecture = health_subarchitecture;
    auto& memory = machines_->memories().at(health_subarchitecture).back();
    auto entries = ask<Outcome<std::vector<EntryPtr>>>(memory.actor, QueryRequest{all, {}});
    if (!entries)
      return world_->find("nothing is known of the system's health");
    for (auto& entry : *entries) {
      auto up = entry->value.as<ComponentUp>();
      if (entry->address.id == sentinel)
        continue;
      if (!up)
        world_->find("at the end " + entry->address.id + " is not said to be back");
      else if (auto i = world_->components.find(up->component);
               i != world_->components.end() &&
               i->second->record().identity().incarnation != up->incarnation)
        world_->find(up->component + " is said to be back in another life than it lives");
    }
  }

  /// How an entry stands in a working memory that begins with what its journal has.
  static linearizability::Result begin_of(const StoreImage& image, const std::string& id,
                                          linearizability::Token token) {
    for (auto& x : image.entries)
      if (x.entry->address.id == id)
        return {Status::ok, x.entry->version, linearizability::content_of(*x.entry), token};
    for (auto& [deleted, version] : image.deleted)
      if (deleted == id)
        return {Status::does_not_exist, version, 0, token};
    return {Status::never_existed, image.floor, 0, token};
  }

  /// What working memories held when they ended is gone, or as much of it as their journals lack.
  void note_losses() {
    for (auto& [name, lives] : machines_->memories())
      for (std::size_t i = 1; i < lives.size(); ++i) {
        auto from = std::min(lives[i - 1].end, lives[i].begin);
        auto to = std::max(lives[i - 1].end, lives[i].begin);
        if (lives[i].session != 0 && !lives[i].may_lack_changes) {
          for (std::uint32_t entry = 0; entry < world_->entries.size(); ++entry)
            if (world_->entries[entry].address.subarchitecture == name)
              world_->recorder.leases_lost(entry, lives[i].session * numbers_per_incarnation, from,
                                           to);
          continue;
        }
        if (lives[i].session != 0) {
          for (std::uint32_t entry = 0; entry < world_->entries.size(); ++entry)
            if (auto& address = world_->entries[entry].address; address.subarchitecture == name)
              world_->recorder.lost(
                entry, from, to,
                begin_of(*lives[i].image, address.id, lives[i].session * numbers_per_incarnation));
          continue;
        }
        ++result_->losses;
        auto floor = (lives[i].incarnation - 1) * numbers_per_life;
        for (std::uint32_t entry = 0; entry < world_->entries.size(); ++entry)
          if (world_->entries[entry].address.subarchitecture == name)
            world_->recorder.lost(
              entry, from, to, {.status = Status::never_existed, .version = floor, .token = floor});
      }
  }

  void count(SystemResult& result) const {
    auto& happened = result.happened;
    happened.add("machines", std::to_string(machines_->count()));
    for (auto& x : result.faults.statements)
      happened.add("faults", std::string{kind_of(x.faults.front())});
    happened.add("outages", "component down", result.failures);
    happened.add("outages", "component back", result.returns);
    happened.add("outages", "working memory lost its entries", result.losses);
    for (auto& [name, lives] : machines_->memories())
      for (auto& x : lives)
        if (x.session != 0) {
          happened.add("journals", x.session == 1 ? "opened" : "opened again");
          happened.add("journals", "entry recovered", x.image->entries.size());
        }
    happened.add("journals", "change that was told found in the journal", journaled_);
    happened.add("journals", "change that was told lost, as it may be", lost_);
    happened.add("journals", "as many changes lost as may be", at_bound_);
    happened.add(world_->tasks.happened());
    happened.add(world_->calls.happened);
    for (auto& x : result.history) {
      using enum OperationKind;
      if (x.kind == lapse || x.kind == loss)
        continue;
      ++result.operations;
      happened.add("operations", to_string(x.kind) + ' ' +
                                   (x.pending() ? "not answered" : to_string(x.result.status)));
    }
  }

  WorkingMemoryActor owner_of(const SystemWorld::SimulatedEntry& x) const {
    return machines_->memories().at(x.address.subarchitecture).back().actor;
  }

  template <class Reply, class Request>
  Reply ask(const WorkingMemoryActor& to, const Request& request) {
    auto result = answer_of<Reply>(to, request);
    if (!result)
      throw std::runtime_error{"a working memory does not answer"};
    return *std::move(result);
  }

  void clear() {
    world_->over = true;
    machines_->end();
    for (auto* x : {&supervisor_, &agent_, &end_listener_, &phase_controller_})
      caf::anon_send_exit(std::exchange(*x, nullptr), caf::exit_reason::kill);
    scheduler.run();
    if (processes_)
      processes_->mesh()->close();
    scheduler.run();
    scheduler.clock().cancel_all();
    scheduler.run();
    processes_.reset();
    down_.clear();
    ended_.reset();
    started_ = false;
    journaled_ = 0;
    lost_ = 0;
    at_bound_ = 0;
  }

  linearizability::Checker checker_{{.max_states = 1'000'000}};

  // -- of one seed
  SystemWorld* world_ = nullptr;
  SystemResult* result_ = nullptr;
  SimulatedMachines* machines_ = nullptr;
  caf::actor_clock::time_point begin_;
  std::chrono::milliseconds lease_{0};
  ArchitectureDescription architecture_;
  SystemOptions options_;
  std::optional<Processes> processes_;
  caf::actor end_listener_;
  caf::actor supervisor_;
  caf::actor agent_;
  caf::actor phase_controller_;
  bool started_ = false;
  std::optional<std::string> ended_;
  std::multimap<Timestamp, faults::Fault> due_;
  /// Changes that somebody was told of.
  std::uint64_t journaled_ = 0;
  std::uint64_t lost_ = 0;
  /// Of the lost ones, those after which another would have been one too many.
  std::uint64_t at_bound_ = 0;
  /// Since when.
  std::map<std::string, Timestamp> down_;
};

SystemSimulation::SystemSimulation() : stage_(std::make_unique<Stage>()) {}
SystemSimulation::~SystemSimulation() = default;

SystemResult SystemSimulation::run(std::uint64_t seed,
                                   const std::optional<faults::FaultPlan>& faults) {
  return stage_->run(seed, faults ? *faults : system_faults(seed));
}

faults::FaultPlan minimised(SystemSimulation& simulation, std::uint64_t seed,
                            const faults::FaultPlan& faults) {
  auto result = faults;
  result.statements = castor::faults::minimise<castor::faults::Statement>(
    faults.statements, [&](const std::vector<castor::faults::Statement>& some) {
      auto fewer = faults;
      fewer.statements = some;
      return simulation.run(seed, fewer).is_wrong();
    });
  return result;
}

} // namespace castor::simulation
