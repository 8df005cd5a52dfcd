#pragma once

#include "castor/planning/symbolic/mapl_formulas.hpp"
#include "castor/planning/symbolic/reading_context.hpp"
#include "castor/planning/symbolic/syntax_tree.hpp"

#include <set>
#include <string_view>
#include <utility>
#include <vector>

/// Translation of MAPL, the multi-agent planning language (Brenner and Nebel 2009), to PDDL, before
/// it is read: see docs/planning.md for what is understood. What the nodes of the result refer to
/// lives as long as the translation.
namespace castor::planning {

class MaplTranslation {
public:
  explicit MaplTranslation(ReadingContext& context) : context_(context) {
    // nop
  }

  /// Does nothing but look for sections that need :mapl if the domain does not require it.
  void domain(std::vector<SyntaxNode>& top);
  void problem(std::vector<SyntaxNode>& top);

  /// Adds what follows from the facts of the problem: the planning agent knows the values that it
  /// states, what is not among the stated values is impossible, and which conditions for replanning
  /// hold in the beginning. Called once the objects of all types are known.
  void complete(LiftedTask& task) const;

private:
  void declare(const SyntaxNode& section);
  void declare(const SyntaxNode& node, const SyntaxNode& type);
  void add_predicates(SyntaxNode& define) const;
  void require_agents(const SyntaxNode& define);
  void expand_schemata(SyntaxNode& define);
  void translate_action(SyntaxNode& section);
  /// A part of an action, such as :effect; it may be missing, and is then added.
  static SyntaxNode& part(SyntaxNode& section, std::string_view name);
  static const SyntaxNode* find_part(const SyntaxNode& section, std::string_view name);
  static SyntaxNode take_part(SyntaxNode& section, std::string_view name);
  static void require(SyntaxNode& section, SyntaxNode condition);
  void add_sensing(SyntaxNode& section, const SyntaxNode* actor);
  void add_replanning(SyntaxNode& section);
  /// The condition of the state in which planning begins.
  SyntaxNode at_start(const SyntaxNode& condition);
  void translate_initial(SyntaxNode& section);
  void take_agent(SyntaxNode& define);
  void add_known_values(LiftedTask& task) const;
  void add_excluded_values(LiftedTask& task) const;

  ReadingContext& context_;
  MadeWords words_;
  StateVariables variables_;
  MaplFormulas formulas_{context_, words_, variables_};
  bool is_used_ = false;
  /// Predicates of conditions for replanning, and of the same in the beginning.
  std::set<std::pair<std::string_view, std::string_view>> at_start_;
  /// Name of the planning agent; empty if the problem does not say.
  std::string_view agent_;
};

} // namespace castor::planning
