#include "castor/planning/symbolic/mapl_translation.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>

namespace castor::planning {

namespace {

constexpr std::array<std::string_view, 5> mapl_parts{":agent", ":variables", ":replan", ":sense",
                                                     ":negcondition"};

SyntaxNode* find_define(std::vector<SyntaxNode>& top) {
  SyntaxNode* result = nullptr;
  for (auto& x : top)
    if (x.head() == "define")
      result = &x;
  return result;
}

bool is_action(const SyntaxNode& section) {
  return section.head() == ":action" || section.head() == ":sensor";
}

bool requires_mapl(const SyntaxNode& define) {
  return std::ranges::any_of(define.children, [](const SyntaxNode& x) {
    return x.head() == ":requirements" &&
           std::ranges::find(x.children, ":mapl", &SyntaxNode::word) != x.children.end();
  });
}

bool is_schema_variable(const SyntaxNode& node) {
  return node.word.starts_with("??");
}

/// Puts the term wherever the word stands.
void replace_word(SyntaxNode& node, std::string_view word, const SyntaxNode& term) {
  for (auto& x : node.children)
    if (!x.is_list && x.word == word) {
      const auto offset = x.offset;
      x = term;
      x.offset = offset;
    } else {
      replace_word(x, word, term);
    }
}

} // namespace

// -- parts of actions

const SyntaxNode* MaplTranslation::find_part(const SyntaxNode& section, std::string_view name) {
  const auto& x = section.children;
  for (std::size_t i = 2; i + 1 < x.size(); ++i)
    if (!x[i].is_list && x[i].word == name)
      return &x[i + 1];
  return nullptr;
}

SyntaxNode& MaplTranslation::part(SyntaxNode& section, std::string_view name) {
  auto& x = section.children;
  for (std::size_t i = 2; i + 1 < x.size(); ++i)
    if (!x[i].is_list && x[i].word == name)
      return x[i + 1];
  x.push_back(word_node(name, section.offset));
  x.push_back(list_node({}, section.offset));
  return x.back();
}

SyntaxNode MaplTranslation::take_part(SyntaxNode& section, std::string_view name) {
  auto& x = section.children;
  for (auto i = x.begin(); i + 1 < x.end(); ++i)
    if (!i->is_list && i->word == name) {
      auto result = std::move(*(i + 1));
      x.erase(i, i + 2);
      return result;
    }
  return list_node({}, section.offset);
}

void MaplTranslation::require(SyntaxNode& section, SyntaxNode condition) {
  auto& precondition = part(section, ":precondition");
  const auto offset = condition.offset;
  precondition =
    list_node({word_node("and", offset), std::move(precondition), std::move(condition)}, offset);
}

// -- the domain

void MaplTranslation::domain(std::vector<SyntaxNode>& top) {
  auto* define = find_define(top);
  if (!define)
    return;
  is_used_ = requires_mapl(*define);
  if (!is_used_) {
    const std::string remedy = "add :mapl to (:requirements ...)";
    for (const auto& section : define->children) {
      if (section.head() == ":sensor" || section.head() == ":state-variables")
        context_.error(section, "the section " + in_quotes(section.head()) + " belongs to MAPL",
                       remedy);
      if (is_action(section))
        for (const auto& x : section.children)
          if (std::ranges::find(mapl_parts, x.word) != mapl_parts.end())
            context_.error(x, "the part " + in_quotes(x.word) + " belongs to MAPL", remedy);
    }
    return;
  }
  for (const auto& section : define->children)
    if (section.head() == ":state-variables")
      declare(section);
  std::erase_if(define->children,
                [](const SyntaxNode& x) { return x.head() == ":state-variables"; });
  require_agents(*define);
  expand_schemata(*define);
  for (auto& section : define->children)
    if (is_action(section))
      translate_action(section);
    else if (section.head() == ":derived" && section.children.size() == 3)
      formulas_.condition(section.children[2]);
  add_predicates(*define);
}

void MaplTranslation::declare(const SyntaxNode& section) {
  std::vector<const SyntaxNode*> pending;
  const auto& x = section.children;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i].is_list) {
      pending.push_back(&x[i]);
    } else if (x[i].word == "-" && i + 1 < x.size()) {
      for (const auto* node : pending)
        declare(*node, x[i + 1]);
      pending.clear();
      ++i;
    } else {
      context_.error(x[i], "the word " + in_quotes(x[i].word) + " stands among state variables",
                     "write (VARIABLE ?x - TYPE ...) - TYPE");
    }
  }
  for (const auto* node : pending)
    context_.error(*node, "the type of the state variable's values is missing",
                   "write '- TYPE' after it");
}

void MaplTranslation::declare(const SyntaxNode& node, const SyntaxNode& type) {
  const auto name = node.head();
  if (name.empty() || name.front() == '?') {
    context_.error(node, "a state variable is declared without a name",
                   "write (VARIABLE ?x - TYPE ...) - TYPE");
    return;
  }
  const std::string text(name);
  StateVariable result;
  result.name = name;
  result.type = type;
  result.known = words_.make("K " + text);
  result.excluded = words_.make("excluded " + text);
  result.possible = words_.make("possible " + text);
  const auto object = word_node("object", node.offset);
  std::size_t untyped = 0;
  const auto& x = node.children;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i].word == "-" && i + 1 < x.size()) {
      for (; untyped < result.parameters.size(); ++untyped)
        result.parameters[untyped].type = x[i + 1];
      ++i;
    } else {
      result.parameters.push_back({x[i], object});
    }
  }
  if (!variables_.emplace(name, std::move(result)).second)
    context_.error(node, "the state variable " + in_quotes(name) + " is declared twice",
                   "remove one of the two");
}

void MaplTranslation::require_agents(const SyntaxNode& define) {
  const bool has_agents = std::ranges::any_of(define.children, [](const SyntaxNode& x) {
    return x.head() == ":types" &&
           std::ranges::find(x.children, "agent", &SyntaxNode::word) != x.children.end();
  });
  if (!has_agents && !variables_.empty())
    context_.error(define, "a domain with state variables needs the type 'agent'",
                   "declare it in (:types agent - object ...)");
}

void MaplTranslation::expand_schemata(SyntaxNode& define) {
  std::vector<SyntaxNode> expanded;
  for (auto& section : define.children) {
    const auto* parameters = is_action(section) ? find_part(section, ":parameters") : nullptr;
    const SyntaxNode* variable = nullptr;
    if (parameters && section.children.size() > 1) {
      const auto found = std::ranges::find_if(parameters->children, is_schema_variable);
      if (found != parameters->children.end())
        variable = &*found;
      if (variable && found + 1 != parameters->children.end()) {
        context_.error(*(found + 1),
                       "something follows " + in_quotes(variable->word) +
                         ", which stands for any state variable",
                       "write it at the end of :parameters, without a type");
        continue;
      }
    }
    if (!variable) {
      expanded.push_back(std::move(section));
      continue;
    }
    const auto word = variable->word;
    for (const auto& [name, x] : variables_) {
      auto copy = section;
      copy.children[1].word =
        words_.make(std::string(copy.children[1].word) + "-" + std::string(name));
      auto& list = part(copy, ":parameters");
      list.children.pop_back();
      std::vector<SyntaxNode> term{word_node(name, section.offset)};
      for (const auto& parameter : x.parameters) {
        const auto own =
          word_node(words_.make(std::string(parameter.name.word) + " of " + std::string(name)),
                    parameter.name.offset);
        list.children.insert(list.children.end(),
                             {own, word_node("-", section.offset), parameter.type});
        term.push_back(own);
      }
      replace_word(copy, word, list_node(std::move(term), section.offset));
      expanded.push_back(std::move(copy));
    }
  }
  define.children = std::move(expanded);
}

void MaplTranslation::translate_action(SyntaxNode& section) {
  if (section.children.size() < 2)
    return;
  const auto agents = take_part(section, ":agent");
  const auto further = take_part(section, ":variables");
  auto& parameters = part(section, ":parameters").children;
  parameters.insert(parameters.begin(), agents.children.begin(), agents.children.end());
  parameters.insert(parameters.end(), further.children.begin(), further.children.end());
  const SyntaxNode* actor = agents.children.empty() ? nullptr : &agents.children.front();
  const auto* stated = find_part(section, ":precondition");
  const auto precondition = stated ? std::optional(*stated) : std::nullopt;
  if (stated)
    formulas_.condition(part(section, ":precondition"));
  if (find_part(section, ":effect"))
    formulas_.effect(part(section, ":effect"), actor, precondition ? &*precondition : nullptr);
  if (section.head() == ":sensor")
    add_sensing(section, actor);
  else if (const auto* sense = find_part(section, ":sense"))
    context_.error(*sense, "an action has no part ':sense'", "write (:sensor NAME ...) instead");
  add_replanning(section);
}

void MaplTranslation::add_sensing(SyntaxNode& section, const SyntaxNode* actor) {
  auto sensed = take_part(section, ":sense");
  const auto offset = sensed.offset;
  if (sensed.children.empty() || !actor) {
    context_.error(section, "a sensor needs an agent, and what it senses",
                   "write :agent (?a - agent) :sense (VARIABLE ARGUMENT ...)");
    return;
  }
  const bool has_value =
    sensed.head() == "=" ||
    std::ranges::find(sensed.children, ":", &SyntaxNode::word) != sensed.children.end();
  std::optional<ValueTerm> term;
  if (has_value) {
    term = formulas_.value_term(sensed);
  } else if (const auto* variable = formulas_.variable_of(sensed)) {
    term = ValueTerm{variable, {sensed.children.begin() + 1, sensed.children.end()}, {}};
  }
  if (!term)
    return;
  auto known = MaplFormulas::known_atom(*term->variable, *actor, term->arguments, offset);
  const auto lacks = [&](SyntaxNode condition) {
    require(section, list_node({word_node("not", offset), std::move(condition)}, offset));
  };
  lacks(known);
  if (find_part(section, ":negcondition"))
    formulas_.condition(part(section, ":negcondition"));
  else if (has_value)
    part(section, ":negcondition") = MaplFormulas::excluded_atom(*term, offset);
  if (has_value)
    lacks(MaplFormulas::excluded_atom(*term, offset));
  if (const auto* in_vain = find_part(section, ":negcondition"))
    lacks(*in_vain);
  auto& effect = part(section, ":effect");
  effect = list_node({word_node("and", offset), std::move(effect), std::move(known)}, offset);
}

void MaplTranslation::add_replanning(SyntaxNode& section) {
  if (!find_part(section, ":replan"))
    return;
  auto& replan = part(section, ":replan");
  formulas_.condition(replan);
  const auto condition = replan;
  // Promised for later only: what is known already has to be planned for.
  auto before = at_start(condition);
  require(section, condition);
  require(section,
          list_node({word_node("not", condition.offset), std::move(before)}, condition.offset));
}

SyntaxNode MaplTranslation::at_start(const SyntaxNode& condition) {
  auto result = condition;
  const auto head = result.head();
  if (head.empty() || head == "=")
    return result;
  if (head == "and" || head == "or" || head == "not" || head == "imply" || head == "forall" ||
      head == "exists") {
    for (std::size_t i = head == "forall" || head == "exists" ? 2 : 1; i < result.children.size();
         ++i)
      result.children[i] = at_start(result.children[i]);
    return result;
  }
  const auto name = words_.make(std::string(head) + " at start");
  result.children.front().word = name;
  at_start_.emplace(head, name);
  return result;
}

void MaplTranslation::add_predicates(SyntaxNode& define) const {
  auto section = std::ranges::find(define.children, ":predicates", &SyntaxNode::head);
  if (section == define.children.end()) {
    auto added = list_node({word_node(":predicates", define.offset)}, define.offset);
    define.children.push_back(std::move(added));
    section = define.children.end() - 1;
  }
  auto& declared = section->children;
  for (const auto& [name, x] : variables_) {
    const auto& type = x.type;
    const auto offset = type.offset;
    std::vector<SyntaxNode> parameters;
    for (const auto& parameter : x.parameters)
      parameters.insert(parameters.end(), {parameter.name, word_node("-", offset), parameter.type});
    const auto with_value = [&](std::string_view predicate) {
      auto node = list_node({word_node(predicate, offset)}, offset);
      node.children.insert(node.children.end(), parameters.begin(), parameters.end());
      node.children.insert(node.children.end(),
                           {word_node("?value", offset), word_node("-", offset), type});
      return node;
    };
    declared.insert(declared.end(),
                    {with_value(name), with_value(x.excluded), with_value(x.possible)});
    auto known = list_node({word_node(x.known, offset), word_node("?agent", offset),
                            word_node("-", offset), word_node("agent", offset)},
                           offset);
    known.children.insert(known.children.end(), parameters.begin(), parameters.end());
    declared.push_back(std::move(known));
  }
  std::vector<SyntaxNode> copies;
  for (const auto& [name, copy] : at_start_) {
    const auto original = std::ranges::find(declared, name, &SyntaxNode::head);
    if (original == declared.end())
      continue;
    copies.push_back(*original);
    copies.back().children.front().word = copy;
  }
  declared.insert(declared.end(), copies.begin(), copies.end());
}

} // namespace castor::planning
