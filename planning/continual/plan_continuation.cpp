#include "castor/planning/continual/plan_continuation.hpp"

#include "castor/base/text.hpp"
#include "castor/planning/symbolic/evaluation.hpp"
#include "castor/planning/symbolic/pddl_reader.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

namespace castor::planning {

namespace {

/// Each object and each fact on a line of its own, so that findings name it.
std::string problem_text(const std::string& domain, bool has_agent, const FindPlan& request) {
  std::string result = "(define (problem continual) (:domain " + domain + ")";
  if (has_agent)
    result += " (:agent " + request.agent + ")";
  result += "\n(:objects\n";
  for (const auto& x : request.objects)
    result += x.name + " - " + x.type + "\n";
  result += ")\n(:init\n";
  for (const auto& x : request.facts)
    result += x + "\n";
  return result + ")\n(:goal\n" + request.goal + "\n))\n";
}

/// "(define (domain NAME)"; the problem is written for it.
std::string name_of(const std::string& domain_text) {
  const auto text = lower_case(domain_text);
  const auto begin = text.find("(domain");
  if (begin == std::string::npos)
    return "none";
  std::istringstream words(text.substr(begin + std::string("(domain").size()));
  std::string name;
  std::getline(words, name, ')');
  return std::string(trim(name));
}

/// Only problems of MAPL say who plans.
bool is_mapl(const std::string& domain_text) {
  return lower_case(domain_text).find(":mapl") != std::string::npos;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string word; in >> word;)
    result.push_back(word);
  return result;
}

int object_named(const LiftedTask& task, const std::string& name) {
  const auto found = std::ranges::find(task.objects, name, &PlanningObject::name);
  return found == task.objects.end() ? -1 : static_cast<int>(found - task.objects.begin());
}

/// An action without variables, by its name.
struct Step {
  const ActionSchema* schema = nullptr;
  std::vector<int> values;
};

std::optional<Step> step_named(const LiftedTask& task, const std::string& action) {
  const auto words = words_of(action);
  if (words.empty())
    return {};
  const auto schema = std::ranges::find(task.actions, words.front(), &ActionSchema::name);
  if (schema == task.actions.end() || schema->parameters != words.size() - 1)
    return {};
  Step result{&*schema, {}};
  for (std::size_t i = 1; i < words.size(); ++i) {
    result.values.push_back(object_named(task, words[i]));
    if (result.values.back() < 0)
      return {};
  }
  return result;
}

StepKind kind_of(const LiftedTask& task, const std::string& action) {
  const auto step = step_named(task, action);
  switch (step ? step->schema->kind : ActionKind::action) {
    case ActionKind::sensor:
      return StepKind::sensor;
    case ActionKind::assertion:
      return StepKind::assertion;
    case ActionKind::action:
      break;
  }
  return StepKind::action;
}

/// "excluded is-in|robby hall": the predicate may have blanks.
std::string text_of(const LiftedTask& task, const AtomKey& atom) {
  auto result = task.predicates[static_cast<std::size_t>(atom.front())].name + "|";
  for (std::size_t i = 1; i < atom.size(); ++i)
    result += (i == 1 ? "" : " ") + task.objects[static_cast<std::size_t>(atom[i])].name;
  return result;
}

/// Nothing if the task has no such predicate or object any more.
std::optional<AtomKey> atom_of(const LiftedTask& task, const std::string& text) {
  const auto bar = text.find('|');
  const auto predicate = std::ranges::find(task.predicates, text.substr(0, bar), &Predicate::name);
  if (bar == std::string::npos || predicate == task.predicates.end())
    return {};
  AtomKey result{static_cast<int>(predicate - task.predicates.begin())};
  for (const auto& x : words_of(text.substr(bar + 1))) {
    result.push_back(object_named(task, x));
    if (result.back() < 0)
      return {};
  }
  if (result.size() != predicate->parameters.size() + 1)
    return {};
  return result;
}

void collect_literals(const Formula& x, std::vector<Literal>& result) {
  if (x.kind == Formula::Kind::literal)
    result.push_back(x.literal);
  for (const auto& part : x.parts)
    collect_literals(part, result);
}

class Continuation {
public:
  Continuation(const DomainText& domain, const FindPlan& request, const PlanningOptions& options)
    : domain_(domain), request_(request), options_(options) {
    result_.learned = request.learned;
  }

  FoundPlan run() {
    for (const auto& x : request_.objects)
      if (lower_case(x.name) != x.name) {
        result_.outcome = PlanOutcome::refused;
        result_.explanation = "the object " + in_quotes(x.name) + " has capital letters: call it " +
                              in_quotes(lower_case(x.name));
        return std::move(result_);
      }
    auto read = parse_pddl(domain_.file, domain_.text, "the state and the goal",
                           problem_text(name_of(domain_.text), is_mapl(domain_.text), request_));
    if (has_errors(read.problems)) {
      result_.outcome = PlanOutcome::refused;
      result_.explanation = render(read.problems);
      return std::move(result_);
    }
    task_ = std::move(read.task);
    learn();
    for (const auto& x : result_.learned)
      if (auto atom = atom_of(task_, x))
        task_.initial.push_back(std::move(*atom));
    state_ = {task_.initial.begin(), task_.initial.end()};
    try {
      if (!is_kept())
        plan();
    } catch (const LimitError& e) {
      result_.outcome = PlanOutcome::unknown;
      result_.explanation = e.what();
    }
    return std::move(result_);
  }

private:
  /// What a sensor tells that did not show what it was used for.
  void learn() {
    const auto step = step_named(task_, request_.done);
    if (!step || step->schema->kind != ActionKind::sensor)
      return;
    const AtomSet state(task_.initial.begin(), task_.initial.end());
    const auto is_so = [&](const LiftedEffect& x) {
      return !x.variables.empty() || state.contains(ground_atom(x.literal, step->values));
    };
    if (std::ranges::all_of(step->schema->effects, is_so))
      return;
    std::vector<Literal> outcome;
    collect_literals(step->schema->negative_outcome, outcome);
    for (const auto& x : outcome) {
      if (x.is_negated || x.predicate == equality)
        continue;
      auto fact = text_of(task_, ground_atom(x, step->values));
      if (std::ranges::find(result_.learned, fact) == result_.learned.end())
        result_.learned.push_back(std::move(fact));
    }
  }

  bool is_kept() {
    result_.reason = request_.reason;
    result_.why = request_.why;
    if (request_.reason == PlanReason::none)
      check();
    return result_.outcome == PlanOutcome::achieved || result_.outcome == PlanOutcome::kept;
  }

  void achieve() {
    result_.outcome = PlanOutcome::achieved;
    result_.explanation = "the goal holds";
  }

  /// Goes through the plan from the state on.
  void check() {
    LimitWatch watch(options_.limits);
    const auto task = compile(task_, watch);
    State state = task.initial;
    if (!task.is_unreachable && holds(task.goal, state))
      return achieve();
    State next;
    for (const auto& step : request_.steps) {
      const auto is_possible = [&](const TaskOperator& x) {
        return x.name == step.action && holds(x.precondition, state);
      };
      const auto op = std::ranges::find_if(task.operators, is_possible);
      if (op == task.operators.end())
        return reject(step);
      apply(task, *op, state, next);
      std::swap(state, next);
    }
    if (task.is_unreachable || !holds(task.goal, state)) {
      result_.reason = PlanReason::state_changed;
      result_.why = "the plan would not reach the goal any more";
      return;
    }
    result_.outcome = PlanOutcome::kept;
    result_.steps = request_.steps;
    result_.explanation = "the plan is kept";
  }

  void reject(const PlannedStep& step) {
    const auto known = step_named(task_, step.action);
    if (known && known->schema->kind == ActionKind::assertion &&
        planning::holds(task_, known->schema->replan, known->schema->variables, known->values,
                        state_)) {
      result_.reason = PlanReason::assertion_enabled;
      result_.why = "what '" + step.action + "' waits for is known";
    } else {
      result_.reason = PlanReason::state_changed;
      result_.why = "'" + step.action + "' is not possible any more";
    }
  }

  void plan() {
    const auto found = find_plan(task_, options_);
    result_.explanation = explain(found);
    switch (found.outcome) {
      case PlanningResult::Outcome::plan:
        if (found.steps.empty())
          return achieve();
        result_.outcome = PlanOutcome::changed;
        for (const auto& x : found.steps)
          result_.steps.push_back({x.action, kind_of(task_, x.action), x.cost});
        break;
      case PlanningResult::Outcome::unsolvable:
        result_.outcome = PlanOutcome::unsolvable;
        break;
      case PlanningResult::Outcome::unknown:
        result_.outcome = PlanOutcome::unknown;
        break;
    }
  }

  const DomainText& domain_;
  const FindPlan& request_;
  const PlanningOptions& options_;
  LiftedTask task_;
  AtomSet state_;
  FoundPlan result_;
};

} // namespace

FoundPlan continue_plan(const DomainText& domain, const FindPlan& request,
                        const PlanningOptions& options) {
  return Continuation(domain, request, options).run();
}

} // namespace castor::planning
