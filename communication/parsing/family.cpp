#include "castor/communication/parsing/family.hpp"

#include <algorithm>
#include <map>

namespace castor::communication {

namespace {

constexpr const char* predicate_mark = "*";

void substitute(Category& category, FeatureValue variable, FeatureValue value) {
  for (auto& feature : category.result.features)
    if (feature == variable)
      feature = value;
  for (auto& argument : category.arguments)
    substitute(argument.category, variable, value);
}

/// Makes one entry of one line of a family, for one word.
class EntryMaker {
public:
  EntryMaker(const FamilyEntry& line, const FamilyWord& word,
             const FeatureDeclarations& declarations, Lexicon& lexicon)
    : line_(line), word_(word), declarations_(declarations), lexicon_(lexicon) {
    // nop
  }

  LexicalEntry make(const std::string& family) {
    LexicalEntry entry;
    entry.phrase = word_.phrase;
    entry.family = family;
    entry.predicate = word_.predicate;
    entry.weight = line_.weight + word_.weight;
    number_anchor(entry);
    entry.category = lexicon_.categories().intern(category());
    for (const auto& index : line_.category.indices)
      entry.indices.push_back(static_cast<std::uint8_t>(variable(index)));
    for (const auto& nominal : line_.meaning.nominals)
      append_predications(nominal, entry.predications);
    std::sort(entry.predications.begin(), entry.predications.end());
    return entry;
  }

private:
  /// The variable that the predicate is said of is number 0.
  void number_anchor(LexicalEntry& entry) {
    for (const auto& nominal : line_.meaning.nominals)
      if (nominal.proposition == predicate_mark) {
        variable(nominal.name);
        entry.anchored = true;
        return;
      }
    for (const auto& nominal : line_.meaning.nominals)
      if (!nominal.proposition.empty()) {
        variable(nominal.name);
        entry.anchored = true;
        return;
      }
  }

  Category category() {
    auto category = line_.category.category;
    for (const auto& value : word_.features) {
      const auto place = declarations_.find_value(value);
      const auto name = "?" + declarations_.features[place].name;
      values_[name] = value;
      if (const auto known = line_.category.feature_variables.find(name);
          known != line_.category.feature_variables.end())
        substitute(category, known->second,
                   static_cast<FeatureValue>(lexicon_.symbols().intern(value)));
    }
    return category;
  }

  NominalId variable(const std::string& name) {
    if (name.empty())
      return static_cast<NominalId>(next_variable_++);
    const auto [place, is_new] = variables_.emplace(name, next_variable_);
    next_variable_ += is_new ? 1 : 0;
    return static_cast<NominalId>(place->second);
  }

  Symbol symbol(const std::string& text) {
    return lexicon_.symbols().intern(text == predicate_mark ? word_.predicate : text);
  }

  void append_predications(const Nominal& nominal, std::vector<Predication>& predications) {
    const auto head = variable(nominal.name);
    using Kind = Predication::Kind;
    if (!nominal.sort.empty())
      predications.push_back({head, Kind::sort, 0, symbol(nominal.sort), 0});
    if (!nominal.proposition.empty())
      predications.push_back({head, Kind::proposition, 0, symbol(nominal.proposition), 0});
    for (const auto& feature : nominal.features) {
      auto value = feature.value;
      if (value.starts_with('?')) {
        const auto known = values_.find(value);
        if (known == values_.end())
          continue;
        value = known->second;
      }
      predications.push_back({head, Kind::feature, symbol(feature.name), symbol(value), 0});
    }
    for (const auto& relation : nominal.relations)
      predications.push_back(
        {head, Kind::relation, symbol(relation.mode), 0, variable(relation.dependent)});
  }

  const FamilyEntry& line_;
  const FamilyWord& word_;
  const FeatureDeclarations& declarations_;
  Lexicon& lexicon_;
  std::map<std::string, std::size_t> variables_;
  std::map<std::string, std::string> values_;
  std::size_t next_variable_ = 0;
};

bool is_vowel(char c) {
  return std::string_view("aeiou").find(c) != std::string_view::npos;
}

} // namespace

void add_word(const Family& family, const FamilyWord& word, const FeatureDeclarations& declarations,
              Lexicon& lexicon) {
  for (const auto& line : family.entries)
    lexicon.add(EntryMaker(line, word, declarations, lexicon).make(family.name));
}

std::string plural_of(const std::string& singular) {
  const std::string_view word = singular;
  for (const std::string_view end : {"s", "x", "z", "ch", "sh"})
    if (word.ends_with(end))
      return singular + "es";
  if (word.size() > 1 && word.back() == 'y' && !is_vowel(word[word.size() - 2]))
    return singular.substr(0, singular.size() - 1) + "ies";
  return singular + "s";
}

} // namespace castor::communication
