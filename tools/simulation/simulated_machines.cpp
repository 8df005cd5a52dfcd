#include "castor/tools/simulation/simulated_machines.hpp"

#include "castor/actors/runtime/shell.hpp"
#include "castor/base/log.hpp"

#include <algorithm>
#include <optional>
#include <variant>

namespace castor::simulation {

namespace {

using namespace std::chrono_literals;

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};

void kill_actor(const caf::actor& x) {
  caf::anon_send_exit(x, caf::exit_reason::kill);
}

} // namespace

SimulatedMachines::SimulatedMachines(caf::actor_system& system, SystemWorld& world,
                                     std::size_t count)
  : system_(system), world_(world), count_(count), network_(system, world.random) {
  for (Machine x = 0; x < machine_names.size(); ++x) {
    processes_[x].life = x;
    machine_of_life_.push_back(x);
  }
  processes_[0].there = true;
  // As the coordinator says when it has lost the other process.
  network_.set_on_close([this](const caf::actor& link) {
    auto peer = peers_.find(link);
    auto known = std::ranges::find(links_, link, &Link::actor);
    if (peer != peers_.end() && known != links_.end())
      give_up(known->life, peer->second);
  });
}

LinkOptions SimulatedMachines::link_options() {
  LinkOptions result;
  result.heartbeat = 300ms;
  result.silence = 700ms;
  result.connecting = 300ms;
  result.patience = link_patience;
  // Even the small values of entries are kept for the next reader, and only a few of them.
  result.session.shared_content = 1;
  result.session.kept_contents = 2000;
  return result;
}

Endpoint SimulatedMachines::endpoint_of(Machine x) {
  return {std::string{machine_names[x]}, static_cast<std::uint16_t>(7000 + x)};
}

SimulatedMachines::Machine SimulatedMachines::machine(std::string_view name) const {
  return Machine(std::ranges::find(machine_names, name) - machine_names.begin());
}

SimulatedMachines::Machine SimulatedMachines::machine_of(Life x) const {
  return machine_of_life_[x];
}

// -- what there is

void SimulatedMachines::own(const caf::actor& x, Life life, const std::string& what) {
  world_.expect_no_exception(x, what);
  auto* job = job_of(x);
  world_.owners[job] = life;
  caf::actor_cast<caf::abstract_actor*>(x)->attach_functor([this, job] {
    if (!world_.over)
      world_.owners.erase(job);
  });
}

PartSpawn SimulatedMachines::spawn(Machine x) {
  PartSpawn result;
  result.working_memory = [this, life = processes_[x].life](caf::actor_system&,
                                                            WorkingMemoryOptions options) {
    return spawn_working_memory(std::move(options), life);
  };
  result.component = [this, life = processes_[x].life](caf::actor_system&, ShellParts parts) {
    return spawn_component(parts, life);
  };
  result.journal = [this, x](const JournalOptions& options, const std::string& subarchitecture) {
    auto time = std::chrono::duration_cast<UnixTime>(now().time_since_epoch());
    return disks_[x].open(subarchitecture, options, time);
  };
  // None of them has a thread.
  result.why_no_threads = nullptr;
  return result;
}

caf::actor SimulatedMachines::spawn_journal_writer(Life life) {
  auto result = system_.spawn(simulated_journal_writer);
  own(result, life, "a journal's writer");
  journal_writers_.emplace_back(result, life);
  return result;
}

WorkingMemoryActor SimulatedMachines::spawn_working_memory(WorkingMemoryOptions options,
                                                           Life life) {
  auto& lives = memories_[options.subarchitecture];
  auto number = lives.size();
  MemoryLife x;
  x.incarnation = options.incarnation;
  x.process = life;
  x.begin = world_.recorder.tick();
  std::shared_ptr<JournalWriterParts> writer;
  if (auto journal = options.opened_journal) {
    x.session = journal->session;
    x.first_sequence = journal->image.sequence + 1;
    x.image = std::make_shared<const StoreImage>(journal->image);
    x.may_lack_changes = !lives.empty() && journal->incarnation > lives.back().journal_incarnation;
    x.journal_incarnation = journal->incarnation;
    options.journal.report = [](const std::string&) {};
    // Few enough for runs to reach the bound.
    if (options.journal.mode == JournalMode::batched && world_.chance(50))
      options.journal.most_unsynced = 1 + world_.pick(4);
    x.journal = options.journal;
    options.journal_writer = spawn_journal_writer(life);
    writer = std::make_shared<JournalWriterParts>(
      journal_writer_parts(options.journal, journal->file, nullptr));
  }
  auto journal_writer = options.journal_writer;
  auto name = working_memory_of(options.subarchitecture);
  x.actor = system_.spawn(working_memory, std::move(options));
  if (writer) {
    writer->owner = caf::actor_cast<caf::strong_actor_ptr>(x.actor);
    caf::anon_send(journal_writer, BeginJournal{writer});
  }
  own(caf::actor_cast<caf::actor>(x.actor), life, name);
  caf::actor_cast<caf::abstract_actor*>(x.actor)->attach_functor([this, &lives, number] {
    if (world_.over)
      return;
    lives[number].end = world_.recorder.tick();
    lives[number].end_time = world_.recorder.now();
    lives[number].actor = nullptr;
  });
  world_.note(x.incarnation);
  lives.push_back(x);
  return x.actor;
}

caf::actor SimulatedMachines::spawn_component(const ShellParts& parts, Life life) {
  auto& identity = parts.record->identity();
  linearizability::SimulatedClientParts client;
  client.world = &world_;
  client.component = identity.name;
  client.incarnation = identity.incarnation;
  auto home = std::ranges::find(world_.working_memories, identity.subarchitecture,
                                &SystemWorld::WorkingMemory::subarchitecture);
  client.home = std::size_t(home - world_.working_memories.begin());
  client.traits = {false, world_.chance(40), false, world_.chance(30), false};
  auto operates = !identity.name.ends_with("_tm");
  auto result =
    system_.spawn<SimulatedComponent>(world_, std::move(client), parts.record, operates, life);
  world_.expect_no_exception(result, identity.name);
  return result;
}

LinkSpawn SimulatedMachines::spawn_link(Machine x) {
  return [this, x, life = processes_[x].life](LinkParts parts) {
    auto peer = parts.peer == 0 ? std::string{machine_names[0]} : parts.peer_name;
    if (x == 0)
      parts.self.node = machine_names[0];
    // Known only once it is made, which is before it has any news.
    auto link = std::make_shared<caf::actor_addr>();
    parts.on_news = [this, life, link, then = std::move(parts.on_news)](const LinkNews& news) {
      hear(life, caf::actor_cast<caf::actor>(*link), news);
      then(news);
    };
    auto result = network_.spawn_link(life, std::move(parts));
    *link = result.address();
    own(result, life, "a link of " + std::string{machine_names[x]} + " to " + peer);
    links_.push_back({result, life, peer});
    for (auto& silence : silences_)
      if (auto other = machine(peer);
          silence.until > now() &&
          ((silence.a == x && silence.b == other) || (silence.a == other && silence.b == x)))
        caf::anon_send(result, LinkFault{LinkFault::Kind::silence,
                                         std::chrono::ceil<Timestamp>(silence.until - now())});
    return result;
  };
}

void SimulatedMachines::hear(Life life, const caf::actor& link, const LinkNews& news) {
  world_.note(std::uint64_t(news.state) << 32 | life << 16 | news.peer);
  if (log_level() <= LogLevel::debug)
    log(LogLevel::debug, "process " + std::to_string(life),
        "at " + std::to_string(world_.recorder.now().count() / 1000) + " ms: its link to number " +
          std::to_string(news.peer) +
          (news.state == LinkState::up     ? " is up"
           : news.state == LinkState::down ? " is down: " + news.reason
                                           : " is lost: " + news.reason));
  if (news.state == LinkState::up)
    if (auto peer = network_.peer_of(link))
      peers_[link] = *peer;
  if (auto peer = peers_.find(link); news.state == LinkState::lost && peer != peers_.end())
    give_up(life, peer->second);
}

void SimulatedMachines::give_up(Life life, Life other) {
  lost_.emplace(life, other);
  for (auto& [name, component] : world_.components)
    if (component->process() == other)
      world_.recorder.may_be_lost(component->number());
}

// -- processes

void SimulatedMachines::start_node(Machine x) {
  auto& process = processes_[x];
  process.there = true;
  MembershipParts parts;
  parts.name = machine_names[x];
  parts.link = link_options();
  parts.spawn_link = spawn_link(x);
  parts.spawn = spawn(x);
  process.node = std::make_shared<Memberships>(system_, std::move(parts));
  process.listener = network_.listen(
    endpoint_of(x).port, process.life,
    [node = std::weak_ptr{process.node}](const Hello& hello) -> std::variant<caf::actor, Refusal> {
      if (auto self = node.lock())
        return self->route(hello);
      return Refusal{"it ends", false};
    });
  own(process.listener, process.life, "the listener of " + std::string{machine_names[x]});
}

void SimulatedMachines::kill(Machine x, std::chrono::milliseconds back_after) {
  auto& process = processes_[x];
  if (!process.there)
    return;
  process.there = false;
  frozen_.erase(process.life);
  // Nobody hears a word from now on.
  network_.end(process.life, world_.chance(30));
  kill_actor(std::exchange(process.listener, nullptr));
  for (auto& link : links_)
    if (link.life == process.life)
      kill_actor(link.actor);
  std::erase_if(links_, [&](auto& link) { return link.life == process.life; });
  for (auto& [writer, life] : journal_writers_)
    if (life == process.life)
      kill_actor(writer);
  for (auto& [name, lives] : memories_)
    if (!lives.empty() && lives.back().process == process.life && lives.back().alive())
      kill_actor(caf::actor_cast<caf::actor>(lives.back().actor));
  for (auto& [name, component] : world_.components)
    if (component->process() == process.life)
      kill_actor(caf::actor_cast<caf::actor>(component));
  world_.run_jobs_of(process.life);
  process.node->end();
  process.node = nullptr;
  process.life = ++last_life_;
  machine_of_life_.push_back(x);
  returns_[x] = now() + back_after;
}

void SimulatedMachines::catch_up() {
  auto time = now();
  std::erase_if(frozen_, [&](auto& x) { return x.second <= time; });
  std::erase_if(hanging_, [&](auto& x) { return x.second <= time; });
  if (returns_.empty())
    return;
  std::vector<Machine> back;
  for (auto& [x, at] : returns_)
    if (at <= time)
      back.push_back(x);
  for (auto x : back) {
    returns_.erase(x);
    start_node(x);
  }
}

void SimulatedMachines::heal() {
  frozen_.clear();
  hanging_.clear();
  for (auto& [x, at] : returns_)
    at = now();
  catch_up();
}

SimulatedMachines::Clock::time_point SimulatedMachines::next_event() const {
  auto result = Clock::time_point::max();
  for (auto& [x, at] : returns_)
    result = std::min(result, at);
  for (auto& [x, at] : frozen_)
    result = std::min(result, at);
  for (auto& [x, at] : hanging_)
    result = std::min(result, at);
  return result;
}

bool SimulatedMachines::may_run(const caf::resumable* x) const {
  if (hanging_.count(x) > 0)
    return false;
  auto owner = world_.owners.find(x);
  return owner == world_.owners.end() || frozen_.count(owner->second) == 0;
}

void SimulatedMachines::end() {
  for (auto& link : links_)
    kill_actor(link.actor);
  for (auto& [name, lives] : memories_)
    for (auto& life : lives)
      if (life.alive())
        kill_actor(caf::actor_cast<caf::actor>(life.actor));
  for (auto& [name, component] : world_.components)
    kill_actor(caf::actor_cast<caf::actor>(component));
  for (auto& [writer, life] : journal_writers_)
    kill_actor(writer);
  for (auto& process : processes_) {
    if (process.listener)
      kill_actor(process.listener);
    if (process.node)
      process.node->end();
  }
}

// -- injected faults

void SimulatedMachines::inject(const faults::Fault& fault, std::uint64_t seed) {
  processes_affected_ = processes_affected_ || !std::holds_alternative<faults::Crash>(fault);
  std::visit(
    Overloaded{
      [&](const faults::Crash& x) { crash(x.component.name); },
      [&](const faults::Hang& x) { hang(x); },
      [&](const faults::Kill& x) {
        kill(machine(x.process.name), time_until_return(seed, world_.recorder.now()));
      },
      [&](const faults::Stop& x) { stop(machine(x.process.name), *x.duration); },
      [&](const faults::Partition& x) {
        auto from = machine(x.group.front());
        for (Machine other = 0; other < count_; ++other)
          if (other != from)
            silence(from, other, *x.duration);
      },
      [&](const faults::Delay& x) {
        inject_into_link(x.link, {LinkFault::Kind::delay, *x.duration, x.by});
      },
      [&](const faults::Drop& x) {
        inject_into_link(x.link, {LinkFault::Kind::loss, *x.duration, {}, 10 * x.part.thousandths});
      },
      [&](const faults::FailJournal& x) {
        if (auto actor = memory(x.memory.subarchitecture))
          caf::anon_send(actor, JournalFault{JournalFault::Kind::failure, *x.duration, {}});
      },
      [&](const faults::SlowJournal& x) { slow_journal(x); },
      [&](const faults::JumpClock& x) { jump_clock(x); },
      [](const auto&) {},
    },
    fault);
}

void SimulatedMachines::crash(const std::string& name) {
  if (auto i = world_.components.find(name); i != world_.components.end()) {
    caf::anon_send(caf::actor_cast<caf::actor>(i->second), ComponentFault{});
    return;
  }
  for (auto& [subarchitecture, lives] : memories_)
    if (working_memory_of(subarchitecture) == name && lives.back().alive())
      caf::actor_cast<caf::abstract_actor*>(lives.back().actor)
        ->enqueue(nullptr, caf::make_message_id(),
                  caf::make_message(
                    caf::exit_msg{{}, caf::make_error(caf::sec::runtime_error, "injected crash")}),
                  nullptr);
}

WorkingMemoryActor SimulatedMachines::memory(const std::string& subarchitecture) const {
  auto i = memories_.find(subarchitecture);
  return i == memories_.end() ? WorkingMemoryActor{} : i->second.back().actor;
}

void SimulatedMachines::slow_journal(const faults::SlowJournal& x) {
  auto actor = memory(x.memory.subarchitecture);
  if (!actor)
    return;
  memories_.at(x.memory.subarchitecture).back().is_written_in_time = false;
  caf::anon_send(actor, JournalFault{JournalFault::Kind::slowness, *x.duration, x.by});
}

void SimulatedMachines::stop(Machine x, Clock::duration duration) {
  auto& process = processes_[x];
  if (!process.there)
    return;
  frozen_[process.life] = now() + duration;
  for (auto& [name, lives] : memories_)
    for (auto& life : lives)
      if (life.process == process.life)
        life.is_written_in_time = false;
}

void SimulatedMachines::jump_clock(const faults::JumpClock& x) {
  auto actor = memory(x.memory.subarchitecture);
  if (!actor)
    return;
  for (std::uint32_t entry = 0; entry < world_.entries.size(); ++entry)
    if (world_.entries[entry].address.subarchitecture == x.memory.subarchitecture)
      world_.recorder.clock_jumped(entry, x.by);
  if (x.by.count() < 0)
    world_.clocks_behind -= x.by;
  caf::anon_send(actor, JumpClock{x.by});
}

void SimulatedMachines::hang(const faults::Hang& x) {
  if (auto i = world_.components.find(x.component.name); i != world_.components.end())
    hanging_[i->second] = now() + *x.duration;
}

void SimulatedMachines::silence(Machine a, Machine b, Clock::duration x) {
  silences_.push_back({a, b, now() + x});
  inject_into_link(a, b, {LinkFault::Kind::silence, std::chrono::ceil<Timestamp>(x)});
}

void SimulatedMachines::inject_into_link(Machine a, Machine b, const LinkFault& x) {
  for (auto& link : links_) {
    auto here = machine_of(link.life);
    auto there = machine(link.peer);
    if ((here == a && there == b) || (here == b && there == a))
      caf::anon_send(link.actor, x);
  }
}

void SimulatedMachines::inject_into_link(const faults::LinkTarget& link, const LinkFault& x) {
  inject_into_link(machine(link.first), machine(link.second), x);
}

} // namespace castor::simulation
