#include "castor/actors/supervision/transition_scheduler.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor {

namespace {

using namespace std::chrono_literals;
using Step = Transition::Step;

/// How often it is reported that a child takes its time.
constexpr auto between_reports = 5s;
/// How long a child may take to stop once the system is interrupted.
constexpr std::chrono::milliseconds interrupted_patience = 1s;
/// How often the end of a child is asked for.
constexpr auto between_stops = 250ms;
/// How long a killed process may take until it is looked for again.
constexpr auto after_kill = 100ms;

} // namespace

void TransitionScheduler::begin(TransitionRequest request) {
  Transition x{++last_id_, std::move(request), driver_.now()};
  // What others do to the same children need not be done any more.
  std::list<Transition> replaced;
  for (auto* list : {&running_, &waiting_})
    for (auto i = list->begin(); i != list->end();) {
      auto next = std::next(i);
      if (x.includes(*i))
        replaced.splice(replaced.end(), *list, i);
      i = next;
    }
  for (auto& y : replaced)
    y.report_done();
  if (must_wait(x)) {
    waiting_.push_back(std::move(x));
    return;
  }
  running_.push_back(std::move(x));
  advance(std::prev(running_.end()));
}

void TransitionScheduler::stop(TransitionRequest request) {
  for (auto& name : request.stop)
    model_.set_given_up(name, true);
  Transition stopping{0, request, driver_.now()};
  for (auto* list : {&running_, &waiting_})
    for (auto& x : *list)
      if (!stopping.includes(x))
        x.withdraw(request.stop);
  begin(std::move(request));
  resume();
}

TransitionScheduler::Iterator TransitionScheduler::find(std::uint64_t id) {
  return std::find_if(running_.begin(), running_.end(), [&](auto& x) { return x.id() == id; });
}

TransitionScheduler::Iterator TransitionScheduler::running_with(const std::string& child) {
  return std::find_if(running_.begin(), running_.end(), [&](auto& x) { return x.involves(child); });
}

bool TransitionScheduler::is_scheduled(const std::string& child) const {
  auto involves_it = [&](auto& x) { return x.involves(child); };
  return std::any_of(running_.begin(), running_.end(), involves_it) ||
         std::any_of(waiting_.begin(), waiting_.end(), involves_it);
}

bool TransitionScheduler::must_wait(const Transition& x) const {
  return std::any_of(running_.begin(), running_.end(), [&](auto& y) { return y.overlaps(x); });
}

void TransitionScheduler::begin_waiting() {
  // What begins may end at once, and change both lists.
  for (;;) {
    auto next =
      std::find_if(waiting_.begin(), waiting_.end(), [&](auto& x) { return !must_wait(x); });
    if (next == waiting_.end())
      return;
    running_.splice(running_.end(), waiting_, next);
    auto begun = std::prev(running_.end());
    begun->restart_turn(driver_.now());
    // Some may have come back while it waited.
    if (begun->remakes())
      for (auto& name : begun->stop())
        if (model_.find(name))
          observer_.on_down(name, begun->reason());
    advance(begun);
  }
}

void TransitionScheduler::advance(Iterator i) {
  auto& x = *i;
  if (x.step() == Step::stop) {
    if (!stop_next(x))
      return;
    x.enter(Step::wait, driver_.now());
    if (x.remakes() && x.delay().count() > 0) {
      driver_.delay({x.id(), x.turn()}, x.delay());
      return;
    }
  }
  if (x.step() == Step::wait) {
    x.enter(Step::make, driver_.now());
    // Those that it was to start may have been withdrawn.
    if (x.remakes() && !x.start().empty()) {
      make(x);
      return;
    }
  }
  if (x.step() == Step::make)
    enter_configure(x);
  if (x.step() == Step::configure) {
    if (!enter_next(x, Phase::configure))
      return;
    if (x.has_problems()) {
      // They could not be configured next time either.
      for (auto& name : x.start())
        if (model_.find(name))
          model_.set_given_up(name, true);
      end(i);
      return;
    }
    x.enter(Step::start, driver_.now());
  }
  if (!enter_next(x, Phase::start))
    return;
  for (auto& name : x.start())
    if (takes_part(name) && driver_.has_actor(name))
      driver_.enter(name, Phase::run);
  end(i);
}

void TransitionScheduler::end(Iterator i) {
  auto x = std::move(*i);
  running_.erase(i);
  for (auto& name : x.start())
    if (auto* child = model_.find(name);
        child && child->alive && child->kind == ComponentKind::working_memory)
      observer_.on_up(name);
  observer_.on_change();
  x.report_done();
  for (auto& failure : x.failures())
    observer_.on_failure(failure);
  begin_waiting();
}

bool TransitionScheduler::stop_next(Transition& x) {
  for (; auto* name = x.current(); x.next(driver_.now())) {
    auto* child = model_.find(*name);
    // Working memories end where they are made anew. Of a node that is out of reach, the part
    // ends by itself.
    if (!child || !child->alive || child->kind == ComponentKind::working_memory ||
        !driver_.is_reachable(*name))
      continue;
    auto patience = child->shutdown;
    if (driver_.is_interrupted())
      patience = std::min(patience, interrupted_patience);
    if (driver_.now() - x.since() >= patience && kill_to_stop(x, *name))
      return false;
    if (driver_.now() - x.since() >= patience) {
      x.add_stuck(*name);
      x.do_not_start(*name);
      model_.set_given_up(*name, true);
      observer_.on_stuck(*name, x.remakes());
      continue;
    }
    driver_.stop(*name);
    remind_later(x, std::min<Timestamp>(patience, between_stops));
    return false;
  }
  return true;
}

bool TransitionScheduler::kill_to_stop(Transition& x, const std::string& child) {
  if (model_.child(child).killed || !driver_.kill(child))
    return false;
  model_.set_killed(child, true);
  if (!x.remakes())
    x.add_stuck(child);
  x.restart_turn(driver_.now());
  remind_later(x, after_kill);
  return true;
}

void TransitionScheduler::make(Transition& x) {
  bool others_know = false;
  for (auto& name : x.start()) {
    model_.begin_life(name);
    bool moves = failover_.end_move(name);
    auto kind = model_.child(name).kind;
    others_know = others_know || moves || kind == ComponentKind::working_memory ||
                  kind == ComponentKind::task_manager || kind == ComponentKind::standalone;
  }
  driver_.make(x.start(), others_know,
               [this, id = x.id()](const std::set<std::string>& failed) { made(id, failed); });
}

void TransitionScheduler::made(std::uint64_t transition, const std::set<std::string>& failed) {
  auto i = find(transition);
  if (i == running_.end())
    return;
  for (auto& name : i->start()) {
    auto incarnation = model_.child(name).incarnation;
    // What becomes of those whose process is lost was decided when that was known, and another
    // transition brings them back.
    bool lost = i->is_lost(name) || failover_.is_between_processes(name);
    bool ended = i->has_failed(name, incarnation);
    bool alive = !lost && !ended && failed.count(name) == 0;
    model_.set_alive(name, alive);
    if (!lost && !ended && !alive)
      i->add_failure({name, incarnation, ComponentEnded::How::failed, "it could not be made anew"});
  }
  enter_configure(*i);
  advance(i);
}

void TransitionScheduler::enter_configure(Transition& x) {
  x.enter_configure(driver_.now(), [&](const std::string& name) {
    return model_.child(name).kind == ComponentKind::standalone;
  });
}

bool TransitionScheduler::takes_part(const std::string& child) const {
  auto* x = model_.find(child);
  return x && x->alive && x->kind != ComponentKind::working_memory;
}

bool TransitionScheduler::enter_next(Transition& x, Phase phase) {
  for (; auto* name = x.current(); x.next(driver_.now())) {
    if (!takes_part(*name))
      continue;
    if (!driver_.has_actor(*name) || (x.is_commanded() && !driver_.is_replaced(*name)))
      return false;
    bool is_first = !x.is_commanded();
    x.set_commanded();
    driver_.enter(*name, phase);
    if (is_first)
      remind_later(x, between_reports);
    return false;
  }
  return true;
}

void TransitionScheduler::resume() {
  std::vector<std::uint64_t> ids;
  for (auto& x : running_)
    if (x.leads_through_phases())
      ids.push_back(x.id());
  for (auto id : ids)
    if (auto i = find(id); i != running_.end())
      advance(i);
}

void TransitionScheduler::remind_later(const Transition& x, Timestamp delay) {
  driver_.remind({x.id(), x.turn()}, delay);
}

void TransitionScheduler::remind(const TransitionReminder& x) {
  auto i = find(x.transition);
  if (i == running_.end() || i->turn() != x.turn)
    return;
  if (i->leads_through_phases()) {
    observer_.on_slow(*i->current(),
                      i->step() == Step::configure ? Phase::configure : Phase::start);
    remind_later(*i, between_reports);
    return;
  }
  advance(i);
}

void TransitionScheduler::phase_done(const PhaseDone& x) {
  auto step = x.phase == Phase::configure ? Step::configure : Step::start;
  for (auto i = running_.begin(); i != running_.end(); ++i) {
    if (i->step() != step || !i->current())
      continue;
    auto name = *i->current();
    auto* child = model_.find(name);
    if (!child || child->number != x.component)
      continue;
    if (!x.failure.empty()) {
      // What it could do once, another life can do again; supervision goes on once it has ended.
      if (!i->remakes())
        i->add_problem(wrong_configuration(name, x.failure));
      return;
    }
    if (x.phase == Phase::start)
      observer_.on_up(name);
    i->next(driver_.now());
    advance(i);
    return;
  }
}

Diagnostic TransitionScheduler::wrong_configuration(const std::string& child,
                                                    const std::string& what) const {
  Diagnostic result;
  result.message = child + " cannot be configured: " + on_one_line(what);
  if (auto* x = model_.architecture().component(child)) {
    result.where = x->where;
    result.line = x->line;
  }
  return result;
}

bool TransitionScheduler::ended(const ComponentEnded& x, bool was_alive) {
  auto i = running_with(x.name);
  if (i == running_.end())
    return false;
  if (!was_alive) {
    // It has ended before we heard that it was made.
    if (i->step() == Step::make)
      i->add_failure(x);
    return true;
  }
  if (i->step() == Step::stop) {
    i->add_stopped(x.name);
    advance(i);
    return true;
  }
  i->add_failure(x);
  if (auto* current = i->current(); i->leads_through_phases() && current && *current == x.name) {
    i->next(driver_.now());
    advance(i);
  }
  return true;
}

void TransitionScheduler::lose(const std::vector<std::string>& children) {
  for (auto& name : children)
    if (auto i = running_with(name); i != running_.end())
      i->add_lost(name);
  // Those that wait in vain.
  std::vector<std::uint64_t> ids;
  for (auto& x : running_)
    ids.push_back(x.id());
  for (auto id : ids)
    if (auto i = find(id);
        i != running_.end() && i->step() != Step::wait && i->step() != Step::make)
      advance(i);
}

} // namespace castor
