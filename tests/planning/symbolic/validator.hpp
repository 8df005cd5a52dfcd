#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// The meaning of PDDL once more, as slow and as simple as it can be: nothing is shared with the
/// planner whose plans it judges. The text has to be valid PDDL.
namespace castor::test {

struct Expression {
  std::string word;
  std::vector<Expression> parts;

  std::string head() const { return parts.empty() ? std::string() : parts.front().word; }
};

/// True atoms: "(on a b)".
using Atoms = std::set<std::string>;

class PddlModel {
public:
  PddlModel(const std::string& domain, const std::string& problem);

  const Atoms& initial() const { return initial_; }
  bool is_goal(const Atoms& state) const;

  /// The state after the action, "stack a b"; nothing if it does not exist or is not applicable.
  std::optional<Atoms> after(const Atoms& state, const std::string& action) const;

  long cost_of(const std::string& action) const;

  /// All actions with objects of the right types, applicable or not.
  std::vector<std::string> all_actions() const;

private:
  using Values = std::map<std::string, std::string>;
  using Names = std::vector<std::pair<std::string, std::vector<std::string>>>;

  struct Action {
    Names parameters;
    Expression precondition;
    Expression effect;
  };

  void read(const Expression& define);
  static Names typed(const std::vector<Expression>& list);
  std::vector<std::string> objects_of(const std::vector<std::string>& types) const;
  bool is_subtype(const std::string& type, const std::string& of, int depth = 0) const;
  static std::string atom(const Expression& x, const Values& values);
  bool holds(const Expression& x, const Values& values, const Atoms& state) const;
  void collect(const Expression& effect, const Values& values, const Atoms& state, Atoms& added,
               Atoms& deleted) const;
  void bind(const Names& names, std::size_t next, Values& values, std::vector<Values>& all) const;
  Atoms derived(Atoms state) const;
  std::optional<std::pair<const Action*, Values>> find(const std::string& action) const;
  long summed_cost(const Expression& effect, const Values& values) const;

  std::map<std::string, std::vector<std::string>> supertypes_;
  Names objects_;
  std::map<std::string, Action> actions_;
  /// Heads and bodies.
  std::vector<std::pair<Expression, Expression>> axioms_;
  std::map<std::string, long> functions_;
  Atoms initial_;
  Expression goal_;
  bool has_costs_ = false;
};

/// Empty if the plan is right and costs this; else what is wrong.
std::string validate(const PddlModel& model, const std::vector<std::string>& plan, long cost);

} // namespace castor::test
