#include "castor/actors/task_manager/task_schedule.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using rc::gen::element;

struct Step {
  enum { propose, succeed, fail, retract } kind = propose;
  TaskId id;
  TaskOptions options;
};

std::ostream& operator<<(std::ostream& out, const Step& x) {
  static constexpr const char* names[] = {"propose ", "succeed ", "fail ", "retract "};
  out << names[x.kind] << x.id;
  if (x.kind != Step::propose)
    return out;
  out << " priority " << x.options.priority << " cost " << x.options.cost << " after";
  for (auto& y : x.options.after)
    out << ' ' << y;
  return out;
}

rc::Gen<TaskId> any_id() {
  return element<TaskId>("a", "b", "c", "d", "e", "f", "g", "h");
}

rc::Gen<std::vector<Step>> any_steps() {
  auto options = rc::gen::build<TaskOptions>(
    rc::gen::set(&TaskOptions::priority, element(0, 0, 0, 1, 2, -1)),
    rc::gen::set(&TaskOptions::cost, element(0.0, 0.5, 1.0, 1.0, 1.0, 2.0, 3.0, -1.0)),
    rc::gen::set(&TaskOptions::after,
                 rc::gen::resize(2, rc::gen::container<std::vector<TaskId>>(any_id()))));
  auto step = rc::gen::build<Step>(
    rc::gen::set(&Step::kind, element(Step::propose, Step::propose, Step::propose, Step::succeed,
                                      Step::succeed, Step::fail, Step::retract)),
    rc::gen::set(&Step::id, any_id()), rc::gen::set(&Step::options, options));
  return rc::gen::scale(3.0, rc::gen::container<std::vector<Step>>(step));
}

/// What a schedule promises, in the plainest terms: all that was ever proposed lies in one list,
/// and every question is answered by searching it.
class Model {
public:
  enum class State { waiting, running, succeeded, lost };

  struct Task {
    TaskId id;
    TaskOptions options;
    State state = State::waiting;
  };

  explicit Model(TaskSchedule::Rules rules) : rules_(rules) {}

  void apply(const Step& step) {
    adopted.clear();
    if (auto* old = live(step.id))
      old->state = step.kind == Step::succeed ? State::succeeded : State::lost;
    else if (step.kind != Step::propose)
      return;
    // Those that come after the former task of this id are settled before the new one is there.
    settle();
    if (step.kind == Step::propose) {
      tasks_.push_back({step.id, step.options});
      auto& added = tasks_.back();
      if (added.options.cost < 0 || added.options.cost > rules_.budget ||
          waits_for(added, added.id))
        added.state = State::lost;
    }
    settle();
    adopt();
  }

  double used() const {
    double result = 0;
    for (auto& x : tasks_)
      if (x.state == State::running)
        result += x.options.cost;
    return result;
  }

  /// The newest task of that id.
  const Task* find(const TaskId& id) const {
    for (auto i = tasks_.rbegin(); i != tasks_.rend(); ++i)
      if (i->id == id)
        return &*i;
    return nullptr;
  }

  static bool ready(const Task& x) { return x.state == State::waiting && x.options.after.empty(); }

  const std::vector<Task>& tasks() const { return tasks_; }

  /// In the last step, in their order.
  std::vector<TaskId> adopted;

private:
  Task* live(const TaskId& id) {
    for (auto& x : tasks_)
      if (x.id == id && (x.state == State::waiting || x.state == State::running))
        return &x;
    return nullptr;
  }

  bool waits_for(const Task& x, const TaskId& id, int depth = 0) const {
    if (depth > 10)
      return false; // There are eight ids: longer chains go in circles that do not lead to `id`.
    return std::any_of(x.options.after.begin(), x.options.after.end(), [&](auto& y) {
      auto* other = find(y);
      return y == id ||
             (other && other->state == State::waiting && waits_for(*other, id, depth + 1));
    });
  }

  /// Forgets predecessors that have succeeded, and rejects what comes after lost ones.
  void settle() {
    for (bool more = true; more;) {
      more = false;
      for (auto& x : tasks_) {
        if (x.state != State::waiting)
          continue;
        std::erase_if(x.options.after, [&](auto& id) {
          auto* y = find(id);
          return y && y->state == State::succeeded;
        });
        for (auto& id : x.options.after) {
          auto* y = find(id);
          if (y && y->state == State::lost) {
            x.state = State::lost;
            more = true;
          }
        }
      }
    }
  }

  void adopt() {
    for (;;) {
      Task* best = nullptr;
      for (auto& x : tasks_) {
        if (!ready(x) || (rules_.backfill && used() + x.options.cost > rules_.budget))
          continue;
        if (!best || x.options.priority > best->options.priority)
          best = &x;
      }
      if (!best || used() + best->options.cost > rules_.budget)
        return;
      best->state = State::running;
      adopted.push_back(best->id);
    }
  }

  TaskSchedule::Rules rules_;
  std::vector<Task> tasks_;
};

/// A schedule, and what its decisions amount to.
class Followed {
public:
  explicit Followed(TaskSchedule::Rules rules) : schedule(rules) {}

  void apply(const Step& step) {
    if (step.kind == Step::propose) {
      decisions.erase(step.id);
      follow(schedule.propose({step.id, "", "", step.options}));
      RC_ASSERT(decisions.count(step.id) == 1u);
    } else if (decisions.count(step.id) > 0 && decisions[step.id] != TaskDecision::rejected) {
      decisions.erase(step.id);
      follow(step.kind == Step::retract
               ? schedule.retract(step.id)
               : schedule.complete(step.id, step.kind == Step::succeed ? TaskOutcome::success
                                                                       : TaskOutcome::failure));
    }
  }

  TaskSchedule schedule;
  std::map<TaskId, TaskDecision> decisions;
  /// In the last step, in their order.
  std::vector<TaskId> adopted;

private:
  void follow(const TaskSchedule::Decisions& news) {
    adopted.clear();
    for (auto& x : news) {
      auto before = decisions.find(x.id);
      RC_ASSERT(x.reason.empty() == (x.decision == TaskDecision::adopted));
      // What was adopted or rejected is decided; what waits is told so once.
      const bool open = before == decisions.end() || (before->second == TaskDecision::waiting &&
                                                      x.decision != TaskDecision::waiting);
      RC_ASSERT(open);
      if (x.decision == TaskDecision::adopted)
        adopted.push_back(x.id);
      decisions[x.id] = x.decision;
    }
  }
};

TaskSchedule::Rules any_rules() {
  return {.budget = *element(1.0, 2.0, 2.5), .backfill = *rc::gen::arbitrary<bool>()};
}

RC_GTEST_PROP(TaskScheduleProperties, DecidesAsTheModelDoes, ()) {
  auto rules = any_rules();
  Followed schedule{rules};
  Model model{rules};
  for (auto& step : *any_steps()) {
    schedule.adopted.clear();
    schedule.apply(step);
    model.apply(step);
    RC_ASSERT(schedule.adopted == model.adopted);
    RC_ASSERT(schedule.schedule.used() == model.used());
    RC_ASSERT(schedule.schedule.used() <= rules.budget);
    for (auto& [id, decision] : schedule.decisions) {
      auto state = model.find(id)->state;
      RC_ASSERT((decision == TaskDecision::adopted) == (state == Model::State::running));
      RC_ASSERT((decision == TaskDecision::waiting) == (state == Model::State::waiting));
    }
  }
}

RC_GTEST_PROP(TaskScheduleProperties, WhatWaitsHasAReasonTo, ()) {
  auto rules = any_rules();
  Followed schedule{rules};
  Model model{rules};
  for (auto& step : *any_steps()) {
    schedule.apply(step);
    model.apply(step);
  }
  auto room = rules.budget - schedule.schedule.used();
  for (auto& x : model.tasks()) {
    if (!model.ready(x))
      continue;
    auto blocked = x.options.cost > room;
    if (!rules.backfill)
      for (auto& y : model.tasks())
        blocked |=
          model.ready(y) && y.options.cost > room && y.options.priority >= x.options.priority;
    RC_ASSERT(blocked);
  }
}

RC_GTEST_PROP(TaskScheduleProperties, EverythingGetsItsTurn, ()) {
  Followed schedule{any_rules()};
  std::map<TaskId, TaskOptions> proposed;
  for (auto& step : *any_steps()) {
    schedule.apply(step);
    if (step.kind == Step::propose)
      proposed[step.id] = step.options;
  }
  // All that is adopted succeeds, until nothing is.
  for (;;) {
    auto running = std::find_if(schedule.decisions.begin(), schedule.decisions.end(),
                                [](auto& x) { return x.second == TaskDecision::adopted; });
    if (running == schedule.decisions.end())
      break;
    auto id = running->first;
    schedule.apply({Step::succeed, id, {}});
  }
  // What is left waits for something that was never proposed, or for what waits for such.
  for (auto& [id, decision] : schedule.decisions) {
    if (decision != TaskDecision::waiting)
      continue;
    auto& after = proposed.at(id).after;
    RC_ASSERT(std::any_of(after.begin(), after.end(), [&](auto& x) {
      auto i = schedule.decisions.find(x);
      return proposed.count(x) == 0 ||
             (i != schedule.decisions.end() && i->second == TaskDecision::waiting);
    }));
  }
}

} // namespace

} // namespace castor::test
