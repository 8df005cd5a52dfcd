#include "castor/actors/node/system.hpp"

#include "castor/actors/component/keeper.hpp"
#include "castor/actors/component/shell.hpp"
#include "castor/actors/node/check.hpp"
#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/plugin.hpp"
#include "castor/wm/working_memory.hpp"

#include <caf/atom.hpp>
#include <caf/scoped_actor.hpp>

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

CASTOR_LOCAL_MESSAGE(castor::TaskEvent)

namespace castor {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// How often the main thread looks up from waiting.
constexpr auto glance = 50ms;

/// A component that was busy for longer than this when looked at keeps a system from being quiet;
/// one that merely polls does not.
constexpr auto polling = 200ms;

using FlushAtom = caf::atom_constant<caf::atom("flush")>;

struct ActorSystemConfig : caf::actor_system_config {
  ActorSystemConfig() {
    // The default policy polls with sleeps, which costs several times the latency.
    set("scheduler.policy", caf::atom("sharing"));
    set("scheduler.max-threads", std::max<std::size_t>(2, std::thread::hardware_concurrency()));
  }
};

/// The level at which changes in a subarchitecture are logged, where they are.
using LoggedChanges = std::map<std::string, LogLevel>;

void observe_change(const SystemOptions& options, const LoggedChanges& logged,
                    const ChangeEvent& event) {
  if (options.on_change)
    options.on_change(event);
  auto& where = event.address.subarchitecture;
  if (auto i = logged.find(where); i != logged.end())
    log(i->second, where + '.' + where + "_wm", to_string(event));
}

using WorkingMemories = std::map<std::string, WorkingMemoryActor>;

caf::behavior observer(caf::event_based_actor* self, const SystemOptions& options,
                       const LoggedChanges& logged, const WorkingMemories& working_memories) {
  auto receipts = std::make_shared<std::map<std::string, EventReceipts>>();
  auto observe = [self, &options, &logged, working_memories, receipts](const ChangeEvent& event) {
    observe_change(options, logged, event);
    auto& where = event.address.subarchitecture;
    if (auto count = (*receipts)[where].take())
      self->send(working_memories.at(where), EventsTaken{EventStream::component, count});
  };
  return {
    [observe](const ChangeNotice& x) { observe(*x.event); },
    [observe](const ChangeNotices& x) {
      for (auto& notice : x.notices)
        observe(*notice.event);
    },
    [&options](const TaskEvent& x) { options.on_task(x); },
    [](const Outcome<Acknowledged>&) {},
    [](FlushAtom) { return true; },
  };
}

void note(LogLevel level, const std::string& what) {
  if (level >= log_level())
    log(level, "castor", what);
}

} // namespace

SystemError::SystemError(std::vector<cast::Diagnostic> diagnostics)
  : runtime_error(cast::render(diagnostics)), diagnostics_(std::move(diagnostics)) {}

class System::Implementation {
public:
  Implementation(ArchitectureDescription architecture, SystemOptions options)
    : architecture_(std::move(architecture)), options_(std::move(options)) {
    auto diagnostics = check_classes(architecture_);
    if (!diagnostics.empty())
      throw SystemError{std::move(diagnostics)};
    services_->epoch = Clock::now();
    services_->end_system = [this](int status, const std::string& reason) {
      std::lock_guard guard{mutex_};
      if (!ended_)
        ended_.emplace(status, reason);
      changed_.notify_all();
    };
    spawn_working_memories();
  }

  ~Implementation() {
    if (!stopped_)
      stop();
    // Components hold the services, and these hold components.
    services_->providers.clear();
    services_->by_subarchitecture.clear();
    for (auto& wm : working_memories_)
      caf::anon_send_exit(wm.actor, caf::exit_reason::user_shutdown);
    caf::anon_send_exit(observer_, caf::exit_reason::user_shutdown);
    caf::anon_send_exit(keeper_, caf::exit_reason::user_shutdown);
  }

  bool start() {
    observe();
    for (auto& subarchitecture : architecture_.subarchitectures) {
      auto& wm = working_memory_of(subarchitecture.name);
      auto manager = spawn(subarchitecture.task_manager, wm, {});
      if (!enter(Phase::configure, manager))
        return false;
      // Managed components first, then unmanaged ones.
      for (auto kind : {ComponentKind::managed, ComponentKind::unmanaged})
        for (auto& x : subarchitecture.components)
          if (x.kind == kind && !enter(Phase::configure, spawn(x, wm, running_[manager].actor)))
            return false;
    }
    auto first_standalone = running_.size();
    for (auto& x : architecture_.standalone) {
      auto index = spawn(x, {}, {});
      services_->providers[x.name] = running_[index].actor;
      if (!enter(Phase::configure, index))
        return false;
    }
    // What stands outside the subarchitectures starts first: the others will want to connect to it.
    std::rotate(running_.begin(), running_.begin() + static_cast<std::ptrdiff_t>(first_standalone),
                running_.end());
    start_keeper();
    for (std::size_t i = 0; i < running_.size(); ++i)
      if (!enter(Phase::start, i))
        return false;
    for (auto& x : running_)
      self_->send(x.actor, EnterPhase{Phase::run, caf::actor_cast<caf::actor>(self_)});
    return true;
  }

  EndReason wait(const Until& until) {
    auto begin = Clock::now();
    auto last_activity = begin;
    std::uint64_t last_events = 0;
    for (;;) {
      {
        std::unique_lock guard{mutex_};
        if (changed_.wait_for(guard, glance, [this] { return ended_.has_value(); }))
          return EndReason::ended_by_component;
      }
      auto now = Clock::now();
      if (interrupted())
        return EndReason::interrupted;
      if (until.at_most && now - begin >= *until.at_most)
        return EndReason::time_over;
      if (all_failed())
        return EndReason::all_failed;
      if (!until.quiet)
        continue;
      auto events = sum_of(&WorkingMemoryStatus::events);
      if (std::exchange(last_events, events) != events || somebody_is_busy(now))
        last_activity = now;
      if (now - last_activity >= *until.quiet)
        return EndReason::quiet;
    }
  }

  std::optional<std::pair<int, std::string>> ended() const {
    std::lock_guard guard{mutex_};
    return ended_;
  }

  void stop() {
    stopped_ = true;
    std::string order;
    for (auto i = running_.rbegin(); i != running_.rend(); ++i) {
      auto& name = i->record->identity().name;
      if (await_end(*i))
        order += (order.empty() ? "" : ", ") + name;
      else
        stuck_.push_back(name);
    }
    if (!order.empty())
      note(LogLevel::info, "stopped, in this order: " + order);
    for (auto& name : stuck_)
      log(LogLevel::error, "castor",
          name + " did not stop: it has not come back from its own code");
    if (observer_)
      flush_observer();
  }

  SystemSummary summary() {
    SystemSummary result;
    for (auto& wm : working_memories_) {
      self_->request(wm.actor, caf::infinite, StatusQuery{})
        .receive(
          [&](const WorkingMemoryStatus& x) {
            result.working_memories.push_back({x.subarchitecture, x.entries_by_type, x.events,
                                               x.matched, x.delivered, x.coalesced, x.suppressed,
                                               x.forwarded, x.refused});
          },
          [](const caf::error&) {});
    }
    for (auto& x : running_)
      result.components.push_back(x.record);
    result.stuck = stuck_;
    return result;
  }

  std::vector<EntryPtr> entries(const std::string& subarchitecture) {
    std::vector<EntryPtr> result;
    self_
      ->request(working_memory_of(subarchitecture), caf::infinite,
                QueryRequest{{subarchitecture, {}, 0, false}, {}})
      .receive(
        [&](const Outcome<std::vector<EntryPtr>>& x) {
          if (x)
            result = *x;
        },
        [](const caf::error&) {});
    return result;
  }

  const ArchitectureDescription& architecture() const { return architecture_; }
  Clock::time_point epoch() const { return services_->epoch; }

private:
  struct WorkingMemory {
    std::string subarchitecture;
    WorkingMemoryActor actor;
  };

  struct Running {
    caf::actor actor;
    std::shared_ptr<ComponentRecord> record;
    bool is_task_manager = false;
  };

  bool interrupted() const { return options_.interrupted && options_.interrupted(); }

  void spawn_working_memories() {
    Peers peers;
    for (auto& x : architecture_.subarchitectures) {
      WorkingMemoryClass wm_class;
      for (auto& setting : x.working_memory.options)
        wm_class.options.set(setting.name(), setting.value);
      WorkingMemoryOptions options;
      options.subarchitecture = x.name;
      options.ignored = {wm_class.ignore->begin(), wm_class.ignore->end()};
      options.epoch = services_->epoch;
      options.leases.duration = wm_class.lease.get();
      if (wm_class.log || wm_class.debug)
        logged_[x.name] = wm_class.debug ? LogLevel::trace : LogLevel::debug;
      options.store.largest_value = static_cast<std::size_t>(wm_class.largest_entry.get()) << 20;
      if (options_.open_access)
        options.writers.insert("*");
      for (auto& rule : architecture_.access_rules)
        if (rule.owner == x.name || rule.owner == "*")
          options.writers.insert(rule.writer);
      auto actor = system_.spawn(working_memory, std::move(options));
      working_memories_.push_back({x.name, actor});
      peers.working_memories[x.name] = caf::actor_cast<caf::strong_actor_ptr>(actor);
      services_->by_subarchitecture[x.name] = actor;
      services_->working_memories.push_back(
        dynamic_cast<caf::resumable*>(caf::actor_cast<caf::abstract_actor*>(actor)));
    }
    std::sort(services_->working_memories.begin(), services_->working_memories.end());
    for (auto& x : working_memories_)
      self_->request(x.actor, caf::infinite, peers)
        .receive([](Acknowledged) {}, [](const caf::error&) {});
  }

  const WorkingMemoryActor& working_memory_of(const std::string& subarchitecture) const {
    for (auto& x : working_memories_)
      if (x.subarchitecture == subarchitecture)
        return x.actor;
    throw std::out_of_range("no subarchitecture " + subarchitecture);
  }

  std::size_t spawn(const ComponentDescription& x, WorkingMemoryActor wm, caf::actor manager) {
    ShellParts parts;
    parts.component = find_class(x.class_name).found->make();
    for (auto& setting : x.options)
      parts.component->options().set(setting.name(), setting.value);
    parts.record = std::make_shared<ComponentRecord>(ComponentIdentity{
      x.name, x.subarchitecture, x.class_name, static_cast<std::uint32_t>(x.number)});
    parts.services = services_;
    parts.unit = services_->units.emplace_back(std::make_unique<CallerRuns>(system_)).get();
    parts.unit->set_working_memories(&services_->working_memories);
    parts.working_memory = std::move(wm);
    parts.task_manager = std::move(manager);
    auto record = parts.record;
    running_.push_back({system_.spawn<ComponentShell>(std::move(parts)), std::move(record),
                        x.kind == ComponentKind::task_manager});
    return running_.size() - 1;
  }

  /// Waits until the component has done what the phase asks of it; false if interrupted.
  bool enter(Phase phase, std::size_t index) {
    auto& x = running_[index];
    if (x.record->state() == ComponentState::failed)
      return true;
    self_->send(x.actor, EnterPhase{phase, caf::actor_cast<caf::actor>(self_)});
    bool done = false;
    auto next_report = Clock::now() + 5s;
    while (!done && x.record->state() != ComponentState::failed) {
      self_->receive([&](const PhaseDone& y) { done = y.component == x.record->identity().number; },
                     caf::after(glance) >> [] {});
      if (interrupted())
        return false;
      if (!done && Clock::now() >= next_report) {
        next_report += 5s;
        note(LogLevel::info, "waiting for " + x.record->identity().full_name() + " to " +
                               (phase == Phase::configure ? "configure" : "start"));
      }
    }
    return true;
  }

  void observe() {
    if (!options_.on_change && !options_.on_task && logged_.empty())
      return;
    observer_ = system_.spawn<caf::detached>(observer, std::cref(options_), std::cref(logged_),
                                             services_->by_subarchitecture);
    if (options_.on_task)
      services_->on_task = [this](TaskEvent x) { caf::anon_send(observer_, std::move(x)); };
    for (auto& wm : working_memories_)
      if (options_.on_change || logged_.count(wm.subarchitecture) > 0)
        caf::send_as(observer_, wm.actor, Subscribe{1, any_change()});
    // Subscriptions are in force once the working memories have answered anything sent after them.
    for (auto& wm : working_memories_)
      self_->request(wm.actor, caf::infinite, StatusQuery{})
        .receive([](const WorkingMemoryStatus&) {}, [](const caf::error&) {});
  }

  /// Lets it tell all there is to tell: what it was sent, and what it is sent when it has told
  /// that.
  void flush_observer() {
    auto until = Clock::now() + options_.stop_patience;
    std::uint64_t last = 0;
    std::uint64_t sent = 0;
    do {
      last = sent;
      self_->request(observer_, caf::infinite, FlushAtom::value)
        .receive([](bool) {}, [](const caf::error&) {});
      sent = sum_of(&WorkingMemoryStatus::delivered);
    } while (sent != last && Clock::now() < until);
  }

  void start_keeper() {
    KeeperParts parts;
    for (auto& x : running_)
      parts.components.push_back(x.record);
    parts.working_memories = services_->by_subarchitecture;
    keeper_ = system_.spawn(keeper, std::move(parts));
  }

  std::uint64_t sum_of(std::uint64_t WorkingMemoryStatus::*counter) {
    std::uint64_t result = 0;
    for (auto& wm : working_memories_)
      self_->request(wm.actor, caf::infinite, StatusQuery{})
        .receive([&](const WorkingMemoryStatus& x) { result += x.*counter; },
                 [](const caf::error&) {});
    return result;
  }

  bool somebody_is_busy(Clock::time_point now) const {
    return std::any_of(running_.begin(), running_.end(),
                       [&](auto& x) { return x.record->busy_for(now) > polling; });
  }

  /// Task managers alone do nothing.
  bool all_failed() const {
    return std::all_of(running_.begin(), running_.end(), [](auto& x) {
      return x.is_task_manager || x.record->state() == ComponentState::failed;
    });
  }

  /// Stops a component; false if it does not stop in time.
  bool await_end(const Running& x) {
    self_->monitor(x.actor);
    self_->send_exit(x.actor, caf::exit_reason::user_shutdown);
    auto until = Clock::now() + options_.stop_patience;
    bool down = false;
    while (!down && Clock::now() < until && !(interrupted() && Clock::now() > until - 4s))
      self_->receive([&](const caf::down_msg& y) { down = y.source == x.actor.address(); },
                     [](const PhaseDone&) {}, caf::after(glance) >> [] {});
    return down;
  }

  ArchitectureDescription architecture_;
  SystemOptions options_;
  LoggedChanges logged_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::pair<int, std::string>> ended_;

  // Declared before the actor system, and so destroyed after it.
  std::shared_ptr<ComponentServices> services_ = std::make_shared<ComponentServices>();
  ActorSystemConfig config_;
  caf::actor_system system_{config_};
  caf::scoped_actor self_{system_};

  std::vector<WorkingMemory> working_memories_;
  /// In the order of their start, once they are all there.
  std::vector<Running> running_;
  caf::actor observer_;
  caf::actor keeper_;
  std::vector<std::string> stuck_;
  bool stopped_ = false;
};

System::System(ArchitectureDescription architecture, SystemOptions options)
  : implementation_(std::make_unique<Implementation>(std::move(architecture), std::move(options))) {
}

System::~System() = default;

bool System::start() {
  return implementation_->start();
}

EndReason System::wait(const Until& until) {
  return implementation_->wait(until);
}

std::optional<std::pair<int, std::string>> System::ended() const {
  return implementation_->ended();
}

void System::stop() {
  implementation_->stop();
}

SystemSummary System::summary() {
  return implementation_->summary();
}

std::vector<EntryPtr> System::entries(const std::string& subarchitecture) {
  return implementation_->entries(subarchitecture);
}

std::vector<std::string> System::subarchitectures() const {
  std::vector<std::string> result;
  for (auto& x : implementation_->architecture().subarchitectures)
    result.push_back(x.name);
  return result;
}

std::chrono::steady_clock::time_point System::epoch() const {
  return implementation_->epoch();
}

} // namespace castor
