#include "castor/actors/node/system.hpp"

#include "castor/actors/cast/running.hpp"
#include "castor/actors/component/log.hpp"
#include "castor/actors/component/shell_protocol.hpp"
#include "castor/actors/node/actor_system_config.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/local_endpoint.hpp"
#include "castor/actors/node/observer.hpp"
#include "castor/actors/node/part_agent.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/processes.hpp"
#include "castor/actors/node/working_memory_class.hpp"

#include <caf/scoped_actor.hpp>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
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

/// "vision-1234-77": differs from the names of all other systems.
std::string new_system_name(const ArchitectureDescription& architecture) {
  return std::filesystem::path{architecture.file}.stem().string() + '-' + std::to_string(getpid()) +
         '-' + std::to_string(new_incarnation() % 10'000);
}

} // namespace

SystemError::SystemError(std::vector<cast::Diagnostic> diagnostics)
  : runtime_error(cast::render(diagnostics)), diagnostics_(std::move(diagnostics)) {}

class System::Implementation {
public:
  Implementation(ArchitectureDescription architecture, SystemOptions options)
    : architecture_(std::move(architecture)), options_(std::move(options)),
      placement_(checked(place(architecture_, options_.nodes))) {
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
    observe();
    return start_components(architecture_);
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

  std::vector<cast::Diagnostic> add(ArchitectureDescription added) {
    auto joined = architecture_;
    if (auto problems = cast::join(joined, added, next_number_); !problems.empty())
      return problems;
    auto placement = place(joined, options_.nodes, placement_);
    if (!placement.problems.empty())
      return placement.problems;
    try {
      processes_.connect(joined, placement);
      apply(joined, placement);
    } catch (const SystemError& e) {
      take_back(std::move(placement));
      return e.diagnostics();
    }
    architecture_ = std::move(joined);
    placement_ = std::move(placement);
    tell_of_change();
    start_components(added);
    return {};
  }

  std::string remove(const std::string& name) {
    auto rest = architecture_;
    auto removal = cast::remove(rest, name);
    if (!removal.problem.empty())
      return removal.problem;
    stop_components(removal.components);
    for (auto& x : removal.components) {
      std::erase(order_, x);
      components_.erase(x);
    }
    architecture_ = std::move(rest);
    placement_ = place(architecture_, options_.nodes, std::move(placement_));
    forget_lost_hosts();
    try {
      apply(architecture_, placement_);
    } catch (const SystemError& e) {
      // A node that does not answer now will be told of it when it is asked for something else.
      note(LogLevel::warning, e.what());
    }
    tell_of_change();
    return {};
  }

  void stop() {
    stopped_ = true;
    processes_.be_silent();
    refuse_orders();
    stop_components({order_.rbegin(), order_.rend()});
    if (observer_)
      flush_observer();
  }

  SystemSummary summary() {
    SystemSummary result;
    auto parts = ask_parts();
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts[i])
        result.processes.push_back({processes_.state(static_cast<ProcessNumber>(i)).description,
                                    parts[i]->usage, parts[i]->links});
    result.working_memories = ask_working_memories();
    result.components = status(parts);
    for (auto& name : stuck_)
      if (placement_.process_of(name) == 0)
        result.stuck.push_back(name);
    return result;
  }

  void abandon() { end(); }

  std::vector<EntryPtr> entries(const std::string& subarchitecture) {
    std::vector<EntryPtr> result;
    self_
      ->request(working_memories_.at(subarchitecture), options_.answer_patience,
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
  static Placement checked(Placement x) {
    if (!x.problems.empty())
      throw SystemError{std::move(x.problems)};
    return x;
  }

  bool interrupted() const { return options_.interrupted && options_.interrupted(); }

  /// For a glance; whether a component has ended the system.
  bool sleep() {
    std::unique_lock guard{mutex_};
    changed_.wait_for(guard, glance, [this] { return ended_.has_value() || !orders_.empty(); });
    return ended_.has_value();
  }

  // -- making the system

  void make() {
    // Anybody may end the system, from the moment when there is somebody.
    desk_ = system_.spawn(
      [this]() -> caf::behavior { return {[this](const EndSystem& x) { end_asked_for(x); }}; });
    if (options_.on_task)
      make_observer();
    processes_.connect(architecture_, placement_);
    PartAgentParts parts;
    parts.mesh = processes_.mesh();
    processes_.set_own_agent(system_.spawn(part_agent, std::move(parts)));
    apply(architecture_, placement_);
    if (!options_.endpoint.empty())
      open_endpoint();
  }

  /// Makes it so in every process. Throws SystemError.
  void apply(const ArchitectureDescription& architecture, const Placement& placement) {
    std::vector<cast::Diagnostic> problems;
    auto plan = plan_for(architecture, placement);
    auto made = ask_all<PartMade>(plan, problems);
    for (std::size_t i = 0; i < made.size(); ++i) {
      if (!made[i])
        continue;
      for (auto& [name, actor] : made[i]->actors)
        actors_[name] = actor;
      for (auto problem : made[i]->problems) {
        if (i > 0)
          problem.message = "on the node " + plan.processes[i].name + ": " + problem.message;
        problems.push_back(std::move(problem));
      }
    }
    if (!problems.empty())
      throw SystemError{std::move(problems)};
    join(architecture);
  }

  PartPlan plan_for(const ArchitectureDescription& architecture, const Placement& placement) const {
    PartPlan plan;
    plan.architecture = architecture;
    plan.processes = processes_.descriptions();
    plan.placement = placement.of;
    plan.open_access = options_.open_access;
    plan.broadcast = options_.broadcast;
    plan.coordinator = desk_;
    plan.task_observer = options_.on_task ? observer_ : nullptr;
    plan.age = std::chrono::duration_cast<Timestamp>(Clock::now() - epoch_);
    return plan;
  }

  /// Asks every process that is not lost the same, all at once; what they answer, by their numbers.
  template <class Answer, class Question>
  std::vector<std::optional<Answer>> ask_all(const Question& question,
                                             std::vector<cast::Diagnostic>& problems) {
    std::vector<std::optional<Answer>> result(processes_.size());
    auto ask = [&](std::size_t i) {
      return self_->request(processes_.agent(static_cast<ProcessNumber>(i)), options_.part_patience,
                            question);
    };
    std::vector<std::pair<std::size_t, decltype(ask(0))>> answers;
    for (std::size_t i = 0; i < result.size(); ++i)
      if (processes_.state(static_cast<ProcessNumber>(i)).link != LinkState::lost)
        answers.emplace_back(i, ask(i));
    for (auto& [i, answer] : answers)
      answer.receive([&, &to = result[i]](const Answer& x) { to = x; },
                     [&, number = static_cast<ProcessNumber>(i)](const caf::error&) {
                       problems.push_back(no_answer(number));
                     });
    return result;
  }

  cast::Diagnostic no_answer(ProcessNumber number) const {
    auto x = processes_.state(number);
    cast::Diagnostic result;
    result.message = (number == 0 ? "this process" : "the node " + x.description.name) +
                     " did not make its part of the system in " +
                     std::to_string(options_.part_patience.count() / 1000) + " s";
    if (x.link != LinkState::up)
      result.message += ": " + x.reason;
    result.remedy = "see that the nodes can reach each other where the file says that they are";
    return result;
  }

  /// Introduces all actors to each other. Throws SystemError.
  void join(const ArchitectureDescription& architecture) {
    std::set<std::string> names;
    for_each_component(architecture, [&](auto& x) { names.insert(x.name); });
    std::erase_if(actors_, [&](auto& x) { return names.count(x.first) == 0; });
    std::vector<cast::Diagnostic> problems;
    ask_all<Acknowledged>(JoinParts{actors_}, problems);
    if (!problems.empty())
      throw SystemError{std::move(problems)};
    working_memories_.clear();
    for (auto& x : architecture.subarchitectures)
      working_memories_[x.name] =
        caf::actor_cast<WorkingMemoryActor>(actors_.at(x.working_memory.name));
    for_each_component(architecture, [&](const ComponentDescription& x) {
      if (x.kind != ComponentKind::working_memory)
        components_.try_emplace(
          x.name, Component{caf::actor_cast<caf::actor>(actors_.at(x.name)), x.number});
    });
  }

  /// What could not be added is to be nowhere.
  void take_back(Placement placement) {
    // A host whose process could not be reached gets another one next time.
    std::erase_if(placement.hosts, [&](auto& x) {
      return placement_.hosts.count(x.first) == 0 &&
             (x.second >= processes_.size() || processes_.state(x.second).link == LinkState::lost);
    });
    placement.processes.resize(processes_.size());
    placement_.hosts = std::move(placement.hosts);
    placement_.processes = std::move(placement.processes);
    try {
      apply(architecture_, placement_);
    } catch (const SystemError& e) {
      note(LogLevel::warning, e.what());
    }
  }

  /// What is added for a host whose process is lost, once nothing is left of what it ran, goes to
  /// the process that listens there then.
  void forget_lost_hosts() {
    std::erase_if(placement_.hosts, [&](auto& host) {
      return processes_.state(host.second).link == LinkState::lost &&
             std::none_of(placement_.of.begin(), placement_.of.end(),
                          [&](auto& x) { return x.second == host.second; });
    });
  }

  /// Configures them all, then starts them all, then lets them run; false if interrupted.
  bool start_components(const ArchitectureDescription& x) {
    std::vector<std::string> order;
    auto configure = [&](const ComponentDescription& y) {
      if (y.name.empty())
        return true;
      order.push_back(y.name);
      return enter(Phase::configure, y.name);
    };
    for (auto& subarchitecture : x.subarchitectures) {
      if (!configure(subarchitecture.task_manager))
        return false;
      // Managed components first, then unmanaged ones.
      for (auto kind : {ComponentKind::managed, ComponentKind::unmanaged})
        for (auto& y : subarchitecture.components)
          if (y.kind == kind && !configure(y))
            return false;
    }
    auto first_standalone = order.size();
    for (auto& y : x.standalone)
      if (!configure(y))
        return false;
    // What stands outside the subarchitectures starts first: the others will want to connect to it.
    std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(first_standalone),
                order.end());
    order_.insert(order_.end(), order.begin(), order.end());
    for (auto& name : order)
      if (!enter(Phase::start, name))
        return false;
    for (auto& name : order)
      self_->send(components_.at(name).actor,
                  EnterPhase{Phase::run, caf::actor_cast<caf::actor>(self_)});
    return true;
  }

  // -- while it runs

  void end_asked_for(const EndSystem& x) {
    std::lock_guard guard{mutex_};
    if (!ended_)
      ended_.emplace(x.status, x.reason);
    changed_.notify_all();
  }

  bool is_in_reach(const std::string& component) const {
    return processes_.is_up(placement_.process_of(component));
  }

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

  // -- who looks on

  void make_observer() {
    if (!observer_)
      observer_ = system_.spawn<caf::detached>(observer, std::cref(options_));
  }

  void observe() {
    ObservedSystem observed;
    for (auto& x : architecture_.subarchitectures) {
      WorkingMemoryClass wm_class{x.working_memory};
      if (wm_class.log || wm_class.debug)
        observed.logged[x.name] = wm_class.debug ? LogLevel::trace : LogLevel::debug;
    }
    if (!options_.on_change && observed.logged.empty())
      return;
    make_observer();
    observed.working_memories = working_memories_;
    self_->send(observer_, std::move(observed));
    ask_observer();
    // Its subscriptions are in force once the working memories have answered anything sent after
    // them.
    ask_working_memories();
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
    endpoint_ = open_local_endpoint(system_, options_.endpoint, [this](SystemOrder x) {
      std::lock_guard guard{mutex_};
      orders_.push_back(std::move(x));
      changed_.notify_all();
    });
    tell_endpoint();
  }

  void tell_endpoint() {
    if (!endpoint_)
      return;
    SystemRoster roster;
    roster.file = architecture_.file;
    roster.epoch = epoch_;
    roster.processes = processes_.descriptions();
    for (std::size_t i = 0; i < roster.processes.size(); ++i)
      roster.agents.push_back(processes_.agent(static_cast<ProcessNumber>(i)));
    for (auto& [name, wm] : working_memories_)
      roster.working_memories[name] = wm;
    for_each_component(architecture_,
                       [&](auto& x) { roster.placement[x.name] = placement_.process_of(x.name); });
    caf::anon_send(endpoint_, std::make_shared<const SystemRoster>(std::move(roster)));
  }

  void tell_of_change() {
    observe();
    tell_endpoint();
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
    for (auto& x : architecture_.subarchitectures)
      if (is_in_reach(x.working_memory.name))
        answers.push_back(ask(working_memories_.at(x.name)));
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

  /// By the processes' numbers; nothing of those that do not answer.
  std::vector<std::optional<PartStatus>> ask_parts() {
    auto ask = [&](ProcessNumber i) {
      return self_->request(processes_.agent(i), options_.answer_patience, PartStatusQuery{});
    };
    std::vector<std::optional<PartStatus>> result(processes_.size());
    std::vector<std::pair<std::size_t, decltype(ask(0))>> answers;
    for (std::size_t i = 0; i < result.size(); ++i)
      if (processes_.is_up(static_cast<ProcessNumber>(i)))
        answers.emplace_back(i, ask(static_cast<ProcessNumber>(i)));
    for (auto& [i, answer] : answers)
      answer.receive([&, &to = result[i]](const PartStatus& x) { to = x; },
                     [](const caf::error&) {});
    return result;
  }

  std::vector<ComponentStatus> status() { return status(ask_parts()); }

  /// Of all components, in the order of their start.
  std::vector<ComponentStatus> status(const std::vector<std::optional<PartStatus>>& parts) {
    std::map<std::string, ComponentStatus> found;
    for (auto& part : parts)
      if (part)
        for (auto& x : part->components)
          found[x.identity.name] = x;
    std::vector<ComponentStatus> result;
    for (auto& name : order_.empty() ? names() : order_)
      result.push_back(found.count(name) > 0 ? found[name] : status_of_absent(name));
    return result;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for_each_component(architecture_, [&](const ComponentDescription& x) {
      if (x.kind != ComponentKind::working_memory)
        result.push_back(x.name);
    });
    return result;
  }

  /// Of a component whose node does not answer.
  ComponentStatus status_of_absent(const std::string& name) const {
    auto& x = *architecture_.component(name);
    auto process = processes_.state(placement_.process_of(name));
    ComponentStatus result;
    result.identity = {x.name, x.subarchitecture, x.class_name,
                       static_cast<std::uint32_t>(x.number)};
    result.is_task_manager = x.kind == ComponentKind::task_manager;
    result.state = ComponentState::failed;
    result.out_of_reach = process.link != LinkState::lost;
    result.failure = "its node " + process.description.name + " does not answer";
    if (process.link != LinkState::up)
      result.failure += ": " + process.reason;
    return result;
  }

  static bool somebody_is_busy(const std::vector<ComponentStatus>& components) {
    return std::any_of(components.begin(), components.end(),
                       [](auto& x) { return x.busy > polling; });
  }

  /// Task managers alone do nothing.
  static bool all_failed(const std::vector<ComponentStatus>& components) {
    return std::all_of(components.begin(), components.end(), [](auto& x) {
      return x.is_task_manager || (x.state == ComponentState::failed && !x.out_of_reach);
    });
  }

  // -- the end

  /// In this order.
  void stop_components(const std::vector<std::string>& names) {
    std::string stopped;
    for (auto& name : names) {
      // Of a node that is out of reach, the part ends by itself.
      if (!is_in_reach(name))
        continue;
      if (await_end(components_.at(name).actor)) {
        stopped += (stopped.empty() ? "" : ", ") + name;
      } else {
        stuck_.push_back(name);
        note(LogLevel::error, name + " did not stop: it has not come back from its own code");
      }
    }
    if (!stopped.empty())
      note(LogLevel::info, "stopped, in this order: " + stopped);
  }

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
    caf::anon_send_exit(endpoint_, caf::exit_reason::user_shutdown);
    await_ends(system_, {endpoint_});
    processes_.close("the system has ended");
    caf::anon_send_exit(processes_.agent(0), caf::exit_reason::user_shutdown);
    caf::anon_send_exit(observer_, caf::exit_reason::user_shutdown);
    caf::anon_send_exit(desk_, caf::exit_reason::user_shutdown);
  }

  struct Component {
    caf::actor actor;
    std::size_t number = 0;
    bool failed = false;
  };

  ArchitectureDescription architecture_;
  const SystemOptions options_;
  Placement placement_;
  /// Of the next component that is added.
  std::size_t next_number_ = 0;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::pair<int, std::string>> ended_;
  std::deque<SystemOrder> orders_;

  ActorSystemConfig config_{placement_.processes.size() > 1 || !options_.endpoint.empty()};
  caf::actor_system system_{config_};
  const Clock::time_point epoch_ = Clock::now();
  caf::scoped_actor self_{system_};

  Processes processes_{system_, options_, new_system_name(architecture_)};
  caf::actor desk_;
  caf::actor observer_;
  caf::actor endpoint_;
  /// Of all parts, by the names of the components, working memories included.
  std::map<std::string, caf::strong_actor_ptr> actors_;
  std::map<std::string, WorkingMemoryActor> working_memories_;
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

std::vector<cast::Diagnostic> System::add(ArchitectureDescription added) {
  return implementation_->add(std::move(added));
}

std::string System::remove(const std::string& name) {
  return implementation_->remove(name);
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
