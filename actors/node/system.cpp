#include "castor/actors/node/system.hpp"

#include "castor/actors/component/log.hpp"
#include "castor/actors/component/shell_protocol.hpp"
#include "castor/actors/node/actor_system_config.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/messages.hpp"
#include "castor/actors/node/part_agent.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/working_memory_class.hpp"

#include <caf/atom.hpp>
#include <caf/scoped_actor.hpp>
#include <caf/stateful_actor.hpp>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

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

struct ObserverState {
  std::map<std::string, caf::strong_actor_ptr> working_memories;
  std::map<std::string, Receipts> receipts;
};

caf::behavior observer(caf::stateful_actor<ObserverState>* self, const SystemOptions& options,
                       const LoggedChanges& logged) {
  auto observe = [self, &options, &logged](const ChangeEvent& event) {
    observe_change(options, logged, event);
    auto& where = event.address.subarchitecture;
    auto receipts = self->state.receipts.try_emplace(where, standard_queue_limit).first;
    if (auto count = receipts->second.take())
      self->send(caf::actor_cast<WorkingMemoryActor>(self->state.working_memories.at(where)),
                 EventsTaken{EventStream::component, count});
  };
  return {
    [self](const Peers& x) { self->state.working_memories = x.working_memories; },
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

} // namespace

SystemError::SystemError(std::vector<cast::Diagnostic> diagnostics)
  : runtime_error(cast::render(diagnostics)), diagnostics_(std::move(diagnostics)) {}

class System::Implementation {
public:
  Implementation(ArchitectureDescription architecture, SystemOptions options)
    : architecture_(std::move(architecture)), options_(std::move(options)),
      placement_(checked(place(architecture_, options_.nodes))) {
    try {
      make();
    } catch (...) {
      end();
      throw;
    }
  }

  ~Implementation() {
    if (!stopped_)
      stop();
    end();
  }

  bool start() {
    observe();
    std::vector<std::string> order;
    auto configure = [&](const ComponentDescription& x) {
      order.push_back(x.name);
      return enter(Phase::configure, x.name);
    };
    for (auto& subarchitecture : architecture_.subarchitectures) {
      if (!configure(subarchitecture.task_manager))
        return false;
      // Managed components first, then unmanaged ones.
      for (auto kind : {ComponentKind::managed, ComponentKind::unmanaged})
        for (auto& x : subarchitecture.components)
          if (x.kind == kind && !configure(x))
            return false;
    }
    auto first_standalone = order.size();
    for (auto& x : architecture_.standalone)
      if (!configure(x))
        return false;
    // What stands outside the subarchitectures starts first: the others will want to connect to it.
    std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(first_standalone),
                order.end());
    order_ = order;
    for (auto& name : order)
      if (!enter(Phase::start, name))
        return false;
    for (auto& name : order)
      self_->send(component(name), EnterPhase{Phase::run, caf::actor_cast<caf::actor>(self_)});
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
      auto components = status();
      if (all_failed(components))
        return EndReason::all_failed;
      if (!until.quiet)
        continue;
      auto events = sum_of(&WorkingMemoryStatus::events);
      if (std::exchange(last_events, events) != events || somebody_is_busy(components))
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
    std::string stopped;
    for (auto i = order_.rbegin(); i != order_.rend(); ++i) {
      // Of a node that is out of reach, the part ends by itself.
      if (!is_in_reach(*i))
        continue;
      if (await_end(component(*i)))
        stopped += (stopped.empty() ? "" : ", ") + *i;
      else
        stuck_.push_back(*i);
    }
    if (!stopped.empty())
      note(LogLevel::info, "stopped, in this order: " + stopped);
    for (auto& name : stuck_)
      note(LogLevel::error, name + " did not stop: it has not come back from its own code");
    if (observer_)
      flush_observer();
  }

  SystemSummary summary() {
    SystemSummary result;
    for (auto& [name, wm] : working_memories_) {
      if (!is_in_reach(architecture_.subarchitecture(name)->working_memory.name))
        continue;
      self_->request(wm, options_.answer_patience, StatusQuery{})
        .receive(
          [&](const WorkingMemoryStatus& x) {
            result.working_memories.push_back({x.subarchitecture, x.entries_by_type, x.events,
                                               x.matched, x.delivered, x.coalesced, x.suppressed,
                                               x.forwarded, x.routed, x.refused});
          },
          [](const caf::error&) {});
    }
    result.components = status();
    for (auto& name : stuck_)
      if (process_of(name) == 0)
        result.stuck.push_back(name);
    return result;
  }

  void abandon() {
    end();
    caf::scoped_actor waiting{system_};
    for (auto& x : processes_)
      if (x.link)
        waiting->wait_for(x.link);
  }

  std::vector<EntryPtr> entries(const std::string& subarchitecture) {
    std::vector<EntryPtr> result;
    self_
      ->request(working_memory_of(subarchitecture), options_.answer_patience,
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
  Clock::time_point epoch() const { return epoch_; }

private:
  /// A process that takes part, this one included.
  struct Process {
    ProcessDescription description;
    caf::actor agent;
    caf::actor link;
    LinkNews news{0, LinkNews::Kind::down, "no answer yet", {}};
    /// Whether it was ever reached.
    bool joined = false;
  };

  static Placement checked(Placement x) {
    if (!x.problems.empty())
      throw SystemError{std::move(x.problems)};
    return x;
  }

  bool interrupted() const { return options_.interrupted && options_.interrupted(); }

  // -- making the system

  void make() {
    for (auto& x : placement_.processes)
      processes_.push_back({x, nullptr, nullptr});
    // Anybody may end the system, from the moment when there is somebody.
    desk_ = system_.spawn(
      [this]() -> caf::behavior { return {[this](const EndSystem& x) { end_asked_for(x); }}; });
    if (options_.on_task)
      observer_ = spawn_observer();
    if (processes_.size() > 1)
      connect();
    PartAgentParts parts;
    parts.mesh = mesh_;
    processes_.front().agent = system_.spawn(part_agent, std::move(parts));
    join(make_parts());
  }

  void connect() {
    check_security();
    mesh_ = std::make_shared<Mesh>(system_, system_messages(), ProcessNumber{0});
    auto name = "castor-" + std::to_string(getpid());
    Hello self;
    self.node = options_.credentials ? options_.credentials->names().front() : name;
    self.system = std::filesystem::path{architecture_.file}.stem().string() + '-' +
                  std::to_string(getpid()) + '-' + std::to_string(new_incarnation() % 10'000);
    self.incarnation = new_incarnation();
    for (std::size_t i = 1; i < processes_.size(); ++i) {
      auto& x = processes_[i];
      LinkParts parts;
      parts.mesh = mesh_;
      parts.peer = static_cast<ProcessNumber>(i);
      parts.peer_name = x.description.name;
      parts.dial = Endpoint{x.description.host, x.description.port};
      parts.self = self;
      parts.self.receiver = parts.peer;
      parts.credentials = options_.credentials;
      parts.options = options_.link;
      parts.counters = std::make_shared<LinkCounters>();
      parts.on_news = [this](const LinkNews& news) { hear(news); };
      x.link = spawn_link(system_, std::move(parts));
      auto peer = static_cast<ProcessNumber>(i);
      mesh_->add_port(std::make_shared<LinkPort>(mesh_, peer, x.link));
      x.agent = caf::actor_cast<caf::actor>(mesh_->well_known(peer, WellKnownActor::agent));
    }
    await_connections();
  }

  void check_security() {
    if (options_.credentials || options_.insecure)
      return;
    std::vector<cast::Diagnostic> problems;
    for (std::size_t i = 1; i < processes_.size(); ++i) {
      if (is_loopback(processes_[i].description.host))
        continue;
      processes_[i].news.reason = "what is said to another machine has to be encrypted";
      problems.push_back(out_of_reach(static_cast<ProcessNumber>(i)));
      problems.back().remedy = "name a certificate with --tls DIR (scripts/make-certs makes some), "
                               "or say --insecure";
    }
    if (!problems.empty())
      throw SystemError{std::move(problems)};
  }

  void hear(const LinkNews& news) {
    std::lock_guard guard{mutex_};
    auto& x = processes_[news.peer];
    x.news = news;
    if (!news.name.empty())
      x.description.name = news.name;
    if (x.joined && !stopped_) {
      if (news.kind == LinkNews::Kind::up)
        note(LogLevel::info, "node " + news.name + " is in reach again");
      else
        note(LogLevel::warning,
             "node " + news.name +
               (news.kind == LinkNews::Kind::lost ? " is lost: " : " is out of reach: ") +
               news.reason);
    }
    x.joined = x.joined || news.kind == LinkNews::Kind::up;
    changed_.notify_all();
  }

  void await_connections() {
    auto until = Clock::now() + options_.connect_patience;
    std::unique_lock guard{mutex_};
    auto settled = [this] {
      return std::all_of(processes_.begin() + 1, processes_.end(),
                         [](auto& x) { return x.news.kind != LinkNews::Kind::down; });
    };
    while (!settled() && Clock::now() < until && !interrupted())
      changed_.wait_for(guard, glance);
    std::vector<cast::Diagnostic> problems;
    for (std::size_t i = 1; i < processes_.size(); ++i)
      if (processes_[i].news.kind != LinkNews::Kind::up)
        problems.push_back(out_of_reach(static_cast<ProcessNumber>(i)));
    if (!problems.empty())
      throw SystemError{std::move(problems)};
  }

  /// At the first line that needs the node.
  cast::Diagnostic out_of_reach(ProcessNumber process) {
    auto& x = processes_[process];
    auto at = to_string(Endpoint{x.description.host, x.description.port});
    cast::Diagnostic result;
    result.message = "cannot reach the node " +
                     (x.description.name.empty() ? at : x.description.name + " at " + at) + ": " +
                     x.news.reason;
    result.remedy = "start it there with `castor node`, or try the system on this machine with "
                    "`castor run --local-nodes`";
    for_each_component([&](const ComponentDescription& component) {
      auto i = placement_.of.find(component.name);
      if (i != placement_.of.end() && i->second == process && result.line.empty()) {
        result.where = component.where;
        result.line = component.line;
      }
    });
    return result;
  }

  template <class F>
  void for_each_component(F&& f) {
    for (auto& subarchitecture : architecture_.subarchitectures) {
      f(subarchitecture.working_memory);
      f(subarchitecture.task_manager);
      for (auto& x : subarchitecture.components)
        f(x);
    }
    for (auto& x : architecture_.standalone)
      f(x);
  }

  /// Asks every process to make its part; the actors of all of them.
  std::map<std::string, caf::strong_actor_ptr> make_parts() {
    PartPlan plan;
    plan.architecture = architecture_;
    {
      std::lock_guard guard{mutex_};
      for (auto& x : processes_)
        plan.processes.push_back(x.description);
    }
    plan.placement = placement_.of;
    plan.open_access = options_.open_access;
    plan.broadcast = options_.broadcast;
    plan.coordinator = desk_;
    plan.task_observer = observer_;
    std::map<std::string, caf::strong_actor_ptr> actors;
    std::vector<cast::Diagnostic> problems;
    // All at once: each may have libraries to load.
    auto ask = [&](const Process& x) {
      plan.age = std::chrono::duration_cast<Timestamp>(Clock::now() - epoch_);
      return self_->request(x.agent, options_.connect_patience, plan);
    };
    std::vector<decltype(ask(processes_.front()))> answers;
    for (auto& x : processes_)
      answers.push_back(ask(x));
    for (std::size_t i = 0; i < processes_.size(); ++i) {
      auto& x = processes_[i];
      answers[i].receive(
        [&](const PartMade& made) {
          actors.insert(made.actors.begin(), made.actors.end());
          for (auto problem : made.problems) {
            if (i > 0)
              problem.message = "on the node " + plan.processes[i].name + ": " + problem.message;
            problems.push_back(std::move(problem));
          }
        },
        [&](const caf::error&) { problems.push_back(no_answer(x)); });
    }
    if (!problems.empty())
      throw SystemError{std::move(problems)};
    return actors;
  }

  cast::Diagnostic no_answer(const Process& x) {
    std::lock_guard guard{mutex_};
    cast::Diagnostic result;
    result.message = "the node " + x.description.name + " did not make its part of the system in " +
                     std::to_string(options_.connect_patience.count() / 1000) + " s";
    if (x.news.kind != LinkNews::Kind::up)
      result.message += ": " + x.news.reason;
    return result;
  }

  void join(const std::map<std::string, caf::strong_actor_ptr>& actors) {
    std::vector<cast::Diagnostic> problems;
    for (auto& x : processes_)
      self_->request(x.agent, options_.connect_patience, JoinParts{actors})
        .receive([](Acknowledged) {},
                 [&](const caf::error&) {
                   problems.push_back(no_answer(x));
                   problems.back().remedy =
                     "see that the nodes can reach each other where the file says that they are";
                 });
    if (!problems.empty())
      throw SystemError{std::move(problems)};
    for (auto& x : architecture_.subarchitectures)
      working_memories_.emplace_back(
        x.name, caf::actor_cast<WorkingMemoryActor>(actors.at(x.working_memory.name)));
    for_each_component([&](const ComponentDescription& x) {
      if (x.kind != ComponentKind::working_memory)
        components_[x.name] = {caf::actor_cast<caf::actor>(actors.at(x.name)), x.number};
    });
  }

  // -- while it runs

  void end_asked_for(const EndSystem& x) {
    std::lock_guard guard{mutex_};
    if (!ended_)
      ended_.emplace(x.status, x.reason);
    changed_.notify_all();
  }

  const WorkingMemoryActor& working_memory_of(const std::string& subarchitecture) const {
    for (auto& [name, actor] : working_memories_)
      if (name == subarchitecture)
        return actor;
    throw std::out_of_range("no subarchitecture " + subarchitecture);
  }

  ProcessNumber process_of(const std::string& component) const {
    auto i = placement_.of.find(component);
    return i == placement_.of.end() ? 0 : i->second;
  }

  bool is_in_reach(const std::string& component) const {
    std::lock_guard guard{mutex_};
    auto process = process_of(component);
    return process == 0 || processes_[process].news.kind == LinkNews::Kind::up;
  }

  const caf::actor& component(const std::string& name) const { return components_.at(name).actor; }

  /// Waits until the component has done what the phase asks of it; false if interrupted.
  bool enter(Phase phase, const std::string& name) {
    auto& x = components_.at(name);
    if (x.failed)
      return true;
    self_->monitor(x.actor);
    self_->send(x.actor, EnterPhase{phase, caf::actor_cast<caf::actor>(self_)});
    bool done = false;
    auto next_report = Clock::now() + 5s;
    while (!done) {
      self_->receive(
        [&](const PhaseDone& y) {
          if (y.component != x.number)
            return;
          done = true;
          x.failed = !y.failure.empty();
        },
        [&](const caf::down_msg& y) {
          if (y.source == x.actor.address())
            done = x.failed = true;
        },
        caf::after(glance) >> [] {});
      if (interrupted())
        return false;
      if (!done && Clock::now() >= next_report) {
        next_report += 5s;
        note(LogLevel::info,
             "waiting for " + name + " to " + (phase == Phase::configure ? "configure" : "start"));
      }
    }
    self_->demonitor(x.actor);
    return true;
  }

  caf::actor spawn_observer() {
    return system_.spawn<caf::detached>(observer, std::cref(options_), std::cref(logged_));
  }

  void observe() {
    for (auto& x : architecture_.subarchitectures) {
      WorkingMemoryClass wm_class;
      for (auto& setting : x.working_memory.options)
        wm_class.options.set(setting.name(), setting.value);
      if (wm_class.log || wm_class.debug)
        logged_[x.name] = wm_class.debug ? LogLevel::trace : LogLevel::debug;
    }
    if (!options_.on_change && logged_.empty())
      return;
    if (!observer_)
      observer_ = spawn_observer();
    Peers peers;
    for (auto& [name, wm] : working_memories_)
      peers.working_memories[name] = caf::actor_cast<caf::strong_actor_ptr>(wm);
    self_->send(observer_, peers);
    for (auto& [name, wm] : working_memories_)
      if (options_.on_change || logged_.count(name) > 0)
        caf::send_as(observer_, wm, Subscribe{1, any_change()});
    // Subscriptions are in force once the working memories have answered anything sent after them.
    sum_of(&WorkingMemoryStatus::filters);
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

  std::uint64_t sum_of(std::uint64_t WorkingMemoryStatus::*counter) {
    std::uint64_t result = 0;
    for (auto& [name, wm] : working_memories_)
      if (is_in_reach(architecture_.subarchitecture(name)->working_memory.name))
        self_->request(wm, options_.answer_patience, StatusQuery{})
          .receive([&](const WorkingMemoryStatus& x) { result += x.*counter; },
                   [](const caf::error&) {});
    return result;
  }

  /// Of all components, in the order of their start.
  std::vector<ComponentStatus> status() {
    std::map<std::string, ComponentStatus> found;
    for (auto& process : processes_) {
      {
        std::lock_guard guard{mutex_};
        if (process.link && process.news.kind != LinkNews::Kind::up)
          continue;
      }
      self_->request(process.agent, options_.answer_patience, PartStatusQuery{})
        .receive(
          [&](const PartStatus& x) {
            for (auto& y : x.components)
              found[y.identity.name] = y;
          },
          [](const caf::error&) {});
    }
    std::vector<ComponentStatus> result;
    for (auto& name : order_.empty() ? names() : order_)
      result.push_back(found.count(name) > 0 ? found[name] : status_of_lost(name));
    return result;
  }

  std::vector<std::string> names() {
    std::vector<std::string> result;
    for_each_component([&](const ComponentDescription& x) {
      if (x.kind != ComponentKind::working_memory)
        result.push_back(x.name);
    });
    return result;
  }

  /// Of a component whose node does not answer.
  ComponentStatus status_of_lost(const std::string& name) {
    auto& x = *architecture_.component(name);
    auto& process = processes_[process_of(name)];
    ComponentStatus result;
    result.identity = {x.name, x.subarchitecture, x.class_name,
                       static_cast<std::uint32_t>(x.number)};
    result.is_task_manager = x.kind == ComponentKind::task_manager;
    result.state = ComponentState::failed;
    std::lock_guard guard{mutex_};
    result.failure = "its node " + process.description.name + " does not answer";
    if (process.news.kind != LinkNews::Kind::up)
      result.failure += ": " + process.news.reason;
    return result;
  }

  static bool somebody_is_busy(const std::vector<ComponentStatus>& components) {
    return std::any_of(components.begin(), components.end(),
                       [](auto& x) { return x.busy > polling; });
  }

  /// Task managers alone do nothing.
  static bool all_failed(const std::vector<ComponentStatus>& components) {
    return std::all_of(components.begin(), components.end(), [](auto& x) {
      return x.is_task_manager || x.state == ComponentState::failed;
    });
  }

  // -- the end

  /// Stops a component; false if it does not stop in time.
  bool await_end(const caf::actor& x) {
    self_->monitor(x);
    self_->send_exit(x, caf::exit_reason::user_shutdown);
    auto until = Clock::now() + options_.stop_patience;
    bool down = false;
    while (!down && Clock::now() < until && !(interrupted() && Clock::now() > until - 4s))
      self_->receive([&](const caf::down_msg& y) { down = y.source == x.address(); },
                     [](const PhaseDone&) {}, caf::after(glance) >> [] {});
    return down;
  }

  void end() {
    for (std::size_t i = 1; i < processes_.size(); ++i)
      if (processes_[i].link)
        caf::anon_send(processes_[i].link, CloseLink{"the system has ended"});
    if (!processes_.empty())
      caf::anon_send_exit(processes_.front().agent, caf::exit_reason::user_shutdown);
    if (mesh_)
      mesh_->close();
    caf::anon_send_exit(observer_, caf::exit_reason::user_shutdown);
    caf::anon_send_exit(desk_, caf::exit_reason::user_shutdown);
  }

  struct Component {
    caf::actor actor;
    std::size_t number = 0;
    bool failed = false;
  };

  const ArchitectureDescription architecture_;
  const SystemOptions options_;
  const Placement placement_;
  LoggedChanges logged_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::pair<int, std::string>> ended_;
  std::vector<Process> processes_;

  ActorSystemConfig config_{placement_.processes.size() > 1};
  caf::actor_system system_{config_};
  const Clock::time_point epoch_ = Clock::now();
  caf::scoped_actor self_{system_};

  std::shared_ptr<Mesh> mesh_;
  caf::actor desk_;
  caf::actor observer_;
  std::vector<std::pair<std::string, WorkingMemoryActor>> working_memories_;
  std::map<std::string, Component> components_;
  /// Of the components' start.
  std::vector<std::string> order_;
  std::vector<std::string> stuck_;
  std::atomic<bool> stopped_{false};
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

void System::abandon() {
  implementation_->abandon();
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
