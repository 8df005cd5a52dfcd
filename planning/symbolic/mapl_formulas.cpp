#include "castor/planning/symbolic/mapl_formulas.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <utility>

namespace castor::planning {

SyntaxNode word_node(std::string_view word, std::uint32_t offset) {
  SyntaxNode result;
  result.word = word;
  result.offset = offset;
  return result;
}

SyntaxNode list_node(std::vector<SyntaxNode> children, std::uint32_t offset) {
  SyntaxNode result;
  result.is_list = true;
  result.children = std::move(children);
  result.offset = offset;
  return result;
}

namespace {

bool is_same(const SyntaxNode& a, const SyntaxNode& b) {
  return a.is_list == b.is_list && a.word == b.word &&
         std::ranges::equal(a.children, b.children, is_same);
}

SyntaxNode negated(SyntaxNode node) {
  const auto offset = node.offset;
  return list_node({word_node("not", offset), std::move(node)}, offset);
}

SyntaxNode atom(std::string_view predicate, const std::vector<SyntaxNode>& arguments,
                std::uint32_t offset) {
  auto result = list_node({word_node(predicate, offset)}, offset);
  result.children.insert(result.children.end(), arguments.begin(), arguments.end());
  return result;
}

std::string usage_of(const StateVariable& x) {
  std::string result = "(" + std::string(x.name);
  for (const auto& parameter : x.parameters)
    result += ' ' + std::string(parameter.name.word);
  return result + ")";
}

/// Replaces what cannot be used, after a message, by a condition or an effect of nothing.
void discard(SyntaxNode& node) {
  node = list_node({word_node("and", node.offset)}, node.offset);
}

} // namespace

SyntaxNode MaplFormulas::value_atom(const ValueTerm& term, std::uint32_t offset) {
  auto arguments = term.arguments;
  arguments.push_back(term.value);
  return atom(term.variable->name, arguments, offset);
}

SyntaxNode MaplFormulas::excluded_atom(const ValueTerm& term, std::uint32_t offset) {
  auto arguments = term.arguments;
  arguments.push_back(term.value);
  return atom(term.variable->excluded, arguments, offset);
}

SyntaxNode MaplFormulas::known_atom(const StateVariable& variable, const SyntaxNode& agent,
                                    const std::vector<SyntaxNode>& arguments,
                                    std::uint32_t offset) {
  std::vector<SyntaxNode> all{agent};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return atom(variable.known, all, offset);
}

bool MaplFormulas::is_about_value(const SyntaxNode& node) const {
  const auto is_number = [](const SyntaxNode& x) {
    return !x.word.empty() && is_digit(x.word.front());
  };
  const auto& x = node.children;
  // (= (distance ?a ?b) 3) is about a cost.
  return is_variable(node) || node.head() == "assign" ||
         (node.head() == "=" && std::ranges::any_of(x, &SyntaxNode::is_list) &&
          std::ranges::none_of(x, is_number));
}

const StateVariable* MaplFormulas::variable_of(const SyntaxNode& node) {
  const auto found = variables_.find(node.head());
  if (found == variables_.end()) {
    NameTable names;
    for (const auto& [name, variable] : variables_)
      names.add(name, 0);
    context_.error(node,
                   node.is_list && !node.head().empty()
                     ? "there is no state variable " + in_quotes(node.head())
                     : "a state variable is expected here",
                   context_.suggestion(node.head(), names,
                                       "write (VARIABLE ARGUMENT ...) with one that is declared in "
                                       "(:state-variables ...)"));
    return nullptr;
  }
  const auto& variable = found->second;
  if (node.children.size() - 1 != variable.parameters.size()) {
    context_.error(node,
                   "the state variable " + in_quotes(variable.name) + " has " +
                     std::to_string(variable.parameters.size()) + " arguments, not " +
                     std::to_string(node.children.size() - 1),
                   "write " + usage_of(variable));
    return nullptr;
  }
  return &variable;
}

std::optional<ValueTerm> MaplFormulas::value_term(const SyntaxNode& node) {
  const auto& x = node.children;
  if (is_variable(node)) {
    const auto& variable = variables_.find(node.head())->second;
    if (x.size() < 3 || x[x.size() - 2].word != ":") {
      context_.error(node,
                     "the value of the state variable " + in_quotes(variable.name) + " is missing",
                     "write (= " + usage_of(variable) + " VALUE)");
      return {};
    }
    const SyntaxNode term = list_node({x.begin(), x.end() - 2}, node.offset);
    if (!variable_of(term))
      return {};
    return ValueTerm{&variable, {x.begin() + 1, x.end() - 2}, x.back()};
  }
  if (x.size() != 3) {
    context_.error(node,
                   in_quotes(node.head()) + " has 2 parts, not " + std::to_string(x.size() - 1),
                   "write (" + std::string(node.head()) + " (VARIABLE ARGUMENT ...) VALUE)");
    return {};
  }
  const bool is_second = !is_variable(x[1]) && is_variable(x[2]);
  const auto& term = is_second ? x[2] : x[1];
  const auto& value = is_second ? x[1] : x[2];
  const auto* variable = variable_of(term);
  if (!variable)
    return {};
  if (value.is_list) {
    context_.error(value, "a list stands where a value is expected",
                   "bind the value to a variable by a condition of its own");
    return {};
  }
  return ValueTerm{variable, {term.children.begin() + 1, term.children.end()}, value};
}

SyntaxNode MaplFormulas::differs(const ValueTerm& term, std::uint32_t offset) {
  auto other = term;
  other.value = word_node(words_.make("?other value " + std::to_string(++made_)), offset);
  auto equal = list_node({word_node("=", offset), other.value, term.value}, offset);
  auto body = list_node(
    {word_node("and", offset), value_atom(other, offset), negated(std::move(equal))}, offset);
  return list_node({word_node("exists", offset),
                    list_node({other.value, word_node("-", offset), term.variable->type}, offset),
                    std::move(body)},
                   offset);
}

void MaplFormulas::know(SyntaxNode& node) {
  if (node.children.size() != 3) {
    context_.error(node, "'K' has 2 parts, not " + std::to_string(node.children.size() - 1),
                   "write (K AGENT (VARIABLE ARGUMENT ...))");
    return discard(node);
  }
  const auto* variable = variable_of(node.children[2]);
  if (!variable)
    return discard(node);
  const auto& term = node.children[2].children;
  node = known_atom(*variable, node.children[1], {term.begin() + 1, term.end()}, node.offset);
}

void MaplFormulas::condition(SyntaxNode& node, bool is_negated) {
  const auto head = node.head();
  if (!node.is_list || head.empty())
    return;
  auto& x = node.children;
  if (head == "and" || head == "or" || head == "not" || head == "imply") {
    for (std::size_t i = 1; i < x.size(); ++i)
      condition(x[i], head == "not" || (head == "imply" && i == 1) ? !is_negated : is_negated);
  } else if (head == "forall" || head == "exists") {
    if (x.size() == 3)
      condition(x[2], is_negated);
  } else if (head == "k") {
    know(node);
  } else if (head == "in-domain" || head == "in_domain") {
    const auto term = value_term(node);
    if (term)
      node = negated(excluded_atom(*term, node.offset));
    else
      discard(node);
  } else if (is_about_value(node)) {
    const auto term = value_term(node);
    if (!term)
      discard(node);
    else if (is_negated)
      node = negated(differs(*term, node.offset));
    else
      node = value_atom(*term, node.offset);
  }
}

const SyntaxNode* MaplFormulas::former_value(const ValueTerm& term,
                                             const SyntaxNode* precondition) {
  if (!precondition)
    return nullptr;
  const auto looks_like_it = [&](const SyntaxNode& node) -> const SyntaxNode* {
    const auto& x = node.children;
    if (node.head() == "=" && x.size() == 3) {
      for (const std::size_t i : {1U, 2U})
        if (x[i].head() == term.variable->name && !x[3 - i].is_list &&
            std::ranges::equal(x[i].children.begin() + 1, x[i].children.end(),
                               term.arguments.begin(), term.arguments.end(), is_same))
          return &x[3 - i];
    } else if (node.head() == term.variable->name && x.size() == term.arguments.size() + 3 &&
               std::equal(x.begin() + 1, x.end() - 2, term.arguments.begin(), is_same)) {
      return &x.back();
    }
    return nullptr;
  };
  if (precondition->head() != "and")
    return looks_like_it(*precondition);
  for (const auto& x : precondition->children)
    if (const auto* found = looks_like_it(x))
      return found;
  return nullptr;
}

SyntaxNode MaplFormulas::assignment(const ValueTerm& term, const SyntaxNode* actor,
                                    const SyntaxNode* precondition, std::uint32_t offset) {
  auto result = list_node({word_node("and", offset)}, offset);
  auto former = term;
  const auto for_all = [&](const SyntaxNode& name, const SyntaxNode& type, SyntaxNode effect) {
    return list_node({word_node("forall", offset),
                      list_node({name, word_node("-", offset), type}, offset), std::move(effect)},
                     offset);
  };
  if (const auto* value = former_value(term, precondition)) {
    former.value = *value;
    result.children.push_back(negated(value_atom(former, offset)));
  } else {
    former.value = word_node("?any value", offset);
    result.children.push_back(
      for_all(former.value, term.variable->type, negated(value_atom(former, offset))));
  }
  const auto anybody = word_node("?any agent", offset);
  result.children.push_back(
    for_all(anybody, word_node("agent", offset),
            negated(known_atom(*term.variable, anybody, term.arguments, offset))));
  // What is added wins over what is deleted.
  result.children.push_back(value_atom(term, offset));
  if (actor)
    result.children.push_back(known_atom(*term.variable, *actor, term.arguments, offset));
  return result;
}

void MaplFormulas::effect(SyntaxNode& node, const SyntaxNode* actor,
                          const SyntaxNode* precondition) {
  const auto head = node.head();
  if (!node.is_list || head.empty() || head == "increase")
    return;
  auto& x = node.children;
  if (head == "and") {
    for (std::size_t i = 1; i < x.size(); ++i)
      effect(x[i], actor, precondition);
  } else if (head == "forall") {
    if (x.size() == 3)
      effect(x[2], actor, precondition);
  } else if (head == "when") {
    if (x.size() == 3) {
      condition(x[1]);
      effect(x[2], actor, precondition);
    }
  } else if (head == "not" && x.size() == 2 && is_about_value(x[1])) {
    context_.error(node, "an effect cannot say which value a state variable has not",
                   "assign another value: (assign (VARIABLE ARGUMENT ...) VALUE)");
    discard(node);
  } else if (head == "not" && x.size() == 2 &&
             (x[1].head() == "in-domain" || x[1].head() == "in_domain")) {
    const auto term = value_term(x[1]);
    if (term)
      node = excluded_atom(*term, node.offset);
    else
      discard(node);
  } else if (head == "not") {
    if (x.size() == 2)
      effect(x[1], actor, precondition);
  } else if (head == "k" || head == "in-domain" || head == "in_domain") {
    condition(node);
  } else if (is_about_value(node)) {
    const auto term = value_term(node);
    if (term)
      node = assignment(*term, actor, precondition, node.offset);
    else
      discard(node);
  }
}

} // namespace castor::planning
