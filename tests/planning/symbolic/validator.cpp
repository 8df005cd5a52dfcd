#include "castor/tests/planning/symbolic/validator.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

namespace castor::test {

namespace {

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::string spaced;
    for (const char c : line.substr(0, line.find(';'))) {
      if (c == '(' || c == ')')
        spaced += std::string(" ") + c + ' ';
      else
        spaced += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    std::istringstream words(spaced);
    for (std::string word; words >> word;)
      result.push_back(word);
  }
  return result;
}

Expression parse(const std::vector<std::string>& tokens, std::size_t& next) {
  if (next >= tokens.size())
    throw std::runtime_error("the text ends too early");
  Expression result;
  if (tokens[next] != "(") {
    result.word = tokens[next++];
    return result;
  }
  ++next;
  while (next < tokens.size() && tokens[next] != ")")
    result.parts.push_back(parse(tokens, next));
  ++next;
  return result;
}

Expression parse(const std::string& text) {
  std::size_t next = 0;
  return parse(tokens_of(text), next);
}

std::vector<Expression> rest(const Expression& x, std::size_t from = 1) {
  return {x.parts.begin() + static_cast<std::ptrdiff_t>(from), x.parts.end()};
}

} // namespace

PddlModel::PddlModel(const std::string& domain, const std::string& problem) {
  read(parse(domain));
  read(parse(problem));
  initial_ = derived(initial_);
}

PddlModel::Names PddlModel::typed(const std::vector<Expression>& list) {
  Names result;
  std::size_t untyped = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].word != "-") {
      result.push_back({list[i].word, {"object"}});
      continue;
    }
    ++i;
    std::vector<std::string> types;
    if (list[i].parts.empty())
      types.push_back(list[i].word);
    for (std::size_t k = 1; k < list[i].parts.size(); ++k)
      types.push_back(list[i].parts[k].word);
    for (; untyped < result.size(); ++untyped)
      result[untyped].second = types;
  }
  return result;
}

void PddlModel::read(const Expression& define) {
  for (const auto& section : rest(define)) {
    const auto head = section.head();
    if (head == ":types") {
      for (auto& [name, types] : typed(rest(section)))
        supertypes_[name] = types;
    } else if (head == ":constants" || head == ":objects") {
      for (auto& x : typed(rest(section)))
        objects_.push_back(x);
    } else if (head == ":action") {
      Action action;
      for (std::size_t i = 2; i + 1 < section.parts.size(); i += 2) {
        const auto& part = section.parts[i + 1];
        if (section.parts[i].word == ":parameters")
          action.parameters = typed(part.parts);
        else if (section.parts[i].word == ":precondition")
          action.precondition = part;
        else
          action.effect = part;
      }
      actions_[section.parts[1].word] = action;
    } else if (head == ":derived") {
      axioms_.emplace_back(section.parts[1], section.parts[2]);
    } else if (head == ":init") {
      for (const auto& x : rest(section))
        if (x.head() == "=")
          functions_[atom(x.parts[1], {})] = std::stol(x.parts[2].word);
        else
          initial_.insert(atom(x, {}));
    } else if (head == ":goal") {
      goal_ = section.parts[1];
    } else if (head == ":metric") {
      has_costs_ = true;
    }
  }
}

bool PddlModel::is_subtype(const std::string& type, const std::string& of, int depth) const {
  if (type == of || of == "object")
    return true;
  const auto found = supertypes_.find(type);
  return depth < 50 && found != supertypes_.end() &&
         std::ranges::any_of(found->second, [&](const std::string& x) {
           return x != "object" && is_subtype(x, of, depth + 1);
         });
}

std::vector<std::string> PddlModel::objects_of(const std::vector<std::string>& types) const {
  std::vector<std::string> result;
  for (const auto& [name, own] : objects_)
    if (std::ranges::any_of(types, [&](const auto& x) { return is_subtype(own.front(), x); }))
      result.push_back(name);
  return result;
}

std::string PddlModel::atom(const Expression& x, const Values& values) {
  std::string result = "(";
  for (const auto& part : x.parts) {
    const auto found = values.find(part.word);
    result += (result.size() > 1 ? " " : "") + (found == values.end() ? part.word : found->second);
  }
  return result + ")";
}

void PddlModel::bind(const Names& names, std::size_t next, Values& values,
                     std::vector<Values>& all) const {
  if (next == names.size()) {
    all.push_back(values);
    return;
  }
  for (const auto& object : objects_of(names[next].second)) {
    const auto before = values;
    values[names[next].first] = object;
    bind(names, next + 1, values, all);
    values = before;
  }
}

bool PddlModel::holds(const Expression& x, const Values& values, const Atoms& state) const {
  const auto head = x.head();
  if (x.parts.empty())
    return true;
  if (head == "and")
    return std::ranges::all_of(rest(x), [&](auto& y) { return holds(y, values, state); });
  if (head == "or")
    return std::ranges::any_of(rest(x), [&](auto& y) { return holds(y, values, state); });
  if (head == "not")
    return !holds(x.parts[1], values, state);
  if (head == "imply")
    return !holds(x.parts[1], values, state) || holds(x.parts[2], values, state);
  if (head == "forall" || head == "exists") {
    std::vector<Values> all;
    auto inner = values;
    bind(typed(x.parts[1].parts), 0, inner, all);
    const auto is_true = [&](const Values& y) { return holds(x.parts[2], y, state); };
    return head == "forall" ? std::ranges::all_of(all, is_true) : std::ranges::any_of(all, is_true);
  }
  if (head == "=") {
    const auto value = [&](const std::string& word) {
      const auto found = values.find(word);
      return found == values.end() ? word : found->second;
    };
    return value(x.parts[1].word) == value(x.parts[2].word);
  }
  return state.contains(atom(x, values));
}

Atoms PddlModel::derived(Atoms state) const {
  if (axioms_.empty())
    return state;
  std::set<std::string> heads;
  for (const auto& [head, body] : axioms_)
    heads.insert(head.head());
  std::erase_if(state, [&](const std::string& x) {
    return heads.contains(x.substr(1, x.find_first_of(" )") - 1));
  });
  // In the order of strata: a predicate's axioms come after those that they negate.
  std::map<std::string, int> strata;
  const auto collect_negated = [&](const auto& self, const Expression& x, bool is_negated,
                                   int& least) -> void {
    if (heads.contains(x.head()))
      least = std::max(least, strata[x.head()] + (is_negated ? 1 : 0));
    for (const auto& part : x.parts)
      self(self, part, is_negated || x.head() == "not" || x.head() == "imply", least);
  };
  for (std::size_t round = 0; round <= heads.size() * heads.size(); ++round)
    for (const auto& [head, body] : axioms_)
      collect_negated(collect_negated, body, false, strata[head.head()]);
  for (int stratum = 0; stratum <= static_cast<int>(heads.size()); ++stratum)
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (const auto& [head, body] : axioms_) {
        if (strata[head.head()] != stratum)
          continue;
        std::vector<Values> all;
        Values values;
        bind(typed(rest(head)), 0, values, all);
        // Types belong to the variables only.
        Expression plain;
        plain.parts.push_back(head.parts.front());
        for (const auto& x : typed(rest(head)))
          plain.parts.push_back({x.first, {}});
        for (const auto& x : all)
          if (!state.contains(atom(plain, x)) && holds(body, x, state)) {
            state.insert(atom(plain, x));
            has_changed = true;
          }
      }
    }
  return state;
}

bool PddlModel::is_goal(const Atoms& state) const {
  return holds(goal_, {}, state);
}

void PddlModel::collect(const Expression& effect, const Values& values, const Atoms& state,
                        Atoms& added, Atoms& deleted) const {
  const auto head = effect.head();
  if (effect.parts.empty() || head == "increase")
    return;
  if (head == "and") {
    for (const auto& x : rest(effect))
      collect(x, values, state, added, deleted);
  } else if (head == "forall") {
    std::vector<Values> all;
    auto inner = values;
    bind(typed(effect.parts[1].parts), 0, inner, all);
    for (const auto& x : all)
      collect(effect.parts[2], x, state, added, deleted);
  } else if (head == "when") {
    if (holds(effect.parts[1], values, state))
      collect(effect.parts[2], values, state, added, deleted);
  } else if (head == "not") {
    deleted.insert(atom(effect.parts[1], values));
  } else {
    added.insert(atom(effect, values));
  }
}

std::optional<std::pair<const PddlModel::Action*, PddlModel::Values>>
PddlModel::find(const std::string& action) const {
  std::istringstream words(action);
  std::string word;
  words >> word;
  const auto found = actions_.find(word);
  if (found == actions_.end())
    return {};
  Values values;
  for (const auto& [name, types] : found->second.parameters) {
    const auto objects = objects_of(types);
    if (!(words >> word) || std::ranges::find(objects, word) == objects.end())
      return {};
    values[name] = word;
  }
  if (words >> word)
    return {};
  return std::pair{&found->second, values};
}

std::optional<Atoms> PddlModel::after(const Atoms& state, const std::string& action) const {
  const auto found = find(action);
  if (!found || !holds(found->first->precondition, found->second, state))
    return {};
  Atoms added;
  Atoms deleted;
  collect(found->first->effect, found->second, state, added, deleted);
  Atoms result;
  for (const auto& x : state)
    if (!deleted.contains(x))
      result.insert(x);
  result.insert(added.begin(), added.end());
  return derived(result);
}

long PddlModel::summed_cost(const Expression& effect, const Values& values) const {
  long result = 0;
  if (effect.head() == "increase")
    result = effect.parts[2].parts.empty() ? std::stol(effect.parts[2].word)
                                           : functions_.at(atom(effect.parts[2], values));
  else if (effect.head() == "and")
    for (const auto& x : rest(effect))
      result += summed_cost(x, values);
  return result;
}

long PddlModel::cost_of(const std::string& action) const {
  const auto found = find(action);
  return has_costs_ && found ? summed_cost(found->first->effect, found->second) : 1;
}

std::vector<std::string> PddlModel::all_actions() const {
  std::vector<std::string> result;
  for (const auto& [name, action] : actions_) {
    std::vector<Values> all;
    Values values;
    bind(action.parameters, 0, values, all);
    for (const auto& x : all) {
      std::string text = name;
      for (const auto& parameter : action.parameters)
        text += ' ' + x.at(parameter.first);
      result.push_back(text);
    }
  }
  return result;
}

std::string validate(const PddlModel& model, const std::vector<std::string>& plan, long cost) {
  auto state = model.initial();
  long sum = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    auto next = model.after(state, plan[i]);
    if (!next)
      return "action " + std::to_string(i + 1) + " is not applicable: " + plan[i];
    state = std::move(*next);
    sum += model.cost_of(plan[i]);
  }
  if (!model.is_goal(state))
    return "the goal is not reached";
  if (sum != cost)
    return "the plan costs " + std::to_string(sum) + ", not " + std::to_string(cost);
  return {};
}

} // namespace castor::test
