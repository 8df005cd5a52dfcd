#include "castor/tools/simulation/memory_simulation.hpp"

#include "castor/tools/chaos/change_check.hpp"
#include "castor/tools/simulation/simulated_client.hpp"
#include "castor/tools/simulation/testing_system.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace castor::linearizability {

namespace {

constexpr std::chrono::milliseconds lease_duration{100};
/// Longer than any lease or wait.
constexpr std::chrono::seconds long_time{10};
/// Far more than a history takes.
constexpr std::size_t most_steps = 100'000;

using Told = std::vector<ChangeEventPtr>;

caf::behavior listener(caf::event_based_actor*, Told* told) {
  return {
    [told](const ChangeNotice& x) { told->push_back(x.event); },
    [told](const ChangeNotices& x) {
      for (auto& notice : x.notices)
        told->push_back(notice.event);
    },
    [](const Outcome<Acknowledged>&) {},
  };
}

bool writes(const OperationRecord& x) {
  return x.kind == OperationKind::add || x.kind == OperationKind::overwrite ||
         x.kind == OperationKind::remove;
}

bool obtained_lease(const OperationRecord& x) {
  return (x.kind == OperationKind::lock || x.kind == OperationKind::try_lock) && !x.pending() &&
         x.result.status == Status::ok;
}

Operation operation_of(OperationKind x) {
  return x == OperationKind::add         ? Operation::add
         : x == OperationKind::overwrite ? Operation::overwrite
                                         : Operation::remove;
}

} // namespace

/// The actor system, which outlasts a seed, and what plays on it.
class Simulation::Stage : private simulation::TestingSystem {
public:
  SimulationResult run(std::uint64_t seed) {
    SimulatedWorld world{seed, lease_duration};
    world_ = &world;
    begin_ = scheduler.clock().now();
    SimulationResult result;
    try {
      set_up();
      play();
      if (world.findings.empty())
        look_back();
    } catch (const std::runtime_error& error) {
      world.find(error.what());
    }
    result.history = world.recorder.finish();
    if (world.findings.empty())
      check_tokens(result.history);
    for (auto& x : world.recorder.lock_order().violations())
      world.find(x);
    result.verdict = checker_.check(result.history);
    clear();
    result.findings = std::move(world.findings);
    return result;
  }

private:
  // -- setting up

  void set_up() {
    auto& world = *world_;
    world.recorder.set_time(Timestamp{0});
    auto working_memories = 2 + world.pick(2);
    if (world.chance(60))
      world.overtaking = std::chrono::milliseconds{1 + world.pick(60)};
    world.recorder.set_overtaking(world.overtaking);
    Peers peers;
    for (std::size_t i = 0; i < working_memories; ++i) {
      WorkingMemoryOptions options;
      options.subarchitecture = std::string(1, char('a' + i));
      options.writers = {"*"};
      options.epoch = begin_;
      options.leases.duration = lease_duration;
      options.leases.overtaking = world.overtaking;
      // No token of one working memory is ever the right one in another by chance.
      options.leases.first_token = static_cast<LeaseToken>(i + 1) * 1'000'000;
      auto entries = options.store.entries = std::make_shared<EntryTable>();
      auto name = options.subarchitecture;
      auto actor = system.spawn(working_memory, std::move(options));
      peers.working_memories[name] = caf::actor_cast<caf::strong_actor_ptr>(actor);
      world.working_memories.push_back({name, std::move(actor), std::move(entries)});
    }
    for (auto& wm : world.working_memories)
      caf::anon_send(wm.actor, peers);
    scheduler.run();
    told_.assign(working_memories, {});
    for (std::size_t i = 0; i < working_memories; ++i) {
      listeners_.push_back(system.spawn(listener, &told_[i]));
      caf::send_as(listeners_.back(), world.working_memories[i].actor,
                   Subscribe{1, any_change().anywhere()});
    }
    scheduler.run();
    for (std::size_t entries = 1 + world.pick(4), i = 0; i < entries; ++i) {
      auto owner = world.pick(working_memories);
      world.entries.push_back(
        {{world.working_memories[owner].subarchitecture, std::string(1, char('w' + i))}, owner});
    }
    world.operations_left = 30 + world.pick(110);
    for (std::size_t clients = 4 + world.pick(5), i = 0; i < clients; ++i) {
      SimulatedClientParts parts;
      parts.world = world_;
      parts.component = "c" + std::to_string(i);
      parts.home = world.pick(working_memories);
      parts.traits = {world.chance(25), world.chance(40), world.chance(50), world.chance(40),
                      world.chance(30)};
      SimulatedClient::spawn(system, std::move(parts));
    }
  }

  // -- playing

  void play() {
    auto& world = *world_;
    auto& jobs = scheduler.jobs;
    auto hurry = 1 + world.pick(5);
    for (std::size_t steps = 0; steps < most_steps; ++steps) {
      if (jobs.empty()) {
        check_ended_clients();
        if (!let_time_pass_until_something_happens())
          return;
      }
      if (world.chance(unsigned(hurry)))
        let_time_pass(std::chrono::milliseconds{1 + world.pick(60)});
      if (!jobs.empty())
        run_one(world.pick(jobs.size()));
    }
    world.find("it does not come to rest");
  }

  /// Every working memory has heard of every death by now.
  void check_ended_clients() {
    auto& world = *world_;
    if (world.dead.empty())
      return;
    world.recorder.deaths_are_known();
    for (auto& entry : world.entries) {
      auto status =
        ask<Outcome<LockStatus>>(world.working_memories[entry.owner], LockQuery{entry.address});
      if (status && std::ranges::count(world.dead, status->holder) > 0)
        world.find(to_string(*status->holder) + " has ended and holds a lease of " +
                   to_string(entry.address));
    }
    world.dead.clear();
  }

  void let_time_pass(std::chrono::microseconds x) {
    scheduler.advance_time(x);
    world_->recorder.set_time(
      std::chrono::duration_cast<Timestamp>(scheduler.clock().now() - begin_));
  }

  /// False if nothing will.
  bool let_time_pass_until_something_happens() {
    auto& clock = scheduler.clock();
    while (scheduler.jobs.empty() && clock.has_pending_timeout()) {
      auto due = clock.schedule().begin()->first - clock.now();
      let_time_pass(
        std::max(std::chrono::microseconds{0}, std::chrono::ceil<std::chrono::microseconds>(due)));
    }
    return !scheduler.jobs.empty();
  }

  // -- looking back

  /// Everything is at rest, and nothing is leased any more.
  void look_back() {
    auto& world = *world_;
    for (auto& client : world.alive)
      SimulatedClient::let_rest(client);
    scheduler.run();
    let_time_pass(long_time);
    scheduler.run();
    for (std::uint32_t entry = 0; entry < world.entries.size(); ++entry)
      look_at(entry);
    for (std::size_t i = 0; i < world.working_memories.size(); ++i)
      check_changes(i, check_status(world.working_memories[i]));
  }

  /// What is left of an entry goes into the history too.
  void look_at(std::uint32_t entry) {
    auto& world = *world_;
    auto& address = world.entries[entry].address;
    auto& wm = world.working_memories[world.entries[entry].owner];
    OperationRecord x;
    x.entry = entry;
    x.kind = OperationKind::read;
    auto record = world.recorder.invoked(x);
    if (auto found = ask<Outcome<EntryPtr>>(wm, ReadRequest{address, {}}))
      world.recorder.returned(record, {Status::ok, (*found)->version, content_of(**found)});
    else
      world.recorder.returned(record, {Status::does_not_exist});
    x.kind = OperationKind::version;
    record = world.recorder.invoked(x);
    if (auto version = ask<Outcome<Version>>(wm, VersionQuery{address}))
      world.recorder.returned(record, {Status::ok, *version});
    else
      world.recorder.returned(record, {Status::never_existed});
  }

  /// The number of changes made there.
  std::uint64_t check_status(const SimulatedWorld::WorkingMemory& wm) {
    auto status = ask<WorkingMemoryStatus>(wm, StatusQuery{});
    if (status.leases != 0 || status.waiting != 0)
      world_->find("at the end " + wm.subarchitecture + " has " + std::to_string(status.leases) +
                   " leases, and " + std::to_string(status.waiting) + " operations wait there");
    return status.events;
  }

  void check_changes(std::size_t owner, std::uint64_t made) {
    auto& world = *world_;
    auto& name = world.working_memories[owner].subarchitecture;
    auto writes = observed_writes(owner);
    for (std::size_t i = 0; i < told_.size(); ++i) {
      Told of_owner;
      std::ranges::copy_if(told_[i], std::back_inserter(of_owner),
                           [&](auto& x) { return x->address.subarchitecture == name; });
      for (auto& fault : faults_of(of_owner, made, writes))
        world.find("changes in " + name + ", as told in " +
                   world.working_memories[i].subarchitecture + ": " + fault);
    }
  }

  std::vector<ObservedWrite> observed_writes(std::size_t owner) const {
    auto& world = *world_;
    std::vector<ObservedWrite> result;
    auto add = [&](Recorder::Index i, std::size_t batch) {
      auto& x = world.recorder[i];
      if (world.entries[x.entry].owner == owner && (x.pending() || x.result.status == Status::ok) &&
          world.recorder.happened(i))
        result.push_back({operation_of(x.kind), world.entries[x.entry].address,
                          world.identities[x.client]->component, x.result.version, x.invoked,
                          x.returned, batch});
    };
    std::vector<bool> in_batch(world.recorder.size(), false);
    for (std::size_t batch = 0; batch < world.batches.size(); ++batch)
      for (auto i : world.batches[batch]) {
        in_batch[i] = true;
        add(i, batch + 1);
      }
    for (Recorder::Index i = 0; i < world.recorder.size(); ++i)
      if (!in_batch[i] && linearizability::writes(world.recorder[i]))
        add(i, 0);
    return result;
  }

  /// Of two leases of one working memory, whichever entries they are of, that came later which was
  /// asked for after the other was had: its token is higher.
  void check_tokens(const History& history) {
    auto& world = *world_;
    struct Grant {
      Tick obtained;
      Token token;
    };
    for (std::size_t owner = 0; owner < world.working_memories.size(); ++owner) {
      std::map<Token, const OperationRecord*> first;
      std::vector<const OperationRecord*> grants;
      for (auto& x : history)
        if (obtained_lease(x) && world.entries[x.entry].owner == owner) {
          auto [i, is_new] = first.try_emplace(x.result.token, &x);
          if (i->second->client != x.client || i->second->entry != x.entry)
            world.find("two leases with one token: " + to_string(*i->second) + " and " +
                       to_string(x));
          if (is_new)
            grants.push_back(&x);
        }
      std::ranges::sort(grants, {}, [](auto* x) { return x->result.token; });
      const OperationRecord* latest = nullptr;
      for (auto* x : grants) {
        if (latest && x->returned < latest->invoked)
          world.find("tokens do not rise: " + to_string(*x) + " came before " + to_string(*latest));
        if (!latest || x->invoked > latest->invoked)
          latest = x;
      }
    }
  }

  template <class Reply, class Request>
  Reply ask(const SimulatedWorld::WorkingMemory& wm, const Request& request) {
    auto result = answer_of<Reply>(wm.actor, request);
    if (!result)
      throw std::runtime_error{"the working memory of " + wm.subarchitecture + " has ended"};
    return *std::move(result);
  }

  void clear() {
    for (auto& x : world_->alive)
      caf::anon_send_exit(x, caf::exit_reason::kill);
    for (auto& x : listeners_)
      caf::anon_send_exit(x, caf::exit_reason::kill);
    for (auto& x : world_->working_memories)
      caf::anon_send_exit(x.actor, caf::exit_reason::kill);
    scheduler.run();
    scheduler.clock().cancel_all();
    listeners_.clear();
    world_ = nullptr;
  }

  Checker checker_{{.max_states = 4'000'000}};

  // -- of one seed
  SimulatedWorld* world_ = nullptr;
  caf::actor_clock::time_point begin_;
  std::vector<caf::actor> listeners_;
  /// By working memory: what a component there is told.
  std::vector<Told> told_;
};

Simulation::Simulation() : stage_(std::make_unique<Stage>()) {}
Simulation::~Simulation() = default;

SimulationResult Simulation::run(std::uint64_t seed) {
  return stage_->run(seed);
}

std::string to_string(const SimulationResult& x) {
  std::string result;
  for (auto& finding : x.findings)
    result += finding + '\n';
  return result + x.verdict.report;
}

} // namespace castor::linearizability
