#include "castor/actors/supervision/supervisor.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/supervision/deployment.hpp"
#include "castor/actors/supervision/health_log.hpp"
#include "castor/actors/supervision/round.hpp"
#include "castor/actors/supervision/supervision_tree.hpp"
#include "castor/base/duration.hpp"
#include "castor/base/log.hpp"
#include "castor/base/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <list>
#include <memory>
#include <optional>
#include <utility>

namespace castor {

/// To the supervisor from itself: it is time to look after a round.
struct RoundDue {
  std::uint64_t round = 0;
  /// Which of its steps was meant.
  std::uint64_t step = 0;
};

/// To the supervisor from itself: is that component still without its working memory?
struct OrphanDue {
  std::string name;
  std::uint64_t incarnation = 0;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::RoundDue)
CASTOR_LOCAL_MESSAGE(castor::OrphanDue)

namespace castor {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// How long a component may wait for the news that its working memory has ended, too.
constexpr auto orphan_patience = 1s;
/// How often it is said that a component takes its time.
constexpr auto between_reports = 5s;

struct Child {
  std::size_t number = 0;
  ComponentKind kind = ComponentKind::managed;
  std::string subarchitecture;
  /// How long it may take to stop.
  std::chrono::milliseconds shutdown{5000};
  std::uint64_t incarnation = 1;
  bool alive = true;
  /// It has a process of its own.
  bool isolated = false;
  /// Nobody will start it again.
  bool given_up = false;
  /// Its process was killed because it did not stop.
  bool killed = false;
};

/// What runs in a process that takes the place of a lost one.
struct Awaited {
  std::vector<std::string> names;
  /// What is to be done if the loss was a failure.
  std::optional<SupervisionDecision> decision;
};

class Supervisor : public std::enable_shared_from_this<Supervisor> {
public:
  Supervisor(caf::event_based_actor* self, SupervisorParts parts)
    : self_(self), parts_(std::move(parts)), processes_(*parts_.processes),
      options_(*parts_.options), tree_(parts_.seed ? *parts_.seed : std::random_device{}()),
      deployments_(std::make_shared<Deployments>(self, processes_, options_.part_patience)),
      health_(self, *deployments_, options_) {}

  caf::behavior begin() {
    auto me = shared_from_this();
    return {
      [me](const Deploy& x) { return me->deploy(x); },
      [me](const StartComponents& x) { return me->start(x.names); },
      [me](const StopComponents& x) { return me->stop(x.names); },
      [me](const PhaseDone& x) { me->phase_done(x); },
      [me](const ComponentEnded& x) { me->ended(x); },
      [me](const ComponentHangs& x) { me->end_hanging(x); },
      [me](const InjectComponentFault& x) { me->inject_after_restart(x); },
      [me](const LinkNews& x) { me->on_link_news(x); },
      [me](const RoundDue& x) { me->remind(x); },
      [me](const OrphanDue& x) { me->check_orphan(x); },
    };
  }

private:
  Clock::time_point time() const { return self_->clock().now(); }

  Timestamp now() const { return std::chrono::duration_cast<Timestamp>(time() - parts_.epoch); }

  // -- what the system consists of

  caf::response_promise deploy(const Deploy& x) {
    auto promise = self_->make_response_promise();
    Deployments::Order order;
    order.wait_for_all = true;
    order.plan = [this, x] {
      update_architecture(x.architecture, x.placement);
      return plan();
    };
    order.done = [this, promise](const Deployments::Problems& problems) mutable {
      publish();
      promise.deliver(Deployed{problems});
    };
    deployments_->add(std::move(order));
    return promise;
  }

  void update_architecture(const ArchitectureDescription& architecture,
                           const Placement& placement) {
    // Where something was moved to meanwhile is known better here.
    auto known = std::exchange(placement_, placement);
    for (auto& [host, process] : known.hosts)
      if (auto i = placement_.hosts.find(host); i != placement_.hosts.end()) {
        auto replaced = i->second;
        i->second = process;
        for (auto& [name, of] : placement_.of)
          if (of == replaced)
            of = process;
      }
    for (auto& [name, process] : known.of)
      if (auto i = placement_.of.find(name); i != placement_.of.end())
        i->second = process;
    architecture_ = architecture;
    tree_.set(architecture_, options_.restarts);
    auto children = std::exchange(children_, {});
    for_each_component(architecture_, [&](const ComponentDescription& x) {
      auto& child = children_[x.name];
      if (auto i = children.find(x.name); i != children.end())
        child = i->second;
      child.number = x.number;
      child.kind = x.kind;
      child.subarchitecture = x.subarchitecture;
      child.shutdown = options_.stop_patience;
      child.isolated = x.is_on("isolate");
      if (auto* option = x.option("shutdown"))
        child.shutdown = parse_duration(option->value).value_or(child.shutdown);
    });
    health_.forget_others(architecture_);
  }

  PartPlan plan() const {
    PartPlan result;
    result.system = processes_.name();
    result.architecture = architecture_;
    result.processes = processes_.descriptions();
    result.placement = placement_.of;
    for (auto& [name, child] : children_) {
      if (child.incarnation != 1)
        result.incarnations[name] = child.incarnation;
      if (tree_.restart_type(name) == RestartType::temporary)
        result.temporary.insert(name);
      // It is made in its next life, once that has begun.
      if (moved_.count(name) > 0 || is_awaited(name))
        result.placement[name] = nowhere;
    }
    result.open_access = options_.open_access;
    result.broadcast = options_.broadcast;
    result.coordinator = parts_.end_listener;
    result.supervisor = caf::actor_cast<caf::actor>(self_);
    result.task_observer = parts_.task_observer;
    result.operations = options_.operations.string();
    result.pushes = options_.pushes.string();
    result.pushes_limit = options_.pushes_limit;
    result.age = now();
    result.patience = options_.link.patience;
    return result;
  }

  ProcessNumber process_of(const std::string& name) const { return placement_.process_of(name); }

  ComponentStatus what_is_known_of(const std::string& name) const {
    auto& child = children_.at(name);
    ComponentStatus result;
    result.identity = {name, child.subarchitecture, architecture_.component(name)->class_name,
                       static_cast<std::uint32_t>(child.number), child.incarnation};
    result.is_task_manager = child.kind == ComponentKind::task_manager;
    result.restarts = child.incarnation - 1;
    // If it has ended, of which those who look may know earlier.
    result.will_restart = !child.given_up;
    return result;
  }

  void publish() {
    SystemRoster roster;
    roster.file = parts_.file;
    roster.epoch = parts_.epoch;
    roster.processes = processes_.descriptions();
    for (std::size_t i = 0; i < roster.processes.size(); ++i)
      roster.agents.push_back(processes_.agent(static_cast<ProcessNumber>(i)));
    auto& actors = deployments_->actors();
    for (auto& x : architecture_.subarchitectures)
      if (auto i = actors.find(x.working_memory.name); i != actors.end())
        roster.working_memories[x.name] = caf::actor_cast<WorkingMemoryActor>(i->second);
    if (auto i = actors.find(working_memory_of(health_subarchitecture)); i != actors.end())
      roster.working_memories[health_subarchitecture] =
        caf::actor_cast<WorkingMemoryActor>(i->second);
    for (auto& x : architecture_.standalone)
      if (auto i = actors.find(x.name); i != actors.end())
        roster.providers[x.name] = caf::actor_cast<caf::actor>(i->second);
    for (auto& [name, child] : children_)
      roster.placement[name] = process_of(name);
    for (auto& name : tree_.order())
      if (children_.at(name).kind != ComponentKind::working_memory)
        roster.components.push_back(what_is_known_of(name));
    roster.hosts = placement_;
    parts_.on_change(std::make_shared<const SystemRoster>(std::move(roster)));
  }

  // -- rounds

  caf::response_promise start(const std::vector<std::string>& names) {
    auto promise = self_->make_response_promise();
    Round round;
    for (auto& name : tree_.order())
      if (std::count(names.begin(), names.end(), name) > 0)
        round.start.push_back(name);
    round.done = [promise](const Round& x) mutable {
      promise.deliver(ComponentsStarted{x.problems});
    };
    begin_round(std::move(round));
    return promise;
  }

  caf::response_promise stop(const std::vector<std::string>& names) {
    auto promise = self_->make_response_promise();
    Round round;
    for (auto& name : tree_.order()) {
      auto i = children_.find(name);
      if (i == children_.end() || std::count(names.begin(), names.end(), name) == 0)
        continue;
      round.stop.push_back(name);
      i->second.given_up = true;
    }
    round.done = [promise](const Round& x) mutable {
      promise.deliver(ComponentsStopped{x.stopped, x.stuck});
    };
    // Whoever blocks in configure() or start() is not waited for: it is told to stop.
    for (auto* list : {&rounds_, &waiting_})
      for (auto& x : *list)
        if (!round.includes(x))
          x.withdraw(round.stop);
    begin_round(std::move(round));
    ask_again();
    return promise;
  }

  void begin_round(Round round) {
    round.id = ++last_round_;
    round.since = time();
    // In the reverse order of their start.
    std::reverse(round.stop.begin(), round.stop.end());
    // What others do to the same components need not be done any more.
    std::list<Round> replaced;
    for (auto* list : {&rounds_, &waiting_})
      for (auto i = list->begin(); i != list->end();) {
        auto next = std::next(i);
        if (round.includes(*i))
          replaced.splice(replaced.end(), *list, i);
        i = next;
      }
    for (auto& x : replaced)
      if (x.done)
        x.done(x);
    if (is_in_the_way(round)) {
      waiting_.push_back(std::move(round));
      return;
    }
    rounds_.push_back(std::move(round));
    advance(std::prev(rounds_.end()));
  }

  bool is_in_the_way(const Round& round) const {
    return std::any_of(rounds_.begin(), rounds_.end(), [&](auto& x) { return x.overlaps(round); });
  }

  using RoundIterator = std::list<Round>::iterator;

  RoundIterator find_round(std::uint64_t id) {
    return std::find_if(rounds_.begin(), rounds_.end(), [&](auto& x) { return x.id == id; });
  }

  RoundIterator round_of(const std::string& name) {
    return std::find_if(rounds_.begin(), rounds_.end(), [&](auto& x) { return x.concerns(name); });
  }

  void enter(Round& round, Round::Step step) {
    round.step = step;
    round.at = 0;
    round.asked = nullptr;
    ++round.steps;
    round.since = time();
  }

  /// Does what can be done of a round now.
  void advance(RoundIterator i) {
    auto& round = *i;
    if (round.step == Round::Step::stop) {
      if (!stop_next(round))
        return;
      enter(round, Round::Step::wait);
      if (round.makes && round.delay.count() > 0) {
        remind_later(round, round.delay);
        return;
      }
    }
    if (round.step == Round::Step::wait) {
      enter(round, Round::Step::make);
      if (round.makes) {
        make(round);
        return;
      }
    }
    if (round.step == Round::Step::make)
      begin_to_configure(round);
    if (round.step == Round::Step::configure) {
      if (!enter_next(round, Phase::configure))
        return;
      if (!round.problems.empty()) {
        give_up(i);
        return;
      }
      enter(round, Round::Step::start);
    }
    if (!enter_next(round, Phase::start))
      return;
    for (auto& name : round.start)
      if (takes_part(name))
        send_phase(name, Phase::run);
    end_round(i);
  }

  /// Stops one after the other; true when the last one has ended.
  bool stop_next(Round& round) {
    for (; round.at < round.stop.size(); ++round.at, ++round.steps, round.since = time()) {
      auto& name = round.stop[round.at];
      auto i = children_.find(name);
      // Working memories end where they are made anew. Of a node that is out of reach, the part
      // ends by itself.
      if (i == children_.end() || !i->second.alive ||
          i->second.kind == ComponentKind::working_memory || !processes_.is_up(process_of(name)))
        continue;
      auto patience = i->second.shutdown;
      if (options_.interrupted && options_.interrupted())
        patience = std::min<std::chrono::milliseconds>(patience, 1s);
      if (time() - round.since >= patience && kill_to_stop(round, name))
        return false;
      if (time() - round.since >= patience) {
        log_runtime(LogLevel::error, name, "did not stop: it has not come back from its own code");
        round.stuck.push_back(name);
        std::erase(round.start, name);
        i->second.given_up = true;
        if (round.makes)
          note_down(name, "it did not stop, and is not started again", false);
        continue;
      }
      if (auto actor = actor_of(name))
        self_->send_exit(actor, caf::exit_reason::user_shutdown);
      remind_later(round, std::min<Timestamp>(patience, 250ms));
      return false;
    }
    return true;
  }

  /// Ends the process of an isolated component that does not stop. False if it has none, or was not
  /// ended by that either.
  bool kill_to_stop(Round& round, const std::string& name) {
    auto& child = children_.at(name);
    if (child.killed || !has_own_process(child) ||
        !options_.kill_child(architecture_.component(name)->host, Clock::now()))
      return false;
    log_runtime(LogLevel::error, name,
                "did not stop: it has not come back from its own code; its process is killed");
    child.killed = true;
    if (!round.makes)
      round.stuck.push_back(name);
    round.since = time();
    remind_later(round, 100ms);
    return true;
  }

  /// Makes anew what the round starts.
  void make(Round& round) {
    bool others_know = false;
    for (auto& name : round.start) {
      auto& child = children_.at(name);
      ++child.incarnation;
      bool moves = moved_.erase(name) > 0;
      others_know = others_know || moves || child.kind == ComponentKind::working_memory ||
                    child.kind == ComponentKind::task_manager ||
                    child.kind == ComponentKind::standalone;
    }
    if (others_know)
      make_by_plan(round);
    else
      make_one_by_one(round);
  }

  void make_by_plan(Round& round) {
    Deployments::Order order;
    order.plan = [this] { return plan(); };
    order.done = [this, id = round.id](const Deployments::Problems& problems) {
      if (!problems.empty())
        log_runtime(LogLevel::error, "supervisor", render(problems));
      auto i = find_round(id);
      if (i != rounds_.end())
        made(i, problems.empty() ? Names{} : Names{i->start.begin(), i->start.end()});
    };
    deployments_->add(std::move(order));
  }

  void make_one_by_one(Round& round) {
    auto missing = std::make_shared<std::size_t>(round.start.size());
    auto failed = std::make_shared<Names>();
    auto answered = [this, missing, failed, id = round.id] {
      if (--*missing > 0)
        return;
      if (auto i = find_round(id); i != rounds_.end())
        made(i, *failed);
    };
    for (auto& name : round.start)
      self_
        ->request(processes_.agent(process_of(name)), options_.part_patience,
                  RestartComponent{name, children_.at(name).incarnation})
        .then(
          [this, name, failed, answered](const PartMade& x) {
            if (auto actor = x.actors.find(name); actor != x.actors.end())
              deployments_->set_actor(name, actor->second);
            else
              failed->insert(name);
            answered();
          },
          [name, failed, answered](const caf::error&) {
            failed->insert(name);
            answered();
          });
  }

  /// Those of the round are there, but for those that `failed`.
  void made(RoundIterator i, const Names& failed) {
    for (auto& name : i->start) {
      auto& child = children_.at(name);
      // What becomes of those whose process is lost was decided when that was known, and another
      // round brings them back.
      bool gone = i->gone.count(name) > 0 || moved_.count(name) > 0 || is_awaited(name);
      bool ended = std::any_of(i->failures.begin(), i->failures.end(), [&](auto& x) {
        return x.name == name && x.incarnation == child.incarnation;
      });
      child.alive = !gone && !ended && failed.count(name) == 0;
      if (!gone && !ended && !child.alive)
        i->failures.push_back(
          {name, child.incarnation, ComponentEnded::How::failed, "it could not be made anew"});
    }
    begin_to_configure(*i);
    advance(i);
  }

  /// Some cannot be configured, and would not be next time: nobody is started.
  void give_up(RoundIterator i) {
    for (auto& name : i->start)
      if (auto child = children_.find(name); child != children_.end())
        child->second.given_up = true;
    end_round(i);
  }

  void begin_to_configure(Round& round) {
    enter(round, Round::Step::configure);
    round.withdraw({round.withdrawn.begin(), round.withdrawn.end()});
    round.configure = round.start;
    std::stable_partition(round.configure.begin(), round.configure.end(), [&](auto& x) {
      return children_.at(x).kind != ComponentKind::standalone;
    });
  }

  /// Whether there is somebody with phases of life.
  bool takes_part(const std::string& name) const {
    auto i = children_.find(name);
    return i != children_.end() && i->second.alive &&
           i->second.kind != ComponentKind::working_memory;
  }

  /// Lets one after the other go through a phase; true when the last one has.
  bool enter_next(Round& round, Phase phase) {
    for (auto& order = round.order(); round.at < order.size(); go_to_next(round)) {
      auto& name = order[round.at];
      if (!takes_part(name))
        continue;
      auto actor = actor_of(name);
      if (!actor || round.asked == actor.address())
        return false;
      bool is_first = !std::exchange(round.asked, actor.address());
      send_phase(name, phase);
      if (is_first)
        remind_later(round, between_reports);
      return false;
    }
    return true;
  }

  /// Goes on with rounds that may have waited for somebody who is known now, or who does not count
  /// any more.
  void ask_again() {
    std::vector<std::uint64_t> ids;
    for (auto& round : rounds_)
      if (round.step == Round::Step::configure || round.step == Round::Step::start)
        ids.push_back(round.id);
    for (auto id : ids)
      if (auto i = find_round(id); i != rounds_.end())
        advance(i);
  }

  static void go_to_next(Round& round) {
    round.asked = nullptr;
    ++round.at;
    ++round.steps;
  }

  void phase_done(const PhaseDone& x) {
    for (auto i = rounds_.begin(); i != rounds_.end(); ++i) {
      auto step = x.phase == Phase::configure ? Round::Step::configure : Round::Step::start;
      if (i->step != step || i->at >= i->order().size())
        continue;
      auto child = children_.find(i->order()[i->at]);
      if (child == children_.end() || child->second.number != x.component)
        continue;
      if (!x.failure.empty()) {
        // What it could do once, another life can do again; supervision goes on once it has ended.
        if (!i->makes)
          i->problems.push_back(wrong_configuration(child->first, x.failure));
        return;
      }
      if (x.phase == Phase::start)
        note_up(child->first);
      go_to_next(*i);
      advance(i);
      return;
    }
  }

  /// At the component's line.
  Diagnostic wrong_configuration(const std::string& name, const std::string& what) const {
    Diagnostic result;
    result.message = name + " cannot be configured: " + on_one_line(what);
    if (auto* x = architecture_.component(name)) {
      result.where = x->where;
      result.line = x->line;
    }
    return result;
  }

  void end_round(RoundIterator i) {
    auto round = std::move(*i);
    rounds_.erase(i);
    for (auto& name : round.start)
      if (auto child = children_.find(name); child != children_.end() && child->second.alive &&
                                             child->second.kind == ComponentKind::working_memory)
        note_up(name);
    publish();
    if (round.done)
      round.done(round);
    for (auto& x : round.failures)
      deal_with(x);
    begin_waiting();
  }

  void begin_waiting() {
    // What begins may end at once, and change both lists.
    for (;;) {
      auto next =
        std::find_if(waiting_.begin(), waiting_.end(), [&](auto& x) { return !is_in_the_way(x); });
      if (next == waiting_.end())
        return;
      rounds_.splice(rounds_.end(), waiting_, next);
      auto begun = std::prev(rounds_.end());
      begun->since = time();
      // Some may have come back while it waited.
      if (begun->makes)
        note_stops(*begun);
      advance(begun);
    }
  }

  void remind_later(const Round& round, Timestamp delay) {
    self_->delayed_send(self_, delay, RoundDue{round.id, round.steps});
  }

  void remind(const RoundDue& x) {
    auto i = find_round(x.round);
    if (i == rounds_.end() || i->steps != x.step)
      return;
    if (i->step == Round::Step::configure || i->step == Round::Step::start) {
      log_runtime(LogLevel::info, "supervisor",
                  fmt::format("waiting for {} to {}", i->order()[i->at],
                              i->step == Round::Step::configure ? "configure" : "start"));
      remind_later(*i, between_reports);
      return;
    }
    advance(i);
  }

  caf::actor actor_of(const std::string& name) const {
    auto i = deployments_->actors().find(name);
    return i == deployments_->actors().end() ? nullptr : caf::actor_cast<caf::actor>(i->second);
  }

  void inject_after_restart(const InjectComponentFault& x) {
    auto phase =
      x.fault.kind == ComponentFault::Kind::blocked_configure ? Phase::configure : Phase::start;
    next_life_faults_[{x.name, phase}] = x.fault;
  }

  void send_phase(const std::string& name, Phase phase) {
    auto actor = actor_of(name);
    if (!actor)
      return;
    if (auto fault = next_life_faults_.extract({name, phase}))
      self_->send(actor, fault.mapped());
    self_->send(actor, EnterPhase{phase, caf::actor_cast<caf::actor>(self_)});
  }

  // -- failures

  void ended(const ComponentEnded& x) {
    auto i = children_.find(x.name);
    if (i == children_.end() || i->second.incarnation != x.incarnation)
      return;
    auto round = round_of(x.name);
    if (!std::exchange(i->second.alive, false)) {
      // It has ended before we heard that it was made.
      if (round != rounds_.end() && round->step == Round::Step::make)
        round->failures.push_back(x);
      return;
    }
    if (round == rounds_.end()) {
      if (!i->second.given_up)
        deal_with(x);
      return;
    }
    if (round->step == Round::Step::stop) {
      round->stopped.push_back(x.name);
      advance(round);
      return;
    }
    round->failures.push_back(x);
    if ((round->step == Round::Step::configure || round->step == Round::Step::start) &&
        round->at < round->order().size() && round->order()[round->at] == x.name) {
      go_to_next(*round);
      advance(round);
    }
  }

  /// A child has ended, and no round has to do with that.
  void deal_with(const ComponentEnded& x) {
    auto i = children_.find(x.name);
    if (i == children_.end() || i->second.incarnation != x.incarnation || i->second.alive ||
        i->second.given_up || round_of(x.name) != rounds_.end() ||
        std::any_of(waiting_.begin(), waiting_.end(), [&](auto& y) { return y.concerns(x.name); }))
      return;
    auto& child = i->second;
    if (x.how == ComponentEnded::How::orphaned) {
      // It is started again with its working memory, of whose end we have heard or will.
      self_->delayed_send(self_, orphan_patience, OrphanDue{x.name, x.incarnation});
      return;
    }
    auto decision = x.how == ComponentEnded::How::stopped ? tree_.ended(x.name, now())
                    : is_coming_back(x.waited_for)        ? tree_.failed_without(x.name, now())
                                                          : tree_.failed(x.name, now());
    auto reason = x.how == ComponentEnded::How::stopped ? "ended with its work done" : x.failure;
    switch (decision.kind) {
      case SupervisionDecision::Kind::leave:
        child.given_up = true;
        note_failure(x, reason, false);
        publish();
        return;
      case SupervisionDecision::Kind::give_up:
        end_system(decision, x.name, reason);
        return;
      case SupervisionDecision::Kind::restart:
        note_failure(x, reason, true);
        restart(decision, x.name);
        return;
    }
  }

  /// Whether somebody is there, or will be: whoever waits for one that will not be has failed.
  bool is_coming_back(const std::string& name) const {
    auto i = children_.find(name);
    return i != children_.end() && !i->second.given_up;
  }

  /// It has gone too far.
  void end_system(const SupervisionDecision& decision, const std::string& name,
                  const std::string& reason) {
    note_down(name, reason, false);
    caf::anon_send(parts_.end_listener,
                   EndSystem{1, "the supervisor: " + decision.reason + "; " + name + ' ' + reason});
  }

  /// The watchdog has found one that does not come back. Only a process of its own can be ended.
  void end_hanging(const ComponentHangs& x) {
    auto i = children_.find(x.name);
    if (i == children_.end() || i->second.incarnation != x.incarnation || i->second.given_up ||
        !has_own_process(i->second))
      return;
    log_runtime(LogLevel::warning, x.name, "hangs; its process is killed");
    options_.kill_child(architecture_.component(x.name)->host, Clock::now());
  }

  void check_orphan(const OrphanDue& x) {
    // Its working memory still is there, so it has failed as anybody may.
    auto i = children_.find(x.name);
    if (i == children_.end())
      return;
    auto wm = children_.find(working_memory_of(i->second.subarchitecture));
    if (wm != children_.end() && wm->second.alive)
      deal_with({x.name, x.incarnation, ComponentEnded::How::failed,
                 "its working memory could not be reached"});
  }

  void restart(const SupervisionDecision& decision, const std::string& name) {
    if (!decision.escalated.empty())
      log_runtime(LogLevel::error, "supervisor",
                  fmt::format("{} fails as a whole and is started again: {}", decision.escalated,
                              decision.reason));
    Round round;
    round.makes = true;
    round.delay = decision.delay;
    auto is_here = [&](const std::string& x) {
      auto i = children_.find(x);
      return i != children_.end() && (!i->second.given_up || !decision.escalated.empty()) &&
             !is_awaited(x) && processes_.state(process_of(x)).link != LinkState::lost;
    };
    std::copy_if(decision.stop.begin(), decision.stop.end(), std::back_inserter(round.stop),
                 is_here);
    std::copy_if(decision.start.begin(), decision.start.end(), std::back_inserter(round.start),
                 is_here);
    for (auto& x : round.start)
      children_.at(x).given_up = false;
    round.reason = "it is started again because of " + name;
    note_stops(round);
    publish();
    begin_round(std::move(round));
  }

  // -- what is made known

  HealthLog::Subject subject(const std::string& name) const {
    auto& child = children_.at(name);
    return {name, child.subarchitecture, child.incarnation, false};
  }

  void note_down(const std::string& name, const std::string& reason, bool will_restart) {
    health_.down(subject(name), reason, will_restart);
  }

  /// Of one that has failed in its own code, which it has logged where it ran.
  void note_failure(const ComponentEnded& x, const std::string& reason, bool will_restart) {
    auto who = subject(x.name);
    who.reports_itself = x.how == ComponentEnded::How::failed && process_of(x.name) == 0 &&
                         children_.at(x.name).kind != ComponentKind::working_memory;
    health_.down(who, reason, will_restart);
  }

  void note_stops(const Round& round) {
    for (auto& name : round.stop)
      if (children_.count(name) > 0)
        note_down(name, round.reason, true);
  }

  void note_up(const std::string& name) { health_.up(subject(name)); }

  // -- processes

  /// These are to run in other processes from now on, which takes others with it.
  void move(const std::vector<std::string>& names, const std::string& why) {
    SupervisionDecision decision{SupervisionDecision::Kind::restart};
    decision.stop = tree_.with_dependents(names);
    std::copy_if(decision.stop.begin(), decision.stop.end(), std::back_inserter(decision.start),
                 [&](auto& x) {
                   auto restart = tree_.restart_type(x) != RestartType::temporary;
                   return restart || std::count(names.begin(), names.end(), x) > 0;
                 });
    moved_.insert(names.begin(), names.end());
    restart(decision, why);
  }

  void bring_back(const Awaited& x) {
    if (!x.decision)
      return move(x.names, "the return of its node");
    moved_.insert(x.names.begin(), x.names.end());
    restart(*x.decision, x.names.front());
  }

  /// Whether it is made when a process has taken the place of its own, and not before.
  bool is_awaited(const std::string& name) const {
    return std::any_of(awaited_.begin(), awaited_.end(),
                       [&](auto& x) { return std::ranges::count(x.second.names, name) > 0; });
  }

  bool has_own_process(const Child& x) const { return x.isolated && options_.kill_child; }

  /// A process that this one has started, and that is lost though it has not ended: it is stopped,
  /// or has no connections any more. Another one will take its place.
  void end_lost_child(ProcessNumber lost) {
    if (!options_.kill_child)
      return;
    for (auto& [host, process] : placement_.hosts)
      if (process == lost && options_.kill_child(host, processes_.last_up(lost)))
        log_runtime(LogLevel::warning, processes_.state(lost).description.name,
                    "does not answer; its process is killed");
  }

  /// Another process where a component may run, if its own is lost.
  std::optional<ProcessNumber> refuge_of(const std::string& name) const {
    auto* x = architecture_.component(name);
    if (!x)
      return std::nullopt;
    if (x->kind == ComponentKind::working_memory && !WorkingMemoryClass{*x}.outlives_its_node())
      return std::nullopt;
    for (auto& host : architecture_.failover_of(*x)) {
      auto i = placement_.hosts.find(host);
      auto process = i == placement_.hosts.end() ? ProcessNumber{0} : i->second;
      if (processes_.is_up(process))
        return process;
    }
    return std::nullopt;
  }

  /// Whether something may have to go there.
  bool is_refuge(ProcessNumber x) const {
    for (auto& rule : architecture_.failover)
      for (auto& host : rule.hosts)
        if (auto i = placement_.hosts.find(host); i != placement_.hosts.end() && i->second == x)
          return true;
    return false;
  }

  void lose(ProcessNumber lost, const std::string& why) {
    awaited_.erase(lost);
    end_lost_child(lost);
    std::vector<std::string> moving;
    Awaited staying;
    for (auto& name : tree_.order()) {
      auto& child = children_.at(name);
      if (child.given_up || process_of(name) != lost)
        continue;
      auto reason = "its node " + processes_.state(lost).description.name + " is lost: " + why;
      auto was_alive = std::exchange(child.alive, false);
      // One that was killed because it did not stop goes on as one that has stopped.
      auto was_killed = std::exchange(child.killed, false);
      child.given_up = !was_killed && tree_.restart_type(name) == RestartType::temporary;
      // The loss of a node is nobody's failure, but that of a component's own process is.
      if (was_alive && !was_killed && !child.given_up && has_own_process(child)) {
        staying.decision = tree_.failed(name, now());
        child.given_up = staying.decision->kind == SupervisionDecision::Kind::give_up;
        if (child.given_up) {
          end_system(*staying.decision, name, reason);
          continue;
        }
      }
      note_down(name, reason, !child.given_up);
      if (child.given_up)
        continue;
      if (auto round = round_of(name); round != rounds_.end())
        round->gone.insert(name);
      if (auto refuge = refuge_of(name)) {
        placement_.of[name] = *refuge;
        moving.push_back(name);
      } else {
        staying.names.push_back(name);
      }
    }
    if (!staying.names.empty() || is_refuge(lost)) {
      auto successor = processes_.look_for_successor(lost);
      for (auto& [host, process] : placement_.hosts)
        if (process == lost)
          process = successor;
      for (auto& name : staying.names)
        placement_.of[name] = successor;
      if (!staying.names.empty())
        awaited_[successor] = std::move(staying);
    }
    // Those who are waited for in vain.
    std::vector<std::uint64_t> ids;
    for (auto& round : rounds_)
      ids.push_back(round.id);
    for (auto id : ids)
      if (auto i = find_round(id);
          i != rounds_.end() && i->step != Round::Step::wait && i->step != Round::Step::make)
        advance(i);
    publish();
    if (!moving.empty())
      move(moving, "the loss of its node");
  }

  void on_link_news(const LinkNews& x) {
    if (x.state == LinkState::lost)
      lose(x.peer, x.reason);
    if (x.state == LinkState::up)
      if (auto awaited = awaited_.extract(x.peer)) {
        log_runtime(LogLevel::info, "supervisor", "node " + x.name + " was started again");
        bring_back(awaited.mapped());
      }
    // Who was out of reach has missed something; the others do not know yet who is lost.
    if (deployments_->look_again() || x.state == LinkState::lost)
      tell_plan();
  }

  /// The others are to know how things stand.
  void tell_plan() {
    Deployments::Order order;
    order.plan = [this] { return plan(); };
    order.done = [this](const Deployments::Problems&) {
      publish();
      ask_again();
    };
    deployments_->add(std::move(order));
  }

  caf::event_based_actor* self_;
  const SupervisorParts parts_;
  Processes& processes_;
  const SystemOptions& options_;
  ArchitectureDescription architecture_;
  Placement placement_;
  SupervisionTree tree_;
  std::shared_ptr<Deployments> deployments_;
  HealthLog health_;
  std::map<std::string, Child> children_;
  std::list<Round> rounds_;
  /// Those that have to wait for others.
  std::list<Round> waiting_;
  std::uint64_t last_round_ = 0;
  /// Faults to inject into components when they are configured or started next.
  std::map<std::pair<std::string, Phase>, ComponentFault> next_life_faults_;
  /// What changes its process.
  Names moved_;
  /// Processes that are to take the places of lost ones, and what will run there.
  std::map<ProcessNumber, Awaited> awaited_;
};

} // namespace

caf::behavior supervisor(caf::event_based_actor* self, SupervisorParts parts) {
  return std::make_shared<Supervisor>(self, std::move(parts))->begin();
}

} // namespace castor
