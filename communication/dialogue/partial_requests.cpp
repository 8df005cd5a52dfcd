#include "castor/communication/dialogue/partial_requests.hpp"

#include "castor/communication/dialogue/aside_clauses.hpp"
#include "castor/communication/dialogue/asides.hpp"
#include "castor/communication/dialogue/beside_requests.hpp"
#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/dialogue/likely_meaning.hpp"
#include "castor/communication/dialogue/reparsing.hpp"
#include "castor/communication/dialogue/request_gist.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

/// Parses of parts of one utterance; more boundaries of clauses are hardly ever said.
constexpr int most_part_parses = 80;

/// In words: the place that is not understood.
constexpr std::size_t longest_place = 8;

/// In words: a thing that "it" may stand for.
constexpr std::size_t longest_phrase = 8;

/// As the robot says it.
WordList with_persons_swapped(WordList words) {
  for (auto& word : words)
    if (word == "me" || word == "us")
      word = "you";
    else if (word == "my" || word == "our")
      word = "your";
  return words;
}

bool begins_question(std::string_view word) {
  return is_among(word, {"what", "which", "who", "where", "how", "why", "when", "tell", "did"});
}

/// "What did you move?", but not "how about moving it?".
bool asks_for_deed(std::string_view word) {
  return is_among(word, {"what", "which", "where", "did", "have"});
}

bool begins_place(std::string_view word) {
  return is_among(word, {"on",   "onto",  "in",    "into",  "at",      "by",    "to",     "near",
                         "next", "close", "under", "below", "above",   "over",  "beside", "behind",
                         "left", "right", "where", "up",    "between", "among", "around"});
}

/// A part of an utterance that is understood by itself.
struct Part {
  std::size_t begin = 0;
  std::size_t end = 0;
  WordList words;
  Beside kind = Beside::request;
};

class PartSearch {
public:
  PartSearch(Parser& parser, const WordList& words) : parser_(parser), words_(words) {}

  std::optional<PackedLogicalForm> run() {
    auto parts = find_parts();
    if (parts.empty() || !are_rest_asides(parts))
      return std::nullopt;
    if (parts.front().kind == Beside::question)
      return parts.size() == 1 ? answered(parts.front()) : std::nullopt;
    // A question about what is to be done is asked too soon.
    std::erase_if(parts, [](const Part& x) { return x.kind == Beside::question; });
    std::size_t from = 0;
    for (auto& part : parts) {
      if (!take_thing_before(part, from))
        return std::nullopt;
      from = part.end;
    }
    return proposed(parts);
  }

  std::optional<PackedLogicalForm> without_place() {
    for (const auto begin : begins()) {
      if (begin > 0 && !is_aside(lexicon(), words_between(words_, 0, begin), Beside::request, true))
        continue;
      for (auto end = words_.size() - 1; end > begin + 1; --end)
        if (auto form = request_without_place(begin, end))
          return form;
    }
    return std::nullopt;
  }

private:
  const Lexicon& lexicon() const { return parser_.lexicon(); }

  std::vector<std::size_t> begins() const {
    std::vector<std::size_t> result{0};
    for (std::size_t i = 1; i < words_.size(); ++i)
      if (words_[i] != "," && (words_[i - 1] == "," || joins_clauses(words_[i - 1])))
        result.push_back(i);
    return result;
  }

  std::vector<std::size_t> ends() const {
    std::vector<std::size_t> result{words_.size()};
    for (auto i = words_.size(); i-- > 1;)
      if (words_[i] == "," || (joins_clauses(words_[i]) && words_[i - 1] != ","))
        result.push_back(i);
    return result;
  }

  std::vector<Part> find_parts() {
    std::vector<Part> result;
    std::size_t from = 0;
    for (const auto begin : begins()) {
      if (begin < from)
        continue;
      for (const auto end : ends())
        if (end > begin && (begin > 0 || end < words_.size()))
          if (auto part = part_at(begin, end)) {
            from = end;
            result.push_back(std::move(*part));
            break;
          }
    }
    return result;
  }

  std::optional<PackedLogicalForm> parse(WordList words) {
    return words.empty() || ++parses_ > most_part_parses ? std::nullopt
                                                         : parser_.parse_whole(std::move(words));
  }

  std::optional<Part> part_at(std::size_t begin, std::size_t end) {
    Part result{begin, end, words_between(words_, begin, end), Beside::request};
    auto form = parse(result.words);
    if (!form) {
      auto plain = without_asides(result.words, lexicon(), true);
      if (plain.size() == result.words.size())
        return std::nullopt;
      result.words = std::move(plain);
      form = parse(result.words);
    }
    if (!form)
      return std::nullopt;
    const auto move = move_of(*form, lexicon());
    const bool is_asked =
      move.type == DialogueMoveType::question_w || move.type == DialogueMoveType::question_yn ||
      (move.type == DialogueMoveType::small_talk && begins_question(result.words.front())) ||
      (move.type == DialogueMoveType::action_directive && asks_for_deed(result.words.front()));
    if (is_asked && is_sentence(move)) {
      result.kind = Beside::question;
      return result;
    }
    const bool is_request = move.type == DialogueMoveType::action_directive &&
                            is_handling(move.content, lexicon().meanings());
    return is_request ? std::optional{std::move(result)} : std::nullopt;
  }

  /// And no phrase such as "a ball?".
  static bool is_sentence(const DialogueMove& move) {
    const auto* root = find_nominal(move.content, move.content.root);
    return root != nullptr && (is_clause(move.content, *root) || root->sort == "small-talk");
  }

  bool are_rest_asides(const std::vector<Part>& parts) const {
    const auto beside = parts.front().kind;
    std::size_t from = 0;
    bool is_first = true;
    for (const auto& part : parts) {
      if (!is_aside(lexicon(), words_between(words_, from, part.begin), beside, is_first))
        return false;
      from = part.end;
      is_first = false;
    }
    return is_aside(lexicon(), words_between(words_, from, words_.size()), beside, is_first);
  }

  /// What is left out, but for words without a meaning of their own.
  std::string rest_of(const std::vector<Part>& parts) const {
    std::string result;
    const auto add = [&](std::size_t begin, std::size_t end) {
      const auto rest = words_between(words_, begin, end);
      auto said = without_asides(rest, lexicon());
      std::erase_if(said, [](const auto& x) { return x == "," || joins_clauses(x); });
      if (said.empty())
        return;
      auto from = begin;
      while (words_[from] == ",")
        ++from;
      result += (result.empty() ? "" : " ... ") + written(words_between(words_, from, end));
    };
    std::size_t from = 0;
    for (const auto& part : parts) {
      add(from, part.begin);
      from = part.end;
    }
    add(from, words_.size());
    return result;
  }

  std::optional<PackedLogicalForm> answered(Part& part) {
    if (!take_thing_before(part, 0))
      return std::nullopt;
    auto result = parse(part.words);
    if (const auto rest = rest_of({part}); result && !rest.empty())
      result->corrections.push_back({rest, {}});
    return result;
  }

  std::optional<PackedLogicalForm> proposed(const std::vector<Part>& parts) {
    WordList all;
    for (const auto& part : parts) {
      if (!all.empty())
        all.insert(all.end(), {"and", "then"});
      all.insert(all.end(), part.words.begin(), part.words.end());
    }
    auto result = parse(all);
    const auto rest = rest_of(parts);
    if (result && is_prohibition(*result, lexicon())) {
      if (!rest.empty())
        result->corrections.push_back({rest, {}});
    } else if (result)
      result->partial = PartialRequest{rest, written(all), false};
    return result;
  }

  // -- what "it" is

  struct Spoken {
    WordList words;
    bool is_plural = false;
  };

  /// Puts the thing that is spoken of in the part before in the place of a pronoun.
  /// \param from where the part before begins, after what is understood: a pronoun of the first
  ///     part stands for nothing that is understood
  /// \returns false if it is not clear what the pronoun stands for
  bool take_thing_before(Part& part, std::size_t from) {
    const auto pronoun = std::ranges::find_if(part.words, [](const auto& x) {
      return is_among(x, {"it", "them", "they", "one"});
    });
    if (pronoun == part.words.end() || part.begin == 0)
      return true;
    const auto at = pronoun - part.words.begin();
    const bool is_alone = *pronoun != "one" || at == 0 || !lexicon().knows(*std::prev(pronoun)) ||
                          lexicon().meanings().actions.contains(*std::prev(pronoun)) ||
                          is_among(*std::prev(pronoun), {"me", "us"});
    if (!is_alone)
      return true;
    std::vector<Spoken> spoken;
    const bool is_known = things_spoken_of({part.words.begin(), pronoun}, spoken);
    // "Take the cube and put it on the left."
    if (!is_known || !spoken.empty())
      return true;
    if (!things_spoken_of(words_between(words_, from, part.begin), spoken))
      return false;
    if (spoken.empty() || from > 0)
      return spoken.empty() && *pronoun != "one";
    const bool is_plural = *pronoun == "them" || *pronoun == "they";
    if (spoken.size() != 1 || spoken.front().is_plural != is_plural)
      return false;
    // "Either cube will do, bring me one": a cube.
    auto& determiner = spoken.front().words.front();
    if (is_among(determiner, {"either", "any", "some", "a", "an"}) != (*pronoun == "one"))
      return false;
    if (*pronoun == "one")
      determiner = "a";
    part.words.erase(pronoun);
    part.words.insert(std::next(part.words.begin(), at), spoken.front().words.begin(),
                      spoken.front().words.end());
    return true;
  }

  /// \returns false if something else is spoken of that is not known
  bool things_spoken_of(const WordList& words, std::vector<Spoken>& result) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const bool is_determiner =
        is_among(words[i], {"the", "a", "an", "this", "that", "these", "those", "my", "your", "his",
                            "her", "our", "their", "both", "either"});
      if (!is_determiner || i + 1 == words.size())
        continue;
      if (const auto length = thing_at(words, i, result); length > 0)
        i += length - 1;
      else if (!lexicon().knows(words[i + 1]) && !lexicon().is_in_a_class(words[i + 1]))
        return false;
    }
    return true;
  }

  std::size_t thing_at(const WordList& words, std::size_t begin, std::vector<Spoken>& result) {
    for (auto length = std::min(longest_phrase, words.size() - begin); length > 1; --length) {
      const auto thing = thing_in(words_between(words, begin, begin + length));
      if (!thing)
        continue;
      // Without what says nothing: "the ball so well".
      auto needed = length;
      for (auto shorter = length - 1; shorter > 1; --shorter)
        if (const auto same = thing_in(words_between(words, begin, begin + shorter));
            same && equivalent(*same, *thing))
          needed = shorter;
      auto phrase = words_between(words, begin, begin + needed);
      if (std::ranges::find(result, phrase, &Spoken::words) == result.end())
        result.push_back({std::move(phrase), is_plural(*find_nominal(*thing, thing->root))});
      return length;
    }
    return 0;
  }

  std::optional<LogicalForm> thing_in(WordList phrase) {
    const auto form = parse(std::move(phrase));
    return form ? thing_said(*form) : std::nullopt;
  }

  // -- where something is to go

  std::optional<PackedLogicalForm> request_without_place(std::size_t begin, std::size_t end) {
    const auto place = words_between(words_, end, words_.size());
    if (place.size() > longest_place || !may_be_place(place) || !may_end_phrase(words_[end - 1]))
      return std::nullopt;
    Part part{begin, end, words_between(words_, begin, end), Beside::request};
    part.words = without_asides(part.words, lexicon(), true);
    if (!take_thing_before(part, 0))
      return std::nullopt;
    // "Take it down again" need not say where to.
    if (!begins_place(place.front()) && parse(part.words))
      return std::nullopt;
    auto whole = part.words;
    whole.emplace_back("there");
    auto form = parse(std::move(whole));
    if (!form)
      return std::nullopt;
    const auto move = move_of(*form, lexicon());
    const auto* root = find_nominal(move.content, move.content.root);
    const auto* to = root == nullptr ? nullptr : dependent(move.content, *root, "Destination");
    if (move.type != DialogueMoveType::action_directive ||
        !is_handling(move.content, lexicon().meanings()) || to == nullptr ||
        to->proposition != "there")
      return std::nullopt;
    // "Could you put the cube": from the verb on.
    const auto verb = root->name.starts_with('w') ? place_of_word(*root) - 1 : 0;
    auto words = words_between(part.words, verb, part.words.size());
    form->partial = PartialRequest{written(place), written(with_persons_swapped(words)), true};
    return form;
  }

  /// No other thing, and no description of the one before.
  bool may_be_place(const WordList& words) const {
    const bool is_decisive = std::ranges::any_of(words, [](const auto& x) {
      return is_among(x, {"not", "n't", "unless", "until", "except", "without", "if", "but", "only",
                          "instead", ","});
    });
    // "The red blorp on the left" may be about a blorp.
    return !is_decisive && lexicon().knows(words.front()) &&
           !is_among(words.front(), {"and", "or", "of", "with", "that", "which", "who", "whose",
                                     "from", "one", "ones"});
  }

  /// "The red cube", but not "the red".
  bool may_end_phrase(const std::string& word) {
    return is_among(word, {"it", "them", "that", "this", "one", "ones", "these", "those"}) ||
           thing_in({"the", word}).has_value();
  }

  Parser& parser_;
  const WordList& words_;
  int parses_ = 0;
};

/// "Please do", "better not".
std::optional<PackedLogicalForm> agreement_in(Parser& parser, const WordList& words) {
  std::string said;
  for (const auto& word : words)
    if (word != ",")
      said += (said.empty() ? "" : " ") + word;
  const auto& lexicon = parser.lexicon();
  if (lexicon.is_in(WordClass::agreement, said))
    return parser.parse_whole({"yes"});
  return lexicon.is_in(WordClass::refusal, said) ? parser.parse_whole({"no"}) : std::nullopt;
}

/// It is said back that it is left out.
std::optional<PackedLogicalForm> parsed_remark(Parser& parser, const WordList& words) {
  auto result = parser.parse_whole({"that", "is", "a", "remark"});
  if (result)
    result->corrections.push_back({written(words), {}});
  return result;
}

/// "It is a little far away", "I should like to put my paper there": asks for nothing.
std::optional<PackedLogicalForm> remark_in(Parser& parser, const WordList& words) {
  const bool is_statement =
    is_among(words.front(), {"i", "it", "we", "he", "she", "they", "my", "our", "his", "her"}) &&
    is_aside(parser.lexicon(), words, Beside::request, false);
  const bool may_be_wish = std::ranges::any_of(words, [](const auto& x) {
    return is_among(x, {"you", "your", "it", "them", "that"});
  });
  if (!is_statement || (may_be_wish && words.front() != "it") || words[1] == "must" ||
      (words.front() == "it" && is_among(words[1], {"should", "has", "needs"})))
    return std::nullopt;
  return parsed_remark(parser, words);
}

} // namespace

std::optional<PackedLogicalForm> partly_understood(Parser& parser, const WordList& words) {
  if (words.empty())
    return std::nullopt;
  if (auto result = agreement_in(parser, words))
    return result;
  PartSearch search{parser, words};
  if (auto result = search.run())
    return result;
  LikelyMeaning meaning{parser, words};
  if (auto result = meaning.likely())
    return result;
  if (auto result = request_gist(parser, words))
    return result;
  if (auto result = meaning.possible())
    return result;
  if (auto result = search.without_place())
    return result;
  if (meaning.is_wish())
    return std::nullopt;
  auto result = remark_in(parser, words);
  if (!result && meaning.is_remark(true))
    result = parsed_remark(parser, words);
  if (result)
    result->mention = meaning.mention();
  return result;
}

std::optional<PackedLogicalForm>
partly_understood(Parser& parser, const WordList& said, const WordList& corrected,
                  const std::vector<SpellingCorrection>& corrections) {
  // What is left out is no place for typing errors: "..., I need to put my cup there".
  if (!corrections.empty())
    if (auto whole = parsed_request_alone(parser, said))
      return whole;
  std::optional<PackedLogicalForm> result;
  if (const auto other = paraphrased(said, parser.lexicon(), false)) {
    result = partly_understood(parser, *other);
    // In the words that were said.
    if (result)
      for (auto& x : result->corrections)
        if (x.word == written(*other))
          x.word = written(said);
  }
  if (!result)
    result = partly_understood(parser, said);
  if (!result && !corrections.empty()) {
    result = partly_understood(parser, corrected);
    if (result)
      result->corrections.insert(result->corrections.begin(), corrections.begin(),
                                 corrections.end());
  }
  return result;
}

} // namespace castor::communication
