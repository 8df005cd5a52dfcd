#include "castor/communication/parsing/meaning.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>

namespace castor::communication {

namespace {

constexpr NominalId unanchored = 1U << 24;

/// Which nominals are one.
class NominalSubstitution {
public:
  void unify(NominalId a, NominalId b) {
    a = resolve(a);
    b = resolve(b);
    if (a == b)
      return;
    const auto from = std::max(a, b);
    const auto to = std::min(a, b);
    for (auto& pair : pairs_)
      if (pair.second == from)
        pair.second = to;
    pairs_.emplace_back(from, to);
  }

  NominalId resolve(NominalId nominal) const {
    for (const auto& [from, to] : pairs_)
      if (nominal == from)
        return to;
    return nominal;
  }

private:
  /// Nominals and what they stand for; no nominal is on both sides.
  std::vector<std::pair<NominalId, NominalId>> pairs_;
};

/// Two sorts, two propositions or two values of one feature.
bool contradict(const Predication& a, const Predication& b) {
  return a.kind == b.kind && a.kind != Predication::Kind::relation && a.nominal == b.nominal &&
         a.name == b.name && a.value != b.value;
}

} // namespace

NominalId nominal_of_word(std::size_t position, std::size_t variable, bool anchors) {
  return (anchors ? 0 : unanchored) | static_cast<NominalId>(position << 8) |
         static_cast<NominalId>(variable & 0xff);
}

std::string nominal_name(NominalId nominal) {
  const auto word = std::to_string(((nominal >> 8) & 0xffff) + 1);
  if ((nominal & unanchored) == 0)
    return "w" + word;
  const auto variable = nominal & 0xff;
  return "x" + word +
         (variable < 26 ? std::string(1, static_cast<char>('a' + variable))
                        : "_" + std::to_string(variable));
}

std::size_t Meaning::dependency_length() const {
  const auto position = [](NominalId id) { return static_cast<int>((id >> 8) & 0xffff); };
  std::size_t result = 0;
  for (const auto& x : predications)
    if (x.kind == Predication::Kind::relation)
      result += static_cast<std::size_t>(std::abs(position(x.nominal) - position(x.dependent)));
  return result;
}

std::optional<Meaning> unite(const Meaning& function, const Meaning& argument,
                             std::size_t result_atoms) {
  NominalSubstitution same;
  const auto shared = function.indices.size() - result_atoms;
  for (std::size_t i = 0; i < shared; ++i)
    same.unify(function.indices[result_atoms + i], argument.indices[i]);

  Meaning result;
  result.weight = function.weight + argument.weight;
  result.predications.reserve(function.predications.size() + argument.predications.size());
  for (const auto* part : {&function, &argument})
    for (auto predication : part->predications) {
      predication.nominal = same.resolve(predication.nominal);
      if (predication.kind == Predication::Kind::relation)
        predication.dependent = same.resolve(predication.dependent);
      result.predications.push_back(predication);
    }
  std::sort(result.predications.begin(), result.predications.end());
  result.predications.erase(std::unique(result.predications.begin(), result.predications.end()),
                            result.predications.end());
  if (std::adjacent_find(result.predications.begin(), result.predications.end(), contradict) !=
      result.predications.end())
    return std::nullopt;

  result.indices.reserve(result_atoms + argument.indices.size() - shared);
  for (std::size_t i = 0; i < result_atoms; ++i)
    result.indices.push_back(same.resolve(function.indices[i]));
  for (std::size_t i = shared; i < argument.indices.size(); ++i)
    result.indices.push_back(same.resolve(argument.indices[i]));

  result.choices.reserve(function.choices.size() + argument.choices.size());
  result.choices = function.choices;
  result.choices.insert(result.choices.end(), argument.choices.begin(), argument.choices.end());
  return result;
}

LogicalForm logical_form(const Meaning& meaning,
                         const std::function<std::string(Symbol)>& text_of) {
  std::map<NominalId, Nominal> nominals;
  const auto nominal = [&nominals](NominalId id) -> Nominal& {
    auto& found = nominals[id];
    if (found.name.empty())
      found.name = nominal_name(id);
    return found;
  };
  for (const auto& predication : meaning.predications) {
    auto& head = nominal(predication.nominal);
    switch (predication.kind) {
      case Predication::Kind::sort:
        head.sort = text_of(predication.value);
        break;
      case Predication::Kind::proposition:
        head.proposition = text_of(predication.value);
        break;
      case Predication::Kind::feature:
        head.features.push_back({text_of(predication.name), text_of(predication.value)});
        break;
      case Predication::Kind::relation:
        head.relations.push_back({text_of(predication.name), nominal(predication.dependent).name});
        break;
    }
  }
  LogicalForm form;
  form.preference = meaning.weight;
  if (!meaning.indices.empty())
    form.root = nominal(meaning.indices.front()).name;
  for (auto& [id, described] : nominals)
    form.nominals.push_back(std::move(described));
  return form;
}

} // namespace castor::communication
