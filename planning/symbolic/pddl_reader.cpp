#include "castor/planning/symbolic/pddl_reader.hpp"

#include "castor/base/file_access.hpp"
#include "castor/base/text.hpp"
#include "castor/planning/symbolic/mapl_translation.hpp"
#include "castor/planning/symbolic/section_reader.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace castor::planning {

namespace {

void ignore_section(const SyntaxNode&) {
  // nop
}

void read_initial(ReadingContext& context, const SyntaxNode& section) {
  for (std::size_t i = 1; i < section.children.size(); ++i) {
    const auto& node = section.children[i];
    if (node.head() == "not" && node.children.size() == 2)
      continue; // What is not stated is false.
    if (node.head() == "=") {
      std::int64_t number = 0;
      if (node.children.size() != 3 || node.children[2].is_list) {
        context.error(node, "the value of a function is missing",
                      "write (= (FUNCTION OBJECT ...) NUMBER)");
        continue;
      }
      const auto word = node.children[2].word;
      if (word.size() > 9 || !std::ranges::all_of(word, is_digit)) {
        context.error(node.children[2], in_quotes(word) + " is no whole number below 10^9",
                      "multiply all costs by the same number, and round them");
        continue;
      }
      for (const char c : word)
        number = number * 10 + (c - '0');
      auto atom = read_ground_atom(context, node.children[1], true);
      if (!atom.empty())
        context.task.function_values[std::move(atom)] = number;
      continue;
    }
    auto atom = read_ground_atom(context, node, false);
    if (atom.empty())
      continue;
    const auto& predicate = context.task.predicates[static_cast<std::size_t>(atom.front())];
    if (predicate.is_derived)
      context.error(node,
                    "the derived predicate " + in_quotes(predicate.name) + " cannot be stated",
                    "state the predicates that it is derived from");
    context.task.initial.push_back(std::move(atom));
  }
}

void read_problem(ReadingContext& context, const std::vector<SyntaxNode>& top) {
  bool has_goal = false;
  const auto domain = [&](const SyntaxNode& x) {
    if (x.children.size() != 2 || x.children[1].word != context.task.domain)
      context.warning(x, "the problem is of another domain than " + in_quotes(context.task.domain),
                      "check that the domain's file is the right one");
  };
  const auto goal = [&](const SyntaxNode& x) {
    if (x.children.size() != 2 || has_goal) {
      context.error(x, "a problem has one goal", "write (:goal (and ...)) once");
      return;
    }
    has_goal = true;
    VariableScope scope;
    context.task.goal = read_formula(context, x.children[1], scope);
    context.task.goal_variables = std::move(scope.all);
  };
  const auto metric = [&](const SyntaxNode& x) {
    if (x.children.size() == 3 && x.children[1].word == "minimize" &&
        (x.children[2].head() == "total-cost" || x.children[2].word == "total-cost"))
      context.task.has_costs = true;
    else
      context.error(x, "this metric is not supported", "write (:metric minimize (total-cost))");
  };
  const auto errors = context.problems.size();
  context.task.problem =
    read_sections(context, top, "problem",
                  {{":domain", domain},
                   {":requirements", [&](const SyntaxNode& x) { read_requirements(context, x); }},
                   {":objects", [&](const SyntaxNode& x) { read_objects(context, x); }},
                   {":init", [&](const SyntaxNode& x) { read_initial(context, x); }},
                   {":goal", goal},
                   {":metric", metric},
                   {":length", ignore_section}});
  if (!has_goal && context.problems.size() == errors)
    context.error(top.empty() ? SyntaxNode{} : top.front(), "the problem has no goal",
                  "add a section (:goal CONDITION)");
}

/// Ancestors of a type, with itself.
std::set<int> ancestors_of(const LiftedTask& task, int type) {
  std::set<int> result{type};
  std::vector<int> pending{type};
  while (!pending.empty()) {
    const int next = pending.back();
    pending.pop_back();
    for (const int x : task.types[static_cast<std::size_t>(next)].parents)
      if (result.insert(x).second)
        pending.push_back(x);
  }
  result.insert(0);
  return result;
}

void list_objects_of_types(LiftedTask& task) {
  std::vector<std::set<int>> ancestors;
  for (std::size_t i = 0; i < task.types.size(); ++i)
    ancestors.push_back(ancestors_of(task, static_cast<int>(i)));
  for (std::size_t i = 0; i < task.objects.size(); ++i)
    for (const int x : ancestors[static_cast<std::size_t>(task.objects[i].type)])
      task.types[static_cast<std::size_t>(x)].objects.push_back(static_cast<int>(i));
}

} // namespace

PddlResult parse_pddl(const std::string& domain_file, std::string domain_text,
                      const std::string& problem_file, std::string problem_text) {
  ReadingContext context;
  declare_type(context, "object");
  const PddlText domain(domain_file, std::move(domain_text));
  const PddlText problem(problem_file, std::move(problem_text));
  // Nodes refer to the texts, and tables of names to the nodes.
  context.text = &domain;
  MaplTranslation mapl(context);
  auto domain_tree = parse_syntax(domain, context.problems);
  mapl.domain(domain_tree);
  read_domain(context, domain_tree);
  check_stratification(context, domain_tree.empty() ? SyntaxNode{} : domain_tree.front());
  const auto by_line = [](const Diagnostic& a, const Diagnostic& b) {
    return a.where.line() != b.where.line() ? a.where.line() < b.where.line() : a.column < b.column;
  };
  std::ranges::stable_sort(context.problems, by_line);
  const auto in_domain = static_cast<std::ptrdiff_t>(context.problems.size());
  // With errors in the domain, what is found in the problem may be their consequence.
  if (!has_errors(context.problems)) {
    context.text = &problem;
    auto problem_tree = parse_syntax(problem, context.problems);
    mapl.problem(problem_tree);
    read_problem(context, problem_tree);
    std::stable_sort(context.problems.begin() + in_domain, context.problems.end(), by_line);
  }
  if (!has_errors(context.problems)) {
    list_objects_of_types(context.task);
    mapl.complete(context.task);
  }
  return {std::move(context.task), std::move(context.problems)};
}

PddlResult read_pddl(const std::filesystem::path& domain, const std::filesystem::path& problem) {
  PddlResult result;
  const auto load = [&](const std::filesystem::path& file) {
    auto content = read_file(file.string(), most_pddl_bytes);
    if (content.text && content.text->size() > most_pddl_bytes) {
      content.text.reset();
      content.error = "the file is longer than " + std::to_string(most_pddl_bytes >> 20) + " MiB";
    }
    if (!content.text) {
      Diagnostic unread;
      unread.where = SourceLocation(file.string(), 0);
      unread.message = "cannot read the file: " + content.error;
      unread.remedy =
        "give a file of PDDL of at most " + std::to_string(most_pddl_bytes >> 20) + " MiB";
      result.problems.push_back(std::move(unread));
    }
    return content.text ? std::move(*content.text) : std::string();
  };
  auto domain_text = load(domain);
  auto problem_text = load(problem);
  if (!result.problems.empty())
    return result;
  return parse_pddl(domain.string(), std::move(domain_text), problem.string(),
                    std::move(problem_text));
}

} // namespace castor::planning
