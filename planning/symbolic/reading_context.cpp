#include "castor/planning/symbolic/reading_context.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <utility>

namespace castor::planning {

namespace {

constexpr std::size_t most_problems = 100;

void add_problem(ReadingContext& context, Severity severity, const SyntaxNode& node,
                 std::string&& message, std::string&& remedy) {
  if (context.problems.size() < most_problems)
    context.problems.push_back(
      context.text->finding(severity, node.offset, std::move(message), std::move(remedy)));
}

bool is_variable_name(const SyntaxNode& node) {
  return !node.is_list && node.word.size() > 1 && node.word.front() == '?';
}

} // namespace

void ReadingContext::error(const SyntaxNode& node, std::string message, std::string remedy) {
  add_problem(*this, Severity::error, node, std::move(message), std::move(remedy));
}

void ReadingContext::warning(const SyntaxNode& node, std::string message, std::string remedy) {
  add_problem(*this, Severity::warning, node, std::move(message), std::move(remedy));
}

std::string ReadingContext::suggestion(std::string_view word, const NameTable& names,
                                       std::string remedy) const {
  auto result = problems.size() < most_problems ? did_you_mean(word, names.names()) : std::string();
  return result.empty() ? std::move(remedy) : result;
}

int read_type(ReadingContext& context, const SyntaxNode& node) {
  if (!node.is_list) {
    const int found = context.types.find(node.word);
    if (found < 0)
      context.error(
        node, "there is no type " + in_quotes(node.word),
        context.suggestion(node.word, context.types, "declare it in the section (:types ...)"));
    return found;
  }
  if (node.head() != "either" || node.children.size() < 2) {
    context.error(node, "a list stands where a type is expected",
                  "write the name of a type, or (either TYPE TYPE)");
    return -1;
  }
  if (node.children.size() == 2)
    return read_type(context, node.children[1]);
  // The union is a type of its own, that the others are parts of.
  Type result;
  std::vector<int> members;
  for (std::size_t i = 1; i < node.children.size(); ++i) {
    const int type = read_type(context, node.children[i]);
    if (type < 0)
      return -1;
    result.name +=
      (i == 1 ? "either " : " ") + context.task.types[static_cast<std::size_t>(type)].name;
    members.push_back(type);
  }
  auto& types = context.task.types;
  const auto same = std::ranges::find(types, result.name, &Type::name);
  if (same != types.end())
    return static_cast<int>(same - types.begin());
  result.parents.push_back(0);
  const int index = static_cast<int>(types.size());
  types.push_back(std::move(result));
  for (const int x : members)
    if (x != 0)
      types[static_cast<std::size_t>(x)].parents.push_back(index);
  return index;
}

void read_variables(ReadingContext& context, const SyntaxNode& list, VariableScope& scope) {
  if (!list.is_list) {
    context.error(list, "the list of variables is missing", "write (?x - TYPE ...), or ()");
    return;
  }
  const auto first = scope.visible.size();
  for_each_typed(context, list.children, 0, [&](const SyntaxNode& node, int type) {
    if (!is_variable_name(node)) {
      context.error(node, in_quotes(node.word) + " is no variable", "begin its name with '?'");
      return;
    }
    for (auto i = first; i < scope.visible.size(); ++i)
      if (scope.visible[i].name == node.word)
        context.error(node, "the variable " + in_quotes(node.word) + " is declared twice",
                      "rename one of the two");
    scope.visible.push_back({node.word, static_cast<int>(scope.all.size())});
    scope.all.push_back({std::string(node.word), type});
  });
}

namespace {

/// The term that a word stands for; nothing after a message.
bool read_term(ReadingContext& context, const SyntaxNode& node, const VariableScope& scope,
               Term& result) {
  if (node.is_list) {
    context.error(node, "a list stands where an object or a variable is expected",
                  "terms made of functions are not supported: use a predicate instead");
    return false;
  }
  if (node.word.front() == '?') {
    for (auto i = scope.visible.rbegin(); i != scope.visible.rend(); ++i)
      if (i->name == node.word) {
        result = i->slot;
        return true;
      }
    NameTable names;
    for (const auto& x : scope.visible)
      names.add(x.name, x.slot);
    context.error(node, "the variable " + in_quotes(node.word) + " is not bound",
                  context.suggestion(node.word, names, "declare it as a parameter"));
    return false;
  }
  const int object = context.objects.find(node.word);
  if (object < 0) {
    context.error(node, "there is no object " + in_quotes(node.word),
                  context.suggestion(node.word, context.objects,
                                     "declare it in (:constants ...) or (:objects ...)"));
    return false;
  }
  result = term_of_object(object);
  return true;
}

std::string usage_of(const Predicate& predicate, std::string_view name) {
  std::string result = "(" + std::string(name);
  for (const auto& x : predicate.parameters)
    result += ' ' + x.name;
  return result + ")";
}

/// Index of the predicate or function that the list begins with, with the right number of
/// arguments; -1 after a message.
int read_head(ReadingContext& context, const SyntaxNode& node, bool is_function) {
  const std::string kind = is_function ? "function" : "predicate";
  const auto head = node.head();
  if (head.empty()) {
    context.error(node, "the name of a " + kind + " is missing",
                  "write (" + kind + " ARGUMENT ...) in lists of their own");
    return -1;
  }
  const auto& names = is_function ? context.functions : context.predicates;
  const int found = names.find(head);
  if (found < 0) {
    context.error(
      node.children.front(), "there is no " + kind + " " + in_quotes(head),
      context.suggestion(head, names, "declare it in the section (:" + kind + "s ...)"));
    return -1;
  }
  const auto& declared = (is_function ? context.task.functions
                                      : context.task.predicates)[static_cast<std::size_t>(found)];
  if (declared.parameters.size() != node.children.size() - 1) {
    context.error(node,
                  in_quotes(head) + " has " + std::to_string(declared.parameters.size()) +
                    " arguments, not " + std::to_string(node.children.size() - 1),
                  "write " + usage_of(declared, head));
    return -1;
  }
  return found;
}

/// A literal; nothing after a message.
bool read_literal(ReadingContext& context, const SyntaxNode& node, const VariableScope& scope,
                  bool is_negated, Literal& result) {
  result.is_negated = is_negated;
  if (node.head() == "=") {
    if (node.children.size() != 3) {
      context.error(node, "'=' has 2 arguments", "write (= ?x ?y)");
      return false;
    }
    result.predicate = equality;
  } else {
    result.predicate = read_head(context, node, false);
    if (result.predicate < 0)
      return false;
  }
  bool is_good = true;
  for (std::size_t i = 1; i < node.children.size(); ++i) {
    Term term = 0;
    is_good &= read_term(context, node.children[i], scope, term);
    result.arguments.push_back(term);
  }
  return is_good;
}

bool has_count(ReadingContext& context, const SyntaxNode& node, std::size_t count,
               const std::string& usage) {
  if (node.children.size() == count)
    return true;
  context.error(node,
                in_quotes(node.head()) + " has " + std::to_string(count - 1) + " parts, not " +
                  std::to_string(node.children.size() - 1),
                "write " + usage);
  return false;
}

} // namespace

Formula read_formula(ReadingContext& context, const SyntaxNode& node, VariableScope& scope,
                     bool is_negated) {
  Formula result;
  if (!node.is_list) {
    context.error(node,
                  "the word " + in_quotes(node.word) + " stands where a condition is expected",
                  "put it into parentheses");
    return result;
  }
  const auto head = node.head();
  using Kind = Formula::Kind;
  if (node.children.empty() || head == "and" || head == "or") {
    result.kind = (head == "or") == is_negated ? Kind::conjunction : Kind::disjunction;
    for (std::size_t i = 1; i < node.children.size(); ++i)
      result.parts.push_back(read_formula(context, node.children[i], scope, is_negated));
  } else if (head == "not") {
    if (has_count(context, node, 2, "(not CONDITION)"))
      return read_formula(context, node.children[1], scope, !is_negated);
  } else if (head == "imply") {
    if (has_count(context, node, 3, "(imply CONDITION CONDITION)")) {
      result.kind = is_negated ? Kind::conjunction : Kind::disjunction;
      result.parts.push_back(read_formula(context, node.children[1], scope, !is_negated));
      result.parts.push_back(read_formula(context, node.children[2], scope, is_negated));
    }
  } else if (head == "forall" || head == "exists") {
    if (has_count(context, node, 3, "(" + std::string(head) + " (?x - TYPE) CONDITION)")) {
      result.kind = (head == "forall") == is_negated ? Kind::exists : Kind::forall;
      const auto visible = scope.visible.size();
      const auto first = scope.all.size();
      read_variables(context, node.children[1], scope);
      for (auto i = first; i < scope.all.size(); ++i)
        result.variables.push_back(static_cast<int>(i));
      result.parts.push_back(read_formula(context, node.children[2], scope, is_negated));
      scope.visible.resize(visible);
    }
  } else if (head == "<" || head == ">" || head == "<=" || head == ">=") {
    context.error(node, "comparisons of numbers are not supported",
                  "use predicates instead of numbers; only costs of actions are numbers");
  } else {
    result.kind = Kind::literal;
    if (!read_literal(context, node, scope, is_negated, result.literal))
      result = Formula{};
  }
  return result;
}

namespace {

void read_cost(ReadingContext& context, const SyntaxNode& node, const VariableScope& scope,
               ActionSchema& action) {
  if (!has_count(context, node, 3, "(increase (total-cost) COST)"))
    return;
  const auto& target = node.children[1];
  if (target.head() != "total-cost" && target.word != "total-cost") {
    context.error(target, "only the function (total-cost) can be changed",
                  "use predicates instead of numbers");
    return;
  }
  const auto& value = node.children[2];
  CostTerm term;
  if (!value.is_list && is_digit(value.word.front())) {
    std::int64_t number = 0;
    bool is_whole = value.word.size() <= 9;
    for (const char c : value.word) {
      is_whole &= is_digit(c);
      number = is_whole ? number * 10 + (c - '0') : 0;
    }
    if (!is_whole)
      context.error(value, "the cost " + in_quotes(value.word) + " is no whole number below 10^9",
                    "multiply all costs by the same number, and round them");
    term.number = number;
  } else if (!value.is_list) {
    context.error(value, "the cost " + in_quotes(value.word) + " is no number",
                  "write a number, or a function in parentheses");
  } else {
    term.function = read_head(context, value, true);
    for (std::size_t i = 1; term.function >= 0 && i < value.children.size(); ++i) {
      Term argument = 0;
      if (!read_term(context, value.children[i], scope, argument))
        term.function = -1;
      term.arguments.push_back(argument);
    }
  }
  action.costs.push_back(std::move(term));
}

/// @param quantified slots of the variables of surrounding (forall ...)
/// @param condition that of surrounding (when ...)
void read_effect(ReadingContext& context, const SyntaxNode& node, VariableScope& scope,
                 ActionSchema& action, const std::vector<int>& quantified,
                 const Formula& condition) {
  const auto head = node.head();
  if (node.is_list && node.children.empty())
    return;
  if (head == "and") {
    for (std::size_t i = 1; i < node.children.size(); ++i)
      read_effect(context, node.children[i], scope, action, quantified, condition);
  } else if (head == "forall") {
    if (!has_count(context, node, 3, "(forall (?x - TYPE) EFFECT)"))
      return;
    const auto visible = scope.visible.size();
    auto slots = quantified;
    const auto first = scope.all.size();
    read_variables(context, node.children[1], scope);
    for (auto i = first; i < scope.all.size(); ++i)
      slots.push_back(static_cast<int>(i));
    read_effect(context, node.children[2], scope, action, slots, condition);
    scope.visible.resize(visible);
  } else if (head == "when") {
    if (!has_count(context, node, 3, "(when CONDITION EFFECT)"))
      return;
    Formula both;
    both.parts.push_back(condition);
    both.parts.push_back(read_formula(context, node.children[1], scope));
    read_effect(context, node.children[2], scope, action, quantified, both);
  } else if (head == "increase") {
    read_cost(context, node, scope, action);
  } else if (head == "assign" || head == "decrease" || head == "scale-up" || head == "scale-down") {
    context.error(node, "the effect " + in_quotes(head) + " on numbers is not supported",
                  "only (increase (total-cost) ...) is: use predicates instead of numbers");
  } else if (!node.is_list) {
    context.error(node, "the word " + in_quotes(node.word) + " stands where an effect is expected",
                  "put it into parentheses");
  } else {
    const bool is_negated = head == "not";
    if (is_negated && !has_count(context, node, 2, "(not ATOM)"))
      return;
    const auto& atom = is_negated ? node.children[1] : node;
    LiftedEffect effect;
    effect.variables = quantified;
    effect.condition = condition;
    if (!read_literal(context, atom, scope, is_negated, effect.literal))
      return;
    if (effect.literal.predicate == equality) {
      context.error(node, "an action cannot change '='", "remove this effect");
      return;
    }
    const auto& predicate =
      context.task.predicates[static_cast<std::size_t>(effect.literal.predicate)];
    if (predicate.is_derived) {
      context.error(node,
                    "the derived predicate " + in_quotes(predicate.name) +
                      " cannot be changed by an action",
                    "change the predicates that it is derived from");
      return;
    }
    action.effects.push_back(std::move(effect));
  }
}

} // namespace

void read_effects(ReadingContext& context, const SyntaxNode& node, VariableScope& scope,
                  ActionSchema& action) {
  read_effect(context, node, scope, action, {}, Formula{});
}

AtomKey read_ground_atom(ReadingContext& context, const SyntaxNode& node, bool is_function) {
  const int head = read_head(context, node, is_function);
  if (head < 0)
    return {};
  AtomKey result{head};
  const VariableScope none;
  for (std::size_t i = 1; i < node.children.size(); ++i) {
    Term term = 0;
    if (!read_term(context, node.children[i], none, term))
      return {};
    result.push_back(~term);
  }
  return result;
}

} // namespace castor::planning
