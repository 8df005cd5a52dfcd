#include "castor/planning/symbolic/mapl_translation.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>

/// The problem's part of the translation of MAPL, and what follows from its facts.
namespace castor::planning {

namespace {

int index_of(const std::vector<Predicate>& predicates, std::string_view name) {
  const auto found = std::ranges::find(predicates, name, &Predicate::name);
  return found == predicates.end() ? -1 : static_cast<int>(found - predicates.begin());
}

} // namespace

void MaplTranslation::problem(std::vector<SyntaxNode>& top) {
  if (!is_used_)
    return;
  for (auto& define : top) {
    if (define.head() != "define")
      continue;
    take_agent(define);
    for (auto& section : define.children)
      if (section.head() == ":init")
        translate_initial(section);
      else if (section.head() == ":goal" && section.children.size() == 2)
        formulas_.condition(section.children[1]);
  }
}

void MaplTranslation::take_agent(SyntaxNode& define) {
  for (const auto& section : define.children)
    if (section.head() == ":agent") {
      if (section.children.size() != 2 || section.children[1].is_list)
        context_.error(section, "the agent that plans is not named", "write (:agent OBJECT)");
      else
        agent_ = section.children[1].word;
    }
  std::erase_if(define.children, [](const SyntaxNode& x) { return x.head() == ":agent"; });
  if (agent_.empty() && !variables_.empty())
    context_.error(define, "the problem does not say which agent plans, and so knows its facts",
                   "add (:agent OBJECT)");
}

void MaplTranslation::translate_initial(SyntaxNode& section) {
  std::map<std::string, std::string_view> values;
  for (std::size_t i = 1; i < section.children.size(); ++i) {
    auto& node = section.children[i];
    if (node.head() == "in-domain" || node.head() == "in_domain") {
      if (const auto term = formulas_.value_term(node)) {
        node = MaplFormulas::excluded_atom(*term, node.offset);
        node.children.front().word = term->variable->possible;
      }
    } else if (node.head() == "not" && node.children.size() == 2 &&
               (node.children[1].head() == "in-domain" || node.children[1].head() == "in_domain")) {
      if (const auto term = formulas_.value_term(node.children[1]))
        node = MaplFormulas::excluded_atom(*term, node.offset);
    } else if (node.head() == "k") {
      formulas_.condition(node);
    } else if (formulas_.is_about_value(node)) {
      const auto term = formulas_.value_term(node);
      if (!term) {
        node = list_node({word_node("not", node.offset), list_node({}, node.offset)}, node.offset);
        continue;
      }
      std::string key = "(" + std::string(term->variable->name);
      for (const auto& x : term->arguments)
        key += ' ' + std::string(x.word);
      key += ")";
      const auto [place, is_new] = values.emplace(key, term->value.word);
      if (!is_new && place->second != term->value.word)
        context_.error(node,
                       "the state variable " + key + " has two values, " +
                         in_quotes(place->second) + " and " + in_quotes(term->value.word),
                       "state one of them");
      node = MaplFormulas::value_atom(*term, node.offset);
    }
  }
}

void MaplTranslation::complete(LiftedTask& task) const {
  if (!is_used_)
    return;
  add_known_values(task);
  add_excluded_values(task);
  for (const auto& [name, copy] : at_start_) {
    const int from = index_of(task.predicates, name);
    const int to = index_of(task.predicates, copy);
    const auto count = task.initial.size();
    for (std::size_t i = 0; i < count; ++i)
      if (task.initial[i].front() == from) {
        auto atom = task.initial[i];
        atom.front() = to;
        task.initial.push_back(std::move(atom));
      }
  }
}

void MaplTranslation::add_known_values(LiftedTask& task) const {
  const auto agent = std::ranges::find(task.objects, agent_, &PlanningObject::name);
  if (agent == task.objects.end())
    return;
  const auto number = static_cast<int>(agent - task.objects.begin());
  const auto count = task.initial.size();
  for (const auto& [name, variable] : variables_) {
    const int value = index_of(task.predicates, name);
    const int known = index_of(task.predicates, variable.known);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& atom = task.initial[i];
      if (atom.front() != value)
        continue;
      AtomKey result{known, number};
      result.insert(result.end(), atom.begin() + 1, atom.end() - 1);
      task.initial.push_back(std::move(result));
    }
  }
}

void MaplTranslation::add_excluded_values(LiftedTask& task) const {
  for (const auto& [name, variable] : variables_) {
    const int possible = index_of(task.predicates, variable.possible);
    const int excluded = index_of(task.predicates, variable.excluded);
    std::map<AtomKey, std::set<int>> stated;
    for (const auto& atom : task.initial)
      if (atom.front() == possible)
        stated[{atom.begin() + 1, atom.end() - 1}].insert(atom.back());
    const int type = task.predicates[static_cast<std::size_t>(excluded)].parameters.back().type;
    for (const auto& [arguments, values] : stated)
      for (const int x : task.types[static_cast<std::size_t>(type)].objects) {
        if (values.contains(x))
          continue;
        AtomKey atom{excluded};
        atom.insert(atom.end(), arguments.begin(), arguments.end());
        atom.push_back(x);
        task.initial.push_back(std::move(atom));
      }
  }
}

} // namespace castor::planning
