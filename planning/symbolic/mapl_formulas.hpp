#pragma once

#include "castor/planning/symbolic/reading_context.hpp"
#include "castor/planning/symbolic/syntax_tree.hpp"

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Conditions and effects of MAPL (Brenner and Nebel 2009), written as PDDL: a state variable is a
/// predicate whose last argument is the value; that an agent knows its value is a predicate, too.
namespace castor::planning {

/// Words that stand in no file. They have blanks, so they are none of the file's.
class MadeWords {
public:
  std::string_view make(std::string word) { return words_.emplace_back(std::move(word)); }

private:
  /// Its elements stay where they are.
  std::deque<std::string> words_;
};

SyntaxNode word_node(std::string_view word, std::uint32_t offset);
SyntaxNode list_node(std::vector<SyntaxNode> children, std::uint32_t offset);

struct TypedName {
  SyntaxNode name;
  SyntaxNode type;
};

/// (pos ?o - thing) - room.
struct StateVariable {
  std::string_view name;
  std::vector<TypedName> parameters;
  SyntaxNode type;
  /// Predicates: an agent knows the value; a value is impossible; the problem states it as
  /// possible.
  std::string_view known;
  std::string_view excluded;
  std::string_view possible;
};

using StateVariables = std::map<std::string_view, StateVariable>;

/// (= (pos ?o) ?r) or (pos ?o : ?r).
struct ValueTerm {
  const StateVariable* variable = nullptr;
  std::vector<SyntaxNode> arguments;
  SyntaxNode value;
};

class MaplFormulas {
public:
  MaplFormulas(ReadingContext& context, MadeWords& words, const StateVariables& variables)
    : context_(context), words_(words), variables_(variables) {
    // nop
  }

  /// Rewrites a condition. A value that is not known is neither equal to another nor different.
  void condition(SyntaxNode& node, bool is_negated = false);

  /// Rewrites an effect. The actor knows the value that it assigns, and nobody else does any more.
  /// @param actor null if the action has no agent
  /// @param precondition of the action, as the file has it; null for none
  void effect(SyntaxNode& node, const SyntaxNode* actor, const SyntaxNode* precondition);

  /// The variable and the value of (= (pos ?o) ?r), (assign ...), (in-domain ...) or (pos ?o : ?r);
  /// nothing after a message.
  std::optional<ValueTerm> value_term(const SyntaxNode& node);

  /// The state variable that (pos ?o) names; null after a message.
  const StateVariable* variable_of(const SyntaxNode& node);

  /// Whether it is written like (= (pos ?o) ?r) or (pos ?o ...).
  bool is_about_value(const SyntaxNode& node) const;

  // Atoms of the predicates that a state variable becomes.
  static SyntaxNode value_atom(const ValueTerm& term, std::uint32_t offset);
  static SyntaxNode excluded_atom(const ValueTerm& term, std::uint32_t offset);
  static SyntaxNode known_atom(const StateVariable& variable, const SyntaxNode& agent,
                               const std::vector<SyntaxNode>& arguments, std::uint32_t offset);

private:
  bool is_variable(const SyntaxNode& node) const { return variables_.contains(node.head()); }
  void know(SyntaxNode& node);
  SyntaxNode differs(const ValueTerm& term, std::uint32_t offset);
  SyntaxNode assignment(const ValueTerm& term, const SyntaxNode* actor,
                        const SyntaxNode* precondition, std::uint32_t offset);
  const SyntaxNode* former_value(const ValueTerm& term, const SyntaxNode* precondition);

  ReadingContext& context_;
  MadeWords& words_;
  const StateVariables& variables_;
  std::size_t made_ = 0;
};

} // namespace castor::planning
