#include "castor/communication/parsing/parser.hpp"

#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace castor::communication {

namespace {

/// Weights that differ by less are equal, but for rounding.
constexpr double least_weight = 1e-6;

/// What makes a split into fragments worse: each fragment, one that lacks arguments, and each word
/// that is in none.
constexpr double fragment_cost = 1;
constexpr double incomplete_fragment_cost = 0.4;
constexpr double unknown_word_cost = 3;

} // namespace

Parser::Parser(std::shared_ptr<const Lexicon> lexicon, ParserOptions options)
  : lexicon_(std::move(lexicon)), options_(options), grammar_(*lexicon_) {
  // nop
}

PackedLogicalForm Parser::parse(std::string_view utterance) {
  return parse_of(words_of(utterance)).form();
}

std::optional<PackedLogicalForm> Parser::parse_whole(std::vector<std::string> words) {
  const auto parse = parse_of(std::move(words));
  return parse.is_understood() ? std::optional{parse.form()} : std::nullopt;
}

IncrementalParse Parser::parse_of(std::vector<std::string> words) {
  IncrementalParse parse(*this);
  for (auto& word : words)
    parse.add(std::move(word));
  parse.finish();
  return parse;
}

std::vector<LogicalForm> Parser::readings(std::string_view utterance) {
  const auto packed = parse(utterance);
  std::vector<LogicalForm> forms;
  if (packed.unparsable.empty())
    for (const auto& reading : packed.readings)
      for (auto& form : unpack(packed, reading.id))
        forms.push_back(std::move(form));
  return forms;
}

IncrementalParse::IncrementalParse(Parser& parser)
  : IncrementalParse(parser, parser.options().chart) {
  // nop
}

IncrementalParse::IncrementalParse(Parser& parser, const ChartLimits& limits)
  : parser_(parser), chart_(parser.grammar(), limits) {
  // nop
}

void IncrementalParse::add(std::string word) {
  // Pauses matter only where the lexicon says so.
  if (word == "," && !parser_.lexicon().knows(word))
    return;
  if (!ignored_words_.empty() || !chart_.add(word))
    ignored_words_.push_back(std::move(word));
}

std::vector<const Meaning*> IncrementalParse::meanings() const {
  std::vector<const Meaning*> found;
  if (chart_.words().empty())
    return found;
  for (const auto& edge : chart_.edges(0, chart_.words().size()))
    if (!is_finished_ || parser_.grammar().is_root(edge.category))
      for (const auto& meaning : edge.meanings) {
        const bool is_known = std::any_of(found.begin(), found.end(), [&](const Meaning* known) {
          return known->predications == meaning.predications &&
                 known->indices.front() == meaning.indices.front();
        });
        if (!is_known)
          found.push_back(&meaning);
      }
  // Of readings that weigh the same, the one that attaches to what is nearest.
  std::stable_sort(found.begin(), found.end(), [](const Meaning* a, const Meaning* b) {
    if (std::abs(a->weight - b->weight) > least_weight)
      return a->weight > b->weight;
    return a->dependency_length() < b->dependency_length();
  });
  if (found.size() > parser_.options().readings)
    found.resize(parser_.options().readings);
  return found;
}

bool IncrementalParse::is_understood() const {
  return ignored_words_.empty() && !meanings().empty();
}

LogicalForm IncrementalParse::form_of(const Meaning& meaning) const {
  return logical_form(meaning, [this](Symbol symbol) { return chart_.text(symbol); });
}

PackedLogicalForm IncrementalParse::form() const {
  std::vector<ReadingForms> readings;
  for (const auto* meaning : meanings())
    readings.push_back({form_of(*meaning)});
  std::vector<Unparsable> unparsable;
  if (readings.empty() || !ignored_words_.empty()) {
    const auto parts = fragments();
    if (readings.empty())
      readings = readings_of(parts);
    unparsable = diagnose(parts);
  }
  auto packed = pack(readings);
  packed.text = text(0, chart_.words().size());
  packed.string_position = static_cast<std::int32_t>(chart_.words().size());
  packed.state = is_finished_ ? InterpretationState::finished : InterpretationState::unfinished;
  packed.unparsable = std::move(unparsable);
  return packed;
}

/// Complete ones before those that lack something, then by weight.
const Edge* IncrementalParse::best_edge(std::size_t begin, std::size_t end) const {
  const Edge* best = nullptr;
  const auto rank = [this](const Edge& edge) {
    return std::pair(parser_.grammar().is_root(edge.category), edge.meanings.front().weight);
  };
  for (const auto& edge : chart_.edges(begin, end))
    if (edge.combinator != Combinator::type_raising &&
        (best == nullptr || rank(edge) > rank(*best)))
      best = &edge;
  return best;
}

std::vector<IncrementalParse::Fragment> IncrementalParse::fragments() const {
  struct Step {
    double cost = std::numeric_limits<double>::infinity();
    Fragment last;
  };
  const auto words = chart_.words().size();
  std::vector<Step> steps(words + 1);
  steps[0].cost = 0;
  for (std::size_t end = 1; end <= words; ++end)
    for (std::size_t begin = 0; begin < end; ++begin) {
      const auto* edge = best_edge(begin, end);
      if (edge == nullptr && begin + 1 < end)
        continue;
      double cost = steps[begin].cost + unknown_word_cost;
      if (edge != nullptr)
        cost = steps[begin].cost + fragment_cost +
               (parser_.grammar().is_root(edge->category) ? 0 : incomplete_fragment_cost);
      if (cost < steps[end].cost)
        steps[end] = {cost, {begin, end, edge}};
    }
  std::vector<Fragment> parts;
  for (auto end = words; end > 0; end = steps[end].last.begin)
    parts.push_back(steps[end].last);
  std::reverse(parts.begin(), parts.end());
  return parts;
}

std::vector<ReadingForms> IncrementalParse::readings_of(const std::vector<Fragment>& parts) const {
  std::vector<ReadingForms> readings;
  for (const auto& part : parts) {
    if (part.edge == nullptr)
      continue;
    std::vector<ReadingForms> longer;
    if (readings.empty())
      readings.emplace_back();
    for (const auto& meaning : part.edge->meanings)
      for (const auto& shorter : readings) {
        if (longer.size() == parser_.options().readings)
          break;
        longer.push_back(shorter);
        longer.back().push_back(form_of(meaning));
      }
    readings = std::move(longer);
  }
  return readings;
}

std::string IncrementalParse::text(std::size_t begin, std::size_t end) const {
  std::string joined;
  for (auto i = begin; i < end; ++i)
    joined += (i == begin ? "" : " ") + chart_.words()[i];
  return joined;
}

Unparsable IncrementalParse::unknown_word(std::size_t position) const {
  const auto& word = chart_.words()[position];
  auto meant = parser_.lexicon().suggestions(word);
  // The first letter is seldom wrong.
  std::erase_if(meant, [&](const auto& x) { return x.front() != word.front(); });
  if (is_english_word(word))
    meant.clear();
  return {static_cast<std::int32_t>(position), 1, word, "the word \"" + word + "\" is not known",
          std::move(meant)};
}

Unparsable IncrementalParse::incomplete(const Edge& edge) const {
  const auto words = chart_.words().size();
  const auto& category = parser_.grammar().categories[edge.category];
  std::string missing;
  for (const auto& argument : category.arguments)
    missing = parser_.lexicon().name_of(argument.category);
  return {static_cast<std::int32_t>(words),
          0,
          "",
          "\"" + text(0, words) + "\" is incomplete" +
            (missing.empty() ? "" : ": " + missing + " is missing"),
          {}};
}

std::vector<Unparsable> IncrementalParse::diagnose(const std::vector<Fragment>& parts) const {
  std::vector<Unparsable> problems;
  const auto words = chart_.words().size();
  for (std::size_t i = 0; i < words; ++i)
    if (!parser_.lexicon().knows(chart_.words()[i]))
      problems.push_back(unknown_word(i));
  if (!ignored_words_.empty())
    problems.push_back({static_cast<std::int32_t>(words),
                        static_cast<std::int32_t>(ignored_words_.size()),
                        ignored_words_.front(),
                        "utterances have at most " + std::to_string(words) + " words",
                        {}});
  if (!problems.empty() || !is_finished_)
    return problems;
  if (parts.empty())
    return {{0, 0, "", "there are no words", {}}};
  if (parts.size() == 1 && parts.front().edge != nullptr)
    return is_finished_ ? std::vector{incomplete(*parts.front().edge)} : std::vector<Unparsable>{};
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto& part = parts[i];
    problems.push_back({static_cast<std::int32_t>(part.begin),
                        static_cast<std::int32_t>(part.end - part.begin),
                        text(part.begin, part.end),
                        "\"" + text(part.begin, part.end) + "\" does not go with \"" +
                          text(parts[i - 1].begin, parts[i - 1].end) + "\" before it",
                        {}});
  }
  return problems;
}

} // namespace castor::communication
