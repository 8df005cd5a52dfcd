#include "castor/communication/dialogue/realisation_target.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace castor::communication {

namespace {

constexpr std::size_t max_predications = 64;

/// A variable of an entry that nothing has been found for.
constexpr TargetIndex unbound = -1;

bool bind(TargetIndex& variable, NominalId nominal) {
  const auto index = static_cast<TargetIndex>(nominal);
  if (variable != unbound && variable != index)
    return false;
  variable = index;
  return true;
}

} // namespace

RealisationTarget::RealisationTarget(const LogicalForm& form, const Lexicon& lexicon)
  : lexicon_(lexicon) {
  const auto index = [&form](const std::string& name) {
    const auto place =
      std::find_if(form.nominals.begin(), form.nominals.end(),
                   [&name](const Nominal& nominal) { return nominal.name == name; });
    return place == form.nominals.end() ? -1 : static_cast<int>(place - form.nominals.begin());
  };
  using Kind = Predication::Kind;
  root_ = index(form.root);
  for (const auto& nominal : form.nominals) {
    const auto head = static_cast<NominalId>(index(nominal.name));
    if (!nominal.sort.empty())
      predications_.push_back({head, Kind::sort, 0, symbol(nominal.sort, false), 0});
    if (!nominal.proposition.empty())
      predications_.push_back(
        {head, Kind::proposition, 0, symbol(nominal.proposition, nominal.sort == "name"), 0});
    for (const auto& feature : nominal.features)
      predications_.push_back(
        {head, Kind::feature, symbol(feature.name, false), symbol(feature.value, false), 0});
    for (const auto& relation : nominal.relations) {
      const auto dependent = index(relation.dependent);
      is_sayable_ = is_sayable_ && dependent >= 0;
      predications_.push_back(
        {head, Kind::relation, symbol(relation.mode, false), 0, static_cast<NominalId>(dependent)});
    }
  }
  is_sayable_ =
    is_sayable_ && root_ >= 0 && !predications_.empty() && predications_.size() <= max_predications;
  about_.resize(form.nominals.size());
  for (std::size_t i = 0; is_sayable_ && i < predications_.size(); ++i) {
    about_[predications_[i].nominal] |= std::uint64_t{1} << i;
    if (predications_[i].kind == Kind::relation)
      about_[predications_[i].dependent] |= std::uint64_t{1} << i;
  }
}

Symbol RealisationTarget::symbol(const std::string& text, bool may_be_quoted) {
  if (const auto known = lexicon_.symbols().find(text); known != 0)
    return known;
  is_sayable_ = is_sayable_ && may_be_quoted;
  quotations_.push_back(text);
  return lexicon_.symbols().size() + static_cast<Symbol>(quotations_.size()) - 1;
}

std::uint64_t RealisationTarget::all() const {
  return predications_.size() == max_predications ? ~std::uint64_t{0}
                                                  : (std::uint64_t{1} << predications_.size()) - 1;
}

std::vector<EntryUse> RealisationTarget::uses(const LexicalEntry& entry) const {
  std::vector<EntryUse> found;
  // Most entries say something that the target does not.
  const bool may_be_used = std::ranges::all_of(entry.predications, [&](auto& pattern) {
    return std::ranges::any_of(predications_,
                               [&](auto& target) { return is_same(pattern, target, entry); });
  });
  if (!may_be_used)
    return found;
  std::vector<TargetIndex> variables(256, unbound);
  EntryUse use;
  use.text = entry.phrase;
  match(entry, 0, variables, use, found);
  return found;
}

bool RealisationTarget::is_same(const Predication& pattern, const Predication& target,
                                const LexicalEntry& entry) const {
  if (pattern.kind != target.kind || pattern.name != target.name)
    return false;
  if (pattern.value == target.value)
    return true;
  return target.value >= lexicon_.symbols().size() &&
         pattern.kind == Predication::Kind::proposition && entry.phrase == quoted_word;
}

void RealisationTarget::match(const LexicalEntry& entry, std::size_t next,
                              std::vector<TargetIndex>& variables, const EntryUse& use,
                              std::vector<EntryUse>& found) const {
  if (next == entry.predications.size()) {
    found.push_back(use);
    for (const auto variable : entry.indices)
      found.back().indices.push_back(variables[variable] == unbound ? -1 - variable
                                                                    : variables[variable]);
    return;
  }
  const auto& pattern = entry.predications[next];
  const bool is_relation = pattern.kind == Predication::Kind::relation;
  const auto before = std::pair(variables[pattern.nominal], variables[pattern.dependent]);
  for (std::size_t i = 0; i < predications_.size(); ++i) {
    const auto& target = predications_[i];
    const auto bit = std::uint64_t{1} << i;
    if ((use.coverage & bit) != 0 || !is_same(pattern, target, entry))
      continue;
    if (bind(variables[pattern.nominal], target.nominal) &&
        (!is_relation || bind(variables[pattern.dependent], target.dependent))) {
      auto longer = use;
      longer.coverage |= bit;
      if (entry.phrase == quoted_word && target.value >= lexicon_.symbols().size())
        longer.text = "'" + quotations_[target.value - lexicon_.symbols().size()] + "'";
      match(entry, next + 1, variables, longer, found);
    }
    std::tie(variables[pattern.nominal], variables[pattern.dependent]) = before;
  }
}

} // namespace castor::communication
