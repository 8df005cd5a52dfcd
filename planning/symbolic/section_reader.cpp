#include "castor/planning/symbolic/section_reader.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace castor::planning {

namespace {

constexpr std::array<std::string_view, 14> supported_requirements{":strips",
                                                                  ":typing",
                                                                  ":equality",
                                                                  ":negative-preconditions",
                                                                  ":disjunctive-preconditions",
                                                                  ":existential-preconditions",
                                                                  ":universal-preconditions",
                                                                  ":quantified-preconditions",
                                                                  ":conditional-effects",
                                                                  ":derived-predicates",
                                                                  ":domain-axioms",
                                                                  ":action-costs",
                                                                  ":adl",
                                                                  ":mapl"};

constexpr std::array<std::string_view, 12> other_requirements{":fluents",
                                                              ":numeric-fluents",
                                                              ":object-fluents",
                                                              ":durative-actions",
                                                              ":duration-inequalities",
                                                              ":continuous-effects",
                                                              ":timed-initial-literals",
                                                              ":preferences",
                                                              ":constraints",
                                                              ":goal-utilities",
                                                              ":time",
                                                              ":multi-agent"};

} // namespace

void declare_type(ReadingContext& context, std::string_view name) {
  context.types.add(name, static_cast<int>(context.task.types.size()));
  context.task.types.push_back({std::string(name), {}, {}});
}

void read_requirements(ReadingContext& context, const SyntaxNode& section) {
  for (std::size_t i = 1; i < section.children.size(); ++i) {
    const auto& node = section.children[i];
    const auto is = [&](std::string_view x) { return x == node.word; };
    if (std::ranges::any_of(supported_requirements, is))
      continue;
    const std::vector<std::string_view> names(supported_requirements.begin(),
                                              supported_requirements.end());
    if (std::ranges::any_of(other_requirements, is)) {
      context.error(node, "the requirement " + in_quotes(node.word) + " is not supported",
                    "write the domain with these: " + list_of(names, names.size()));
    } else {
      auto remedy = did_you_mean(node.word, names);
      context.error(node, "there is no requirement " + in_quotes(node.word),
                    remedy.empty() ? "remove it, or use: " + list_of(names, names.size()) : remedy);
    }
  }
}

namespace {

void report_type_cycles(ReadingContext& context, const SyntaxNode& section) {
  const auto& types = context.task.types;
  // 0 not visited, 1 being visited, 2 done.
  std::vector<int> states(types.size(), 0);
  std::vector<std::pair<std::size_t, std::size_t>> path;
  for (std::size_t start = 0; start < types.size(); ++start) {
    if (states[start] != 0)
      continue;
    path.assign(1, {start, 0});
    states[start] = 1;
    while (!path.empty()) {
      auto& [type, next] = path.back();
      if (next == types[type].parents.size()) {
        states[type] = 2;
        path.pop_back();
        continue;
      }
      const auto parent = static_cast<std::size_t>(types[type].parents[next++]);
      if (states[parent] == 0) {
        states[parent] = 1;
        path.emplace_back(parent, 0);
      } else if (states[parent] == 1) {
        std::string cycle;
        const auto first = std::ranges::find(path, parent, [](const auto& x) { return x.first; });
        for (auto i = first; i != path.end(); ++i)
          cycle += types[i->first].name + " -> ";
        context.error(section, "type cycle: " + cycle + types[parent].name,
                      "remove one of these types from the other's subtypes");
      }
    }
  }
}

void read_types(ReadingContext& context, const SyntaxNode& section) {
  // Names first: a type may be used before it is declared, and after '-' it need not be.
  const auto& nodes = section.children;
  std::set<std::string_view> seen;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (nodes[i].is_list || nodes[i].word == "-")
      continue;
    const bool is_parent = !nodes[i - 1].is_list && nodes[i - 1].word == "-";
    if (!is_parent && nodes[i].word != "object" && !seen.insert(nodes[i].word).second)
      context.error(nodes[i], "the type " + in_quotes(nodes[i].word) + " is declared twice",
                    "remove one of the two");
    if (context.types.find(nodes[i].word) < 0)
      declare_type(context, nodes[i].word);
  }
  for_each_typed(context, nodes, 1, [&](const SyntaxNode& node, int parent) {
    const int type = context.types.find(node.word);
    if (type > 0)
      context.task.types[static_cast<std::size_t>(type)].parents.push_back(parent);
    else if (parent != 0)
      context.error(node, "the type 'object' has no supertype", "remove it from the types");
  });
  for (std::size_t i = 1; i < context.task.types.size(); ++i)
    if (context.task.types[i].parents.empty())
      context.task.types[i].parents.push_back(0);
  report_type_cycles(context, section);
}

} // namespace

void read_objects(ReadingContext& context, const SyntaxNode& section) {
  for_each_typed(context, section.children, 1, [&](const SyntaxNode& node, int type) {
    const int known = context.objects.find(node.word);
    if (known >= 0) {
      auto& object = context.task.objects[static_cast<std::size_t>(known)];
      if (object.type != type)
        context.error(node,
                      "the object " + in_quotes(node.word) + " is declared twice, with types " +
                        in_quotes(context.task.types[static_cast<std::size_t>(object.type)].name) +
                        " and " +
                        in_quotes(context.task.types[static_cast<std::size_t>(type)].name),
                      "remove one of the two");
      else
        context.warning(node, "the object " + in_quotes(node.word) + " is declared twice",
                        "remove one of the two");
      return;
    }
    if (node.word.front() == '?')
      context.error(node,
                    "the variable " + in_quotes(node.word) + " stands where an object is expected",
                    "write the object's name without '?'");
    context.objects.add(node.word, static_cast<int>(context.task.objects.size()));
    context.task.objects.push_back({std::string(node.word), type});
  });
}

namespace {

void read_declarations(ReadingContext& context, const SyntaxNode& section, bool is_function) {
  const std::string kind = is_function ? "function" : "predicate";
  auto& names = is_function ? context.functions : context.predicates;
  auto& declared = is_function ? context.task.functions : context.task.predicates;
  for (std::size_t i = 1; i < section.children.size(); ++i) {
    const auto& node = section.children[i];
    // (f ?x) - number
    if (is_function && !node.is_list && (node.word == "-" || node.word == "number"))
      continue;
    if (node.head().empty() || node.head() == "=" || node.head().front() == '?') {
      context.error(node, "a " + kind + " is declared without a name",
                    "write (" + kind + " ?x - TYPE ...) in parentheses");
      continue;
    }
    if (names.find(node.head()) >= 0) {
      context.error(node, "the " + kind + " " + in_quotes(node.head()) + " is declared twice",
                    "remove one of the two");
      continue;
    }
    SyntaxNode list;
    list.is_list = true;
    list.children.assign(node.children.begin() + 1, node.children.end());
    // Names of parameters mean nothing here, so they may be the same: (in ?obj ?obj).
    Predicate predicate;
    predicate.name = node.head();
    for_each_typed(context, list.children, 0, [&](const SyntaxNode& x, int type) {
      if (x.word.front() != '?')
        context.error(x, in_quotes(x.word) + " is no variable", "begin its name with '?'");
      predicate.parameters.push_back({std::string(x.word), type});
    });
    names.add(node.head(), static_cast<int>(declared.size()));
    declared.push_back(std::move(predicate));
  }
}

bool mentions_derived(const LiftedTask& task, const Formula& formula) {
  if (formula.kind == Formula::Kind::literal)
    return formula.literal.predicate >= 0 &&
           task.predicates[static_cast<std::size_t>(formula.literal.predicate)].is_derived;
  return std::ranges::any_of(formula.parts,
                             [&](const Formula& x) { return mentions_derived(task, x); });
}

void read_action(ReadingContext& context, const SyntaxNode& section,
                 std::set<std::string_view>& names) {
  const auto& nodes = section.children;
  if (nodes.size() < 2 || nodes[1].is_list) {
    context.error(section, "the action has no name", "write (:action NAME :parameters ...)");
    return;
  }
  if (!names.insert(nodes[1].word).second)
    context.error(nodes[1], "there are two actions " + in_quotes(nodes[1].word),
                  "rename one of the two");
  std::array<std::pair<std::string_view, const SyntaxNode*>, 5> parts{{{":parameters", nullptr},
                                                                       {":precondition", nullptr},
                                                                       {":effect", nullptr},
                                                                       {":replan", nullptr},
                                                                       {":negcondition", nullptr}}};
  for (std::size_t i = 2; i < nodes.size(); i += 2) {
    const auto part =
      std::ranges::find(parts, nodes[i].word, [](const auto& x) { return x.first; });
    if (nodes[i].is_list || part == parts.end()) {
      context.error(nodes[i],
                    "an action has no part " +
                      (nodes[i].is_list ? "like this list" : in_quotes(nodes[i].word)),
                    "the parts of an action are :parameters, :precondition and :effect");
      if (nodes[i].is_list)
        --i;
      continue;
    }
    if (i + 1 == nodes.size())
      context.error(nodes[i], "nothing stands after " + in_quotes(nodes[i].word),
                    "write a list, or ()");
    else if (part->second)
      context.error(nodes[i], "the action has two parts " + in_quotes(nodes[i].word),
                    "join the two with (and ...)");
    else
      part->second = &nodes[i + 1];
  }
  ActionSchema action;
  action.name = nodes[1].word;
  VariableScope scope;
  if (parts[0].second)
    read_variables(context, *parts[0].second, scope);
  action.parameters = scope.all.size();
  if (parts[1].second)
    action.precondition = read_formula(context, *parts[1].second, scope);
  if (parts[2].second)
    read_effects(context, *parts[2].second, scope, action);
  else
    context.warning(nodes[1], "the action " + in_quotes(nodes[1].word) + " has no effect",
                    "add :effect, or remove the action");
  if (section.head() == ":sensor")
    action.kind = ActionKind::sensor;
  if (parts[3].second) {
    action.kind = ActionKind::assertion;
    action.replan = read_formula(context, *parts[3].second, scope);
    if (mentions_derived(context.task, action.replan))
      context.error(*parts[3].second, "a condition for replanning uses a derived predicate",
                    "write the predicates that it is derived from");
  }
  if (parts[4].second)
    action.negative_outcome = read_formula(context, *parts[4].second, scope);
  action.variables = std::move(scope.all);
  context.task.actions.push_back(std::move(action));
}

void read_axiom(ReadingContext& context, const SyntaxNode& section) {
  const auto& nodes = section.children;
  if (nodes.size() != 3 || nodes[1].head().empty()) {
    context.error(section, "a derived predicate has a head and a condition",
                  "write (:derived (PREDICATE ?x - TYPE) CONDITION)");
    return;
  }
  const int predicate = context.predicates.find(nodes[1].head());
  if (predicate < 0) {
    context.error(nodes[1], "there is no predicate " + in_quotes(nodes[1].head()),
                  context.suggestion(nodes[1].head(), context.predicates,
                                     "declare it in the section (:predicates ...)"));
    return;
  }
  SyntaxNode list;
  list.is_list = true;
  list.offset = nodes[1].offset;
  list.children.assign(nodes[1].children.begin() + 1, nodes[1].children.end());
  VariableScope scope;
  read_variables(context, list, scope);
  const auto& declared = context.task.predicates[static_cast<std::size_t>(predicate)];
  if (declared.parameters.size() != scope.all.size()) {
    context.error(nodes[1],
                  in_quotes(declared.name) + " has " + std::to_string(declared.parameters.size()) +
                    " arguments, not " + std::to_string(scope.all.size()),
                  "write as many variables as the predicate is declared with");
    return;
  }
  AxiomSchema axiom;
  axiom.predicate = predicate;
  axiom.body = read_formula(context, nodes[2], scope);
  axiom.variables = std::move(scope.all);
  context.task.axioms.push_back(std::move(axiom));
}

} // namespace

std::string read_sections(ReadingContext& context, const std::vector<SyntaxNode>& top,
                          std::string_view kind, const std::vector<Section>& readers) {
  const SyntaxNode* define = nullptr;
  for (const auto& x : top)
    if (x.head() == "define")
      define = &x;
  if (!define || define->children.size() < 2 || define->children[1].head() != kind ||
      define->children[1].children.size() != 2) {
    context.error(define ? *define : (top.empty() ? SyntaxNode{} : top.front()),
                  "the file does not begin with (define (" + std::string(kind) + " NAME)",
                  "check that the domain and the problem are given in this order");
    return {};
  }
  for (const auto& [name, read] : readers)
    for (std::size_t i = 2; i < define->children.size(); ++i)
      if (define->children[i].head() == name)
        read(define->children[i]);
  for (std::size_t i = 2; i < define->children.size(); ++i) {
    const auto& node = define->children[i];
    const auto is = [&](const Section& x) { return x.first == node.head(); };
    if (std::ranges::none_of(readers, is)) {
      NameTable names;
      for (const auto& x : readers)
        names.add(x.first, 0);
      context.error(
        node,
        "a " + std::string(kind) + " has no section " +
          (node.head().empty() ? "like this" : in_quotes(node.head())),
        context.suggestion(node.head(), names, "the sections are " + list_of(names.names(), 20)));
    }
  }
  return std::string(define->children[1].children[1].word);
}

void read_domain(ReadingContext& context, const std::vector<SyntaxNode>& top) {
  std::set<std::string_view> actions;
  const auto derived = [&](const SyntaxNode& x) {
    if (x.children.size() < 2)
      return;
    const int predicate = context.predicates.find(x.children[1].head());
    if (predicate >= 0)
      context.task.predicates[static_cast<std::size_t>(predicate)].is_derived = true;
  };
  context.task.domain = read_sections(
    context, top, "domain",
    {{":requirements", [&](const SyntaxNode& x) { read_requirements(context, x); }},
     {":types", [&](const SyntaxNode& x) { read_types(context, x); }},
     {":constants", [&](const SyntaxNode& x) { read_objects(context, x); }},
     {":predicates", [&](const SyntaxNode& x) { read_declarations(context, x, false); }},
     {":functions", [&](const SyntaxNode& x) { read_declarations(context, x, true); }},
     {":derived", derived},
     {":derived", [&](const SyntaxNode& x) { read_axiom(context, x); }},
     {":action", [&](const SyntaxNode& x) { read_action(context, x, actions); }},
     {":sensor", [&](const SyntaxNode& x) { read_action(context, x, actions); }}});
}

void check_stratification(ReadingContext& context, const SyntaxNode& domain) {
  const auto count = context.task.predicates.size();
  std::vector<std::size_t> levels(count, 0);
  bool has_changed = true;
  std::function<std::size_t(const Formula&)> level_of = [&](const Formula& formula) {
    std::size_t result = 0;
    if (formula.kind == Formula::Kind::literal) {
      if (formula.literal.predicate >= 0 &&
          context.task.predicates[static_cast<std::size_t>(formula.literal.predicate)].is_derived)
        result = levels[static_cast<std::size_t>(formula.literal.predicate)] +
                 (formula.literal.is_negated ? 1 : 0);
      return result;
    }
    for (const auto& x : formula.parts)
      result = std::max(result, level_of(x));
    return result;
  };
  while (has_changed) {
    has_changed = false;
    for (const auto& axiom : context.task.axioms) {
      auto& level = levels[static_cast<std::size_t>(axiom.predicate)];
      const auto needed = level_of(axiom.body);
      if (needed <= level)
        continue;
      if (needed > count) {
        context.error(
          domain,
          "the derived predicate " +
            in_quotes(context.task.predicates[static_cast<std::size_t>(axiom.predicate)].name) +
            " depends on its own negation",
          "break the cycle of (:derived ...) that negates it");
        return;
      }
      level = needed;
      has_changed = true;
    }
  }
}

} // namespace castor::planning
