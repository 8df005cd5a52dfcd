#include "castor/communication/dialogue/reparsing.hpp"

#include "castor/communication/dialogue/alternatives.hpp"
#include "castor/communication/dialogue/asides.hpp"
#include "castor/communication/dialogue/beside_requests.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/function_words.hpp"
#include "castor/communication/dialogue/history_questions.hpp"
#include "castor/communication/dialogue/likely_meaning.hpp"
#include "castor/communication/dialogue/sequels.hpp"
#include "castor/communication/dialogue/thing_names.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/pauses.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

/// How often one paraphrase is applied to an utterance.
constexpr std::size_t most_repetitions = 3;

/// In any way in which words are understood by themselves.
PartParser part_parser(Parser& parser) {
  return [&parser](const WordList& words) -> std::optional<PackedLogicalForm> {
    IncrementalParse parse{parser};
    for (const auto& word : words)
      parse.add(word);
    parse.finish();
    auto form = parse.form();
    if (auto other = reparsed(parser, words, form))
      return other;
    return is_understood(form) ? std::optional{std::move(form)} : std::nullopt;
  };
}

std::optional<PackedLogicalForm> parsed_question_about_moves(Parser& parser,
                                                             const WordList& words) {
  const auto question = question_about_moves(words);
  auto form = question ? parser.parse_whole(*question) : std::nullopt;
  if (form)
    form->corrections.push_back({written(words), written(*question)});
  return form;
}

/// Of an utterance that is not understood as it stands.
std::optional<PackedLogicalForm> parsed_otherwise(Parser& parser, const WordList& words,
                                                  const PackedLogicalForm& form) {
  if (auto result = parsed_question_about_moves(parser, words))
    return result;
  if (auto result = parsed_question_beside(parser, words, part_parser(parser)))
    return result;
  if (auto result = parsed_without_asides(parser, words))
    return result;
  if (auto result = parsed_request_alone(parser, words))
    return result;
  if (auto result = parsed_in_order(parser, words, part_parser(parser)))
    return result;
  if (auto result = parsed_prohibition_alone(parser, words))
    return result;
  // "Stick blue on red" does not ask whether a stick is on it; "the cube is it on the ball" asks.
  const bool says_what_is_so = std::ranges::any_of(words, [](const auto& word) {
    return is_among(word, {"is", "are", "was", "were", "does", "do", "did", "has", "have"});
  });
  if (!says_what_is_so && !paraphrased(words, parser.lexicon(), false))
    if (auto result = LikelyMeaning{parser, words}.likely())
      return result;
  // "How many balls red" asks how many are red, rather than "how many balls, red or not".
  if (auto result = parsed_with_function_words(parser, words))
    return result;
  // "Any of them a ball" is no list of two phrases.
  if (auto result = parsed_with_pause(parser, words, form); result && says_sentence(*result))
    return result;
  const auto core = without_asides(words, parser.lexicon());
  return core.size() < words.size() ? parsed_with_function_words(parser, core) : std::nullopt;
}

/// Of an utterance that is understood as a whole, but whose second part is about the answer to the
/// first: "if the ball is red, take it", "how many balls are there, and what colour are they?"
std::optional<PackedLogicalForm> parsed_in_parts(Parser& parser, const WordList& words) {
  if (has_condition_on_it(words))
    return parsed_in_order(parser, words, part_parser(parser));
  return asks_about_answer(words) ? parsed_question_beside(parser, words, part_parser(parser))
                                  : std::nullopt;
}

/// Of what says the same.
std::optional<PackedLogicalForm> parsed_paraphrase(Parser& parser, WordList words) {
  if (auto result = parsed_without_asking(parser, words))
    return result;
  IncrementalParse parse{parser};
  for (const auto& word : words)
    parse.add(word);
  parse.finish();
  auto form = parse.form();
  if (!is_understood(form))
    return parsed_otherwise(parser, words, form);
  auto parts = parsed_in_parts(parser, words);
  return parts ? std::move(parts) : std::optional{std::move(form)};
}

} // namespace

std::optional<WordList> paraphrased(WordList words, const Lexicon& lexicon, bool is_understood) {
  bool is_changed = false;
  const auto apply = [&](std::span<const Paraphrase> paraphrases) {
    for (const auto& paraphrase : paraphrases)
      for (std::size_t i = 0; i < most_repetitions && paraphrase.apply(words); ++i)
        is_changed = true;
  };
  apply(lexicon.paraphrases(true));
  if (!is_understood)
    apply(lexicon.paraphrases(false));
  return is_changed ? std::optional{std::move(words)} : std::nullopt;
}

std::optional<PackedLogicalForm> reparsed(Parser& parser, const WordList& words,
                                          const PackedLogicalForm& form) {
  // That there is room enough is nothing to be asked: it is tried.
  if (auto result = parsed_alternative(parser, words, part_parser(parser)))
    return result;
  if (auto other = paraphrased(words, parser.lexicon(), true))
    if (auto result = parsed_paraphrase(parser, std::move(*other)))
      return result;
  if (auto result = parsed_without_asking(parser, words))
    return result;
  if (is_understood(form))
    return parsed_in_parts(parser, words);
  const auto whole = with_articles(parser, words);
  if (auto result = whole ? parser.parse_whole(*whole) : std::nullopt;
      result && asks_for_handling(*result, parser.lexicon()))
    return result;
  if (auto result = parsed_otherwise(parser, words, form))
    return result;
  if (auto other = paraphrased(words, parser.lexicon(), false))
    if (auto result = parsed_paraphrase(parser, std::move(*other)))
      return result;
  return whole ? parsed_paraphrase(parser, *whole) : std::nullopt;
}

} // namespace castor::communication
