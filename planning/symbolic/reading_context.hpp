#pragma once

#include "castor/planning/symbolic/lifted_task.hpp"
#include "castor/planning/symbolic/syntax_tree.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace castor::planning {

/// Names with their indices; the names are parts of the file's text.
class NameTable {
public:
  /// Index of the name, or -1.
  int find(std::string_view name) const {
    auto found = indices_.find(name);
    return found == indices_.end() ? -1 : found->second;
  }
  void add(std::string_view name, int index) { indices_.emplace(name, index); }

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> result;
    for (const auto& [name, index] : indices_)
      result.push_back(name);
    return result;
  }

private:
  std::unordered_map<std::string_view, int> indices_;
};

/// The variables that a formula may use, innermost last.
struct VariableScope {
  struct Entry {
    std::string_view name;
    int slot = 0;
  };
  std::vector<Entry> visible;
  /// All of the action, also those that are not visible.
  std::vector<Variable> all;
};

/// What is known while a domain and a problem are read.
struct ReadingContext {
  LiftedTask task;
  NameTable types;
  NameTable objects;
  NameTable predicates;
  NameTable functions;
  std::vector<Diagnostic> problems;
  /// The file that is being read.
  const PddlText* text = nullptr;

  void error(const SyntaxNode& node, std::string message, std::string remedy);
  void warning(const SyntaxNode& node, std::string message, std::string remedy);

  /// "did you mean 'x'?", or the remedy if no name is near.
  std::string suggestion(std::string_view word, const NameTable& names, std::string remedy) const;
};

/// Index of a type, or of the union of several: (either a b). -1 after a message.
int read_type(ReadingContext& context, const SyntaxNode& node);

/// "a b - t c - u": calls `f` with each name's node and its type.
template <class F>
void for_each_typed(ReadingContext& context, const std::vector<SyntaxNode>& nodes,
                    std::size_t begin, F&& f) {
  std::vector<const SyntaxNode*> names;
  const auto finish = [&](int type) {
    for (const auto* name : names)
      f(*name, type < 0 ? 0 : type);
    names.clear();
  };
  for (std::size_t i = begin; i < nodes.size(); ++i) {
    if (nodes[i].is_list) {
      context.error(nodes[i], "a list stands where a name is expected",
                    "write names, then '-' and their type");
    } else if (nodes[i].word != "-") {
      names.push_back(&nodes[i]);
    } else if (++i == nodes.size()) {
      context.error(nodes[i - 1], "a type is missing after '-'",
                    "write a type, such as '- object'");
    } else {
      finish(read_type(context, nodes[i]));
    }
  }
  finish(0);
}

/// Adds typed variables to the scope.
void read_variables(ReadingContext& context, const SyntaxNode& list, VariableScope& scope);

/// A condition, in negation normal form.
Formula read_formula(ReadingContext& context, const SyntaxNode& node, VariableScope& scope,
                     bool is_negated = false);

/// Effects and costs of an action.
void read_effects(ReadingContext& context, const SyntaxNode& node, VariableScope& scope,
                  ActionSchema& action);

/// The predicate or function and its arguments without variables; empty after a message.
AtomKey read_ground_atom(ReadingContext& context, const SyntaxNode& node, bool is_function);

} // namespace castor::planning
