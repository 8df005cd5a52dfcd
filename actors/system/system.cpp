#include "castor/actors/system/system.hpp"

#include "castor/actors/cast/running.hpp"
#include "castor/actors/node/actor_system_config.hpp"
#include "castor/actors/node/check.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/part_agent.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/processes.hpp"
#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/supervision/supervisor.hpp"
#include "castor/actors/system/component_statuses.hpp"
#include "castor/actors/system/local_endpoint.hpp"
#include "castor/actors/system/observer.hpp"
#include "castor/base/log.hpp"

#include <caf/scoped_actor.hpp>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <set>
#include <utility>

namespace castor {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// How often the main thread looks up from waiting.
constexpr auto poll_interval = 50ms;

/// A component that was busy for longer than this when looked at keeps a system from being quiet;
/// one that merely polls does not.
constexpr auto polling = 200ms;

/// "vision-1234-77": differs from the names of all other systems.
std::string new_system_name(const ArchitectureDescription& architecture) {
  return std::filesystem::path{architecture.file}.stem().string() + '-' + std::to_string(getpid()) +
         '-' + std::to_string(new_incarnation() % 10'000);
}

} // namespace

class System::Implementation {
public:
  Implementation(ArchitectureDescription architecture, SystemOptions options)
    : architecture_(std::move(architecture)), options_(std::move(options)),
      placed_(checked(place(architecture_, options_.nodes), architecture_)) {
    for_each_component(architecture_,
                       [&](auto& x) { next_number_ = std::max(next_number_, x.number + 1); });
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
    started_ = true;
    observe();
    auto problems = start_components(architecture_);
    if (!problems)
      return false;
    if (!problems->empty()) {
      was_refused_ = true;
      stop();
      throw SystemError{*std::move(problems)};
    }
    return true;
  }

  EndReason wait(const Until& until) {
    auto begin = Clock::now();
    auto last_activity = begin;
    std::uint64_t last_events = 0;
    for (;;) {
      if (sleep())
        return EndReason::ended_by_component;
      carry_out_orders();
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

  std::vector<Diagnostic> add(ArchitectureDescription added) {
    auto joined = architecture_;
    if (auto problems = cast::join(joined, added, next_number_); !problems.empty())
      return problems;
    auto placement = place(joined, options_.nodes, roster()->hosts);
    if (auto problems = problems_of(placement, joined); !problems.empty())
      return problems;
    try {
      processes_.connect(joined, placement);
      apply(joined, placement);
    } catch (const SystemError& e) {
      take_back(std::move(placement));
      return e.diagnostics();
    }
    auto before = std::exchange(architecture_, std::move(joined));
    observe();
    auto problems = start_components(added);
    if (!problems)
      return {{Severity::error, {}, {}, {}, "the system ends before they have started", {}}};
    if (problems->empty())
      return {};
    send_stop(names_of(added));
    architecture_ = std::move(before);
    take_back(placement);
    observe();
    return *std::move(problems);
  }

  std::string remove(const std::string& name) {
    auto rest = architecture_;
    auto removal = cast::remove(rest, name);
    if (!removal.problem.empty())
      return removal.problem;
    stop_components(removal.components);
    architecture_ = std::move(rest);
    auto placement = place(architecture_, options_.nodes, roster()->hosts);
    forget_lost_hosts(placement);
    try {
      apply(architecture_, placement);
    } catch (const SystemError& e) {
      // A node that does not answer now will be told of it when it is asked for something else.
      log_runtime(LogLevel::warning, e.what());
    }
    observe();
    return {};
  }

  void catch_up() {
    if (!observer_)
      return;
    // They have sent by then what they had to tell.
    ask_working_memories();
    ask_observer();
  }

  void stop() {
    stopped_ = true;
    processes_.suppress_notifications();
    refuse_orders();
    if (started_) {
      // With the working memories, whatever else is done to anybody is over.
      stop_components(names_of(architecture_));
    }
    if (observer_)
      flush_observer();
  }

  bool inject(const std::string& component, const ComponentFault& x) {
    auto known = roster();
    auto i = known->placement.find(component);
    if (i == known->placement.end())
      return false;
    if (x.kind == ComponentFault::Kind::blocked_configure ||
        x.kind == ComponentFault::Kind::blocked_start) {
      caf::anon_send(supervisor_, InjectComponentFault{component, observed(x)});
      return true;
    }
    if (!processes_.is_up(i->second))
      return false;
    auto agent = processes_.agent(i->second);
    InjectComponentFault order{component, observed(x)};
    if (i->second != 0) {
      caf::anon_send(agent, order);
      return true;
    }
    // Whatever is done next comes after the fault.
    caf::scoped_actor self{system_};
    self->request(agent, 1s, order).receive([](Acknowledged) {}, [](const caf::error&) {});
    return true;
  }

  void inject(ProcessNumber a, ProcessNumber b, const LinkFault& x) {
    caf::anon_send(processes_.agent(a), InjectLinkFault{b, observed(x)});
    caf::anon_send(processes_.agent(b), InjectLinkFault{a, observed(x)});
  }

  /// A fault that a working memory brings about itself; false if there is none in reach.
  template <class WorkingMemoryFault>
  bool inject_into_working_memory(const std::string& subarchitecture, WorkingMemoryFault x) {
    auto known = roster();
    auto i = known->working_memories.find(subarchitecture);
    if (i == known->working_memories.end() || !is_in_reach(working_memory_of(subarchitecture)))
      return false;
    caf::anon_send(i->second, observed(std::move(x)));
    return true;
  }

  /// What the system is now.
  SystemRosterPtr roster() const {
    std::lock_guard guard{mutex_};
    return roster_;
  }

  SystemSummary summary() {
    SystemSummary result;
    auto parts = ask_parts();
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts[i])
        result.processes.push_back({processes_.state(static_cast<ProcessNumber>(i)).description,
                                    parts[i]->usage, parts[i]->links});
    result.working_memories = ask_working_memories();
    result.components = component_statuses(*roster(), parts);
    result.unstopped = stuck_;
    for (auto& name : stuck_)
      if (process_of(name) == 0)
        result.stuck.push_back(name);
    return result;
  }

  void abandon() { end(); }

  std::vector<EntryPtr> entries(const std::string& subarchitecture) {
    std::vector<EntryPtr> result;
    self_
      ->request(roster()->working_memories.at(subarchitecture), options_.answer_patience,
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
  /// The fault, with somebody to tell when it takes effect if it has a number.
  template <class InjectedFault>
  InjectedFault observed(InjectedFault x) const {
    if constexpr (requires { x.ticket; })
      if (x.ticket.number != 0)
        x.ticket.observer = end_listener_;
    return x;
  }

  static Placement checked(Placement x, const ArchitectureDescription& architecture) {
    if (auto problems = problems_of(x, architecture); !problems.empty())
      throw SystemError{std::move(problems)};
    return x;
  }

  bool interrupted() const { return options_.interrupted && options_.interrupted(); }

  /// For a glance; whether a component has ended the system.
  bool sleep() {
    std::unique_lock guard{mutex_};
    changed_.wait_for(guard, poll_interval,
                      [this] { return ended_.has_value() || !orders_.empty(); });
    return ended_.has_value();
  }

  ProcessNumber process_of(const std::string& name) const {
    auto x = roster();
    auto i = x->placement.find(name);
    return i == x->placement.end() ? ProcessNumber{0} : i->second;
  }

  /// Tells the supervisor something; nothing if the answer was not waited for, because somebody has
  /// interrupted that.
  template <class Answer, class Question>
  std::optional<Answer> tell_supervisor(const Question& question, bool interruptible) {
    std::optional<Answer> result;
    auto answer = std::make_shared<std::promise<std::optional<Answer>>>();
    auto future = answer->get_future();
    system_.spawn([answer, question, to = supervisor_](caf::event_based_actor* self) {
      self->request(to, caf::infinite, question)
        .then([answer](const Answer& x) { answer->set_value(x); },
              [answer](const caf::error&) { answer->set_value(std::nullopt); });
    });
    while (future.wait_for(poll_interval) != std::future_status::ready)
      if (interruptible && interrupted())
        return std::nullopt;
    return future.get();
  }

  // -- making the system

  void make() {
    // Anybody may end the system, from the moment when there is somebody.
    end_listener_ = system_.spawn([this]() -> caf::behavior {
      return {
        [this](const EndSystem& x) { end_asked_for(x); },
        [this](const FaultHappened& x) {
          if (options_.on_fault_happened)
            options_.on_fault_happened(x.number);
        },
      };
    });
    if (options_.on_task)
      make_observer();
    make_supervisor();
    processes_.connect(architecture_, placed_);
    PartAgentParts parts;
    parts.mesh = processes_.mesh();
    parts.messages = processes_.messages();
    processes_.set_own_agent(system_.spawn(part_agent, std::move(parts)));
    apply(architecture_, placed_);
    if (!options_.endpoint.empty())
      open_endpoint();
  }

  void make_supervisor() {
    SupervisorParts parts;
    parts.processes = &processes_;
    parts.options = &options_;
    parts.file = architecture_.file;
    parts.epoch = epoch_;
    parts.end_listener = end_listener_;
    parts.task_observer = options_.on_task ? observer_ : nullptr;
    parts.on_change = [this](SystemRosterPtr x) { update_roster(std::move(x)); };
    supervisor_ = system_.spawn(supervisor, std::move(parts));
    std::lock_guard guard{mutex_};
    reported_to_ = supervisor_;
  }

  /// Called by the supervisor.
  void update_roster(SystemRosterPtr x) {
    std::lock_guard guard{mutex_};
    roster_ = std::move(x);
    if (endpoint_)
      caf::anon_send(endpoint_, roster_);
    if (observed_)
      tell_observer();
  }

  /// Called by the network.
  void on_link_news(const LinkNews& x) {
    std::lock_guard guard{mutex_};
    if (reported_to_)
      caf::anon_send(reported_to_, x);
  }

  /// Makes it so in every process. Throws SystemError.
  void apply(const ArchitectureDescription& architecture, const Placement& placement) {
    auto deployed = tell_supervisor<Deployed>(Deploy{architecture, placement}, false);
    if (deployed && !deployed->problems.empty())
      throw SystemError{std::move(deployed->problems)};
  }

  /// What could not be added is to be nowhere.
  void take_back(Placement placement) {
    auto before = place(architecture_, options_.nodes, roster()->hosts);
    // A host whose process could not be reached gets another one next time.
    std::erase_if(placement.hosts, [&](auto& x) {
      return before.hosts.count(x.first) == 0 &&
             (x.second >= processes_.size() || processes_.state(x.second).link == LinkState::lost);
    });
    placement.processes.resize(processes_.size());
    before.hosts = std::move(placement.hosts);
    before.processes = std::move(placement.processes);
    try {
      apply(architecture_, before);
    } catch (const SystemError& e) {
      log_runtime(LogLevel::warning, e.what());
    }
  }

  /// What is added for a host whose process is lost, once nothing is left of what it ran, goes to
  /// the process that listens there then.
  void forget_lost_hosts(Placement& placement) const {
    std::erase_if(placement.hosts, [&](auto& host) {
      return processes_.state(host.second).link == LinkState::lost &&
             std::none_of(placement.of.begin(), placement.of.end(),
                          [&](auto& x) { return x.second == host.second; });
    });
  }

  static std::vector<std::string> names_of(const ArchitectureDescription& x) {
    std::vector<std::string> result;
    for_each_component(x, [&](auto& y) {
      if (!y.name.empty())
        result.push_back(y.name);
    });
    return result;
  }

  /// Configures them all, then starts them all, then lets them run. Nothing if interrupted,
  /// otherwise what is wrong with their configuration; then none of them is started.
  std::optional<std::vector<Diagnostic>> start_components(const ArchitectureDescription& x) {
    auto started = tell_supervisor<ComponentsStarted>(StartComponents{names_of(x)}, true);
    if (!started)
      return std::nullopt;
    return std::move(started->problems);
  }

  // -- while it runs

  void end_asked_for(const EndSystem& x) {
    std::lock_guard guard{mutex_};
    if (!ended_)
      ended_.emplace(x.status, x.reason);
    changed_.notify_all();
  }

  bool is_in_reach(const std::string& component) const {
    return processes_.is_up(process_of(component));
  }

  // -- who looks on

  void make_observer() {
    if (!observer_)
      observer_ = system_.spawn<caf::detached>(observer, std::cref(options_));
  }

  void observe() {
    std::map<std::string, LogLevel> logged;
    for (auto& x : architecture_.subarchitectures) {
      WorkingMemoryClass wm_class{x.working_memory};
      if (wm_class.log || wm_class.debug)
        logged[x.name] = wm_class.debug ? LogLevel::trace : LogLevel::debug;
    }
    if (!options_.on_change && !options_.on_entry && options_.watched.empty() && logged.empty())
      return;
    make_observer();
    {
      std::lock_guard guard{mutex_};
      observed_ = std::move(logged);
      tell_observer();
    }
    ask_observer();
    // Its subscriptions are in force once the working memories have answered anything sent after
    // them.
    ask_working_memories();
  }

  /// What it is to look at; with the mutex locked.
  void tell_observer() {
    caf::anon_send(observer_, ObservedSystem{roster_->working_memories, *observed_});
  }

  void ask_observer() {
    self_->request(observer_, caf::infinite, FlushObserver{})
      .receive([](bool) {}, [](const caf::error&) {});
  }

  /// Lets it tell all there is to tell: what it was sent, and what it is sent when it has told
  /// that.
  void flush_observer() {
    auto until = Clock::now() + options_.stop_patience;
    std::uint64_t last = 0;
    std::uint64_t sent = 0;
    do {
      last = sent;
      ask_observer();
      sent = sum_of(&WorkingMemoryStatus::delivered);
    } while (sent != last && Clock::now() < until);
  }

  void open_endpoint() {
    auto operations =
      options_.operations.empty() ? nullptr : std::make_shared<OperationLog>(options_.operations);
    auto endpoint = open_local_endpoint(
      system_, options_.endpoint,
      [this](SystemOrder x) {
        std::lock_guard guard{mutex_};
        orders_.push_back(std::move(x));
        changed_.notify_all();
      },
      std::move(operations));
    std::lock_guard guard{mutex_};
    endpoint_ = endpoint;
    caf::anon_send(endpoint_, roster_);
  }

  std::deque<SystemOrder> take_orders() {
    std::lock_guard guard{mutex_};
    return std::exchange(orders_, {});
  }

  void carry_out_orders() {
    for (auto& order : take_orders()) {
      if (auto* name = std::get_if<std::string>(&order.what)) {
        order.done({remove(*name), {}});
      } else {
        order.done({{}, add(std::move(std::get<ArchitectureDescription>(order.what)))});
      }
    }
  }

  void refuse_orders() {
    for (auto& order : take_orders())
      order.done({"the system is about to end", {}});
  }

  // -- how it is doing

  std::vector<WorkingMemoryStatus> ask_working_memories() {
    auto ask = [&](const WorkingMemoryActor& wm) {
      return self_->request(wm, options_.answer_patience, StatusQuery{});
    };
    std::vector<decltype(ask(WorkingMemoryActor{}))> answers;
    auto known = roster();
    for (auto& x : architecture_.subarchitectures)
      if (auto i = known->working_memories.find(x.name);
          i != known->working_memories.end() && is_in_reach(x.working_memory.name))
        answers.push_back(ask(i->second));
    std::vector<WorkingMemoryStatus> result;
    for (auto& answer : answers)
      answer.receive([&](const WorkingMemoryStatus& x) { result.push_back(x); },
                     [](const caf::error&) {});
    return result;
  }

  std::uint64_t sum_of(std::uint64_t WorkingMemoryStatus::*counter) {
    std::uint64_t result = 0;
    for (auto& x : ask_working_memories())
      result += x.*counter;
    return result;
  }

  PartStatuses ask_parts() {
    auto ask = [&](ProcessNumber i) {
      return self_->request(processes_.agent(i), options_.answer_patience, PartStatusQuery{});
    };
    PartStatuses result(processes_.size());
    std::vector<std::pair<std::size_t, decltype(ask(0))>> answers;
    for (std::size_t i = 0; i < result.size(); ++i)
      if (processes_.is_up(static_cast<ProcessNumber>(i)))
        answers.emplace_back(i, ask(static_cast<ProcessNumber>(i)));
    for (auto& [i, answer] : answers)
      answer.receive([&, &to = result[i]](const PartStatus& x) { to = x; },
                     [](const caf::error&) {});
    return result;
  }

  std::vector<ComponentStatus> status() { return component_statuses(*roster(), ask_parts()); }

  static bool somebody_is_busy(const std::vector<ComponentStatus>& components) {
    return std::any_of(components.begin(), components.end(),
                       [](auto& x) { return x.busy > polling; });
  }

  /// Task managers alone do nothing.
  static bool all_failed(const std::vector<ComponentStatus>& components) {
    return std::all_of(components.begin(), components.end(), [](auto& x) {
      return x.is_task_manager ||
             (x.state == ComponentState::failed && !x.out_of_reach && !x.will_restart);
    });
  }

  // -- the end

  /// Returns those that have stopped, in the order of their end.
  std::vector<std::string> send_stop(const std::vector<std::string>& names) {
    auto outcome = tell_supervisor<ComponentsStopped>(StopComponents{names}, false);
    if (!outcome)
      return {};
    stuck_.insert(stuck_.end(), outcome->stuck.begin(), outcome->stuck.end());
    return std::move(outcome->stopped);
  }

  void stop_components(const std::vector<std::string>& names) {
    auto stopped = send_stop(names);
    if (stopped.empty() || was_refused_)
      return;
    std::string list;
    for (auto& name : stopped)
      list += (list.empty() ? "" : ", ") + name;
    log_runtime(LogLevel::info, "stopped, in this order: " + list);
  }

  void end() {
    // Nobody calls this object any more.
    caf::anon_send_exit(supervisor_, caf::exit_reason::user_shutdown);
    await_ends(system_, {supervisor_});
    {
      std::lock_guard guard{mutex_};
      reported_to_ = nullptr;
      // Holds stand-alone components, which hold the observer, whose thread the actor system waits
      // for.
      roster_ = std::make_shared<const SystemRoster>();
    }
    caf::anon_send_exit(endpoint_, caf::exit_reason::user_shutdown);
    await_ends(system_, {endpoint_});
    processes_.close("the system has ended");
    caf::anon_send_exit(processes_.agent(0), caf::exit_reason::user_shutdown);
    caf::anon_send_exit(observer_, caf::exit_reason::user_shutdown);
    caf::anon_send_exit(end_listener_, caf::exit_reason::user_shutdown);
  }

  ArchitectureDescription architecture_;
  const SystemOptions options_;
  /// As the file has it; `roster` knows better later.
  const Placement placed_;
  /// Of the next component that is added.
  std::size_t next_number_ = 0;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::pair<int, std::string>> ended_;
  std::deque<SystemOrder> orders_;
  SystemRosterPtr roster_ = std::make_shared<const SystemRoster>();
  /// Who is told of news of the network.
  caf::actor reported_to_;
  /// At which levels changes are logged, by subarchitecture; nothing if nobody observes.
  std::optional<std::map<std::string, LogLevel>> observed_;

  ActorSystemConfig config_{placed_.processes.size() > 1 || !options_.endpoint.empty()};
  caf::actor_system system_{config_};
  const Clock::time_point epoch_ = Clock::now();
  caf::scoped_actor self_{system_};

  Processes processes_{system_, options_, new_system_name(architecture_),
                       [this](const LinkNews& x) { on_link_news(x); }};
  caf::actor end_listener_;
  caf::actor supervisor_;
  caf::actor observer_;
  caf::actor endpoint_;
  std::vector<std::string> stuck_;
  bool started_ = false;
  /// Its configuration was wrong, so it has never run.
  bool was_refused_ = false;
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

void System::catch_up() {
  implementation_->catch_up();
}

void System::stop() {
  implementation_->stop();
}

void System::abandon() {
  implementation_->abandon();
}

std::vector<Diagnostic> System::add(ArchitectureDescription added) {
  return implementation_->add(std::move(added));
}

std::string System::remove(const std::string& name) {
  return implementation_->remove(name);
}

bool System::inject(const std::string& component, const ComponentFault& x) {
  return implementation_->inject(component, x);
}

void System::inject(ProcessNumber a, ProcessNumber b, const LinkFault& x) {
  implementation_->inject(a, b, x);
}

bool System::inject(const std::string& subarchitecture, const JournalFault& x) {
  return implementation_->inject_into_working_memory(subarchitecture, x);
}

bool System::jump_clock(const std::string& subarchitecture, Timestamp by) {
  return implementation_->inject_into_working_memory(subarchitecture, JumpClock{by});
}

SystemRosterPtr System::roster() const {
  return implementation_->roster();
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
