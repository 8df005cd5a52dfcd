#include "castor/communication/parsing/chart.hpp"

#include "castor/communication/parsing/numerals.hpp"

#include <algorithm>

namespace castor::communication {

namespace {

/// Each composition makes a derivation a little less preferred, so that plain ones come first.
constexpr double composition_weight = -0.01;

/// So does each word of what a modifier modifies: "left of the thing in front of the box" speaks of
/// the thing in front of the box, and "red cubes or balls" of any balls.
constexpr double modified_word_weight = -0.001;

/// More arguments than this no category of a language takes.
constexpr std::size_t max_arguments = 5;

/// So many words in a row may say nothing.
constexpr std::size_t max_fillers = 6;

/// The variable of the result of a raised category.
constexpr std::size_t raised_variable = 200;

/// Derivations of one category that take part in different combinations.
enum class NormalForm : std::uint8_t { any, forward_composed, backward_composed, raised };

NormalForm normal_form(Combinator combinator) {
  if (combinator == Combinator::type_raising)
    return NormalForm::raised;
  if (!is_composition(combinator))
    return NormalForm::any;
  return is_forward(combinator) ? NormalForm::forward_composed : NormalForm::backward_composed;
}

bool is_normal(const Edge& left, const Edge& right, Combinator how) {
  const auto& function = is_forward(how) ? left : right;
  const auto form = normal_form(function.combinator);
  if (form == NormalForm::raised)
    return is_composition(how);
  return form != (is_forward(how) ? NormalForm::forward_composed : NormalForm::backward_composed);
}

/// What is said in quotes; nothing for another word.
std::optional<std::string> quotation(const std::string& word) {
  return is_quoted(word) ? std::optional{word.substr(1, word.size() - 2)} : std::nullopt;
}

/// "less-0.0" with 5 is "less-5"; a predicate without a numeral is what is said.
std::string with_literal(const std::string& predicate, const std::string& said) {
  const auto at = predicate.find(any_numeral);
  return at == std::string::npos
           ? said
           : predicate.substr(0, at) + said + predicate.substr(at + any_numeral.size());
}

} // namespace

CombinatoryGrammar::CombinatoryGrammar(const Lexicon& words)
  : lexicon(words), combinators(categories) {
  for (std::size_t i = 0; i < words.categories().size(); ++i)
    categories.intern(words.categories()[static_cast<CategoryId>(i)]);
}

bool CombinatoryGrammar::is_root(CategoryId category) {
  const auto [place, is_new] = roots_.try_emplace(category, false);
  if (is_new)
    place->second = std::ranges::any_of(lexicon.roots(), [&](const Category& root) {
      return FeatureSubstitution().unify(root, categories[category]);
    });
  return place->second;
}

const std::vector<CategoryId>& CombinatoryGrammar::raised(CategoryId category) {
  const auto [place, is_new] = raised_.try_emplace(category);
  if (is_new)
    for (const auto& rule : lexicon.raising())
      if (FeatureSubstitution().unify(rule.category, categories[category]))
        place->second.push_back(combinators.raised(category, rule.result));
  return place->second;
}

Chart::Chart(CombinatoryGrammar& grammar, const ChartLimits& limits)
  : grammar_(grammar), limits_(limits) {
  // nop
}

bool Chart::add(std::string word) {
  if (words_.size() >= limits_.words)
    return false;
  words_.push_back(std::move(word));
  look_up_phrases();
  cells_.emplace_back(words_.size());
  for (std::size_t begin = words_.size(); begin-- > 0;)
    fill(begin, words_.size());
  return true;
}

const std::vector<Edge>& Chart::edges(std::size_t begin, std::size_t end) const {
  return cells_[end - 1][begin];
}

Chart::Cell& Chart::cell(std::size_t begin, std::size_t end) {
  return cells_[end - 1][begin];
}

std::size_t Chart::size() const {
  std::size_t count = 0;
  for (const auto& column : cells_)
    for (const auto& found : column)
      count += found.size();
  return count;
}

std::string Chart::text(Symbol symbol) const {
  const auto& symbols = grammar_.lexicon.symbols();
  return symbol < symbols.size() ? symbols.text(symbol) : literals_[symbol - symbols.size()];
}

void Chart::fill(std::size_t begin, std::size_t end) {
  auto& found = cell(begin, end);
  add_phrases(begin, end, found);
  for (std::size_t middle = end - 1; middle > begin; --middle)
    add_combinations(cell(begin, middle), cell(middle, end), found);
  add_raised(begin, found);
  prune(found);
}

/// Those that end with the last word.
void Chart::look_up_phrases() {
  const auto& lexicon = grammar_.lexicon;
  fillers_.emplace_back();
  auto& found = phrases_.emplace_back();
  const auto longest = std::min(lexicon.longest_phrase_ending_in(words_.back()), words_.size());
  std::string phrase;
  std::string phrase_of_any;
  for (std::size_t length = 1; length <= longest; ++length) {
    const auto begin = words_.size() - length;
    phrase = length == 1 ? words_.back() : words_[begin] + ' ' + phrase;
    const auto& word = words_[begin];
    const auto of_any = is_numeral(word) ? std::string(any_numeral) : word;
    phrase_of_any = length == 1 ? of_any : of_any + ' ' + phrase_of_any;
    auto& of_phrase = found.emplace_back();
    of_phrase.as_said = lexicon.find(phrase);
    if (phrase_of_any != phrase)
      of_phrase.with_any_numeral = lexicon.find(phrase_of_any);
    if (const auto* weight = lexicon.filler(phrase))
      for (auto i = begin; i < words_.size(); ++i)
        if (fillers_[i].length == 0 || fillers_[i].length > length)
          fillers_[i] = {length, *weight};
  }
}

std::optional<double> Chart::filler_weight(std::size_t position) const {
  const auto& filler = fillers_[position];
  return filler.length > 0 ? filler.weight : limits_.skipping_weight;
}

/// Fillers belong to the phrase before them, at the beginning of an utterance to the one after.
void Chart::add_phrases(std::size_t begin, std::size_t end, Cell& found) {
  double before = 0;
  for (std::size_t first = begin; first < end && first - begin <= max_fillers; ++first) {
    if (first > begin) {
      const auto weight = begin == 0 ? filler_weight(first - 1) : std::nullopt;
      if (!weight)
        return;
      before += *weight;
    }
    double after = 0;
    for (std::size_t last = end; last > first && end - last <= max_fillers; --last) {
      if (last < end) {
        const auto weight = filler_weight(last);
        if (!weight)
          break;
        after += *weight;
      }
      const auto& phrases = phrases_[last - 1];
      const auto length = last - first;
      if (length > phrases.size())
        continue;
      const auto add = [&](std::uint32_t entry, const std::optional<std::string>& literal) {
        auto meaning = meaning_of(entry, first, last, literal);
        meaning.weight += before + after;
        insert(grammar_.lexicon.entry(entry).category, Combinator::lexical, std::move(meaning),
               found);
      };
      for (const auto entry : phrases[length - 1].as_said)
        add(entry, quotation(words_[first]));
      for (const auto entry : phrases[length - 1].with_any_numeral)
        add(entry, numeral_in(first, last));
    }
  }
}

Meaning Chart::meaning_of(std::uint32_t number, std::size_t begin, std::size_t end,
                          const std::optional<std::string>& said) {
  const auto& entry = grammar_.lexicon.entry(number);
  const auto nominal = [&](NominalId variable) {
    return nominal_of_word(begin, variable, variable == 0 && entry.anchored);
  };
  Meaning meaning;
  meaning.weight = entry.weight;
  meaning.predications = entry.predications;
  const auto placeholder = said ? grammar_.lexicon.symbols().find(entry.predicate) : 0;
  for (auto& predication : meaning.predications) {
    predication.nominal = nominal(predication.nominal);
    if (predication.kind == Predication::Kind::relation)
      predication.dependent = nominal(predication.dependent);
    if (said && predication.value == placeholder)
      predication.value = literal(with_literal(entry.predicate, *said));
  }
  std::sort(meaning.predications.begin(), meaning.predications.end());
  for (const auto variable : entry.indices)
    meaning.indices.push_back(nominal(variable));
  meaning.choices.push_back(
    {static_cast<std::uint16_t>(begin), static_cast<std::uint16_t>(end), number});
  return meaning;
}

Symbol Chart::literal(std::string text) {
  const auto known = std::ranges::find(literals_, text);
  const auto index = known - literals_.begin();
  if (known == literals_.end())
    literals_.push_back(std::move(text));
  return grammar_.lexicon.symbols().size() + static_cast<Symbol>(index);
}

std::string Chart::numeral_in(std::size_t begin, std::size_t end) const {
  return *std::ranges::find_if(std::span{words_}.subspan(begin, end - begin), is_numeral);
}

void Chart::add_combinations(const Cell& left, const Cell& right, Cell& found) {
  for (const auto& a : left)
    for (const auto& b : right)
      for (const auto& how : grammar_.combinators.combine(a.category, b.category))
        if (is_normal(a, b, how.combinator) &&
            grammar_.categories[how.result].arguments.size() <= max_arguments)
          combine(a, b, how, found);
}

/// Of all pairs of meanings, those that can be among the preferred ones.
void Chart::combine(const Edge& left, const Edge& right, const Combination& how, Cell& found) {
  const auto& function = is_forward(how.combinator) ? left : right;
  const auto& argument = is_forward(how.combinator) ? right : left;
  const auto most = limits_.meanings_per_edge;
  for (std::size_t i = 0; i < function.meanings.size(); ++i)
    for (std::size_t k = 0; k < argument.meanings.size() && (i + 1) * (k + 1) <= most; ++k) {
      const auto& a = function.meanings[i];
      const auto& b = argument.meanings[k];
      auto weight = a.weight + b.weight;
      if (is_composition(how.combinator))
        weight += composition_weight;
      if (how.modifies)
        weight += modified_word_weight * static_cast<double>(b.choices.size());
      const auto* known = find(how.result, how.combinator, found);
      if (known != nullptr && is_too_light(*known, weight))
        continue;
      if (auto meaning = unite(a, b, how.result_atoms)) {
        meaning->weight = weight;
        insert(how.result, how.combinator, std::move(*meaning), found);
      }
    }
}

void Chart::add_raised(std::size_t begin, Cell& found) {
  const auto result = nominal_of_word(begin, raised_variable, false);
  const auto count = found.size();
  for (std::size_t i = 0; i < count; ++i)
    for (const auto category : grammar_.raised(found[i].category))
      for (std::size_t k = 0; k < found[i].meanings.size(); ++k) {
        auto meaning = found[i].meanings[k];
        meaning.indices.insert(meaning.indices.begin(), {result, result});
        insert(category, Combinator::type_raising, std::move(meaning), found);
      }
}

/// The edge of a category, null if there is none.
Edge* Chart::find(CategoryId category, Combinator combinator, Cell& found) {
  const auto form = normal_form(combinator);
  const auto place = std::find_if(found.begin(), found.end(), [&](const Edge& edge) {
    return edge.category == category && normal_form(edge.combinator) == form;
  });
  return place == found.end() ? nullptr : &*place;
}

/// Whether an edge has as many meanings as it may have, and all of them are preferred.
bool Chart::is_too_light(const Edge& edge, double weight) const {
  return edge.meanings.size() >= limits_.meanings_per_edge && weight <= edge.meanings.back().weight;
}

void Chart::insert(CategoryId category, Combinator combinator, Meaning meaning, Cell& found) {
  auto* place = find(category, combinator, found);
  if (place == nullptr)
    place = &found.emplace_back(Edge{category, combinator, {}});
  if (is_too_light(*place, meaning.weight))
    return;
  auto& meanings = place->meanings;
  const auto same = std::find_if(meanings.begin(), meanings.end(), [&](const Meaning& known) {
    return known.predications == meaning.predications && known.indices == meaning.indices;
  });
  if (same != meanings.end()) {
    if (same->weight >= meaning.weight)
      return;
    meanings.erase(same);
  }
  const auto position =
    std::upper_bound(meanings.begin(), meanings.end(), meaning.weight,
                     [](double weight, const Meaning& other) { return weight > other.weight; });
  meanings.insert(position, std::move(meaning));
  if (meanings.size() > limits_.meanings_per_edge)
    meanings.pop_back();
}

void Chart::prune(Cell& found) const {
  std::stable_sort(found.begin(), found.end(), [](const Edge& a, const Edge& b) {
    return a.meanings.front().weight > b.meanings.front().weight;
  });
  if (found.size() > limits_.edges_per_span)
    found.resize(limits_.edges_per_span);
}

} // namespace castor::communication
