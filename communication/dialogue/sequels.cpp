#include "castor/communication/dialogue/sequels.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/dialogue/likely_meaning.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

/// What joins two parts.
bool is_link(std::string_view word) {
  return is_among(word, {",", "and", "then", "but", "so", "afterwards", "finally", "also"});
}

bool begins_question(const WordList& words) {
  return !words.empty() &&
         is_among(words.front(),
                  {"tell",  "say",   "report", "answer", "let",     "show",     "what", "where",
                   "which", "how",   "is",     "are",    "do",      "does",     "did",  "why",
                   "who",   "count", "name",   "list",   "explain", "describe", "has",  "have"});
}

bool has_pronoun(const WordList& words) {
  return std::ranges::any_of(words, [](const auto& x) {
    return is_among(x, {"it", "its", "they", "them", "their", "those", "that"});
  });
}

/// "Moving", "moved", "taken": words that may be the verb.
WordList base_forms(const std::string& word) {
  static const std::map<std::string, std::string, std::less<>> irregular{
    {"put", "put"},  {"set", "set"},    {"taken", "take"},  {"given", "give"}, {"brought", "bring"},
    {"laid", "lay"}, {"slid", "slide"}, {"swept", "sweep"}, {"built", "build"}};
  if (const auto known = irregular.find(word); known != irregular.end())
    return {known->second};
  WordList result;
  for (const auto* ending : {"ing", "ed"})
    if (word.ends_with(ending)) {
      auto stem = word.substr(0, word.size() - std::string_view{ending}.size());
      result.push_back(stem + 'e');
      result.push_back(stem);
      if (stem.size() > 2 && stem.back() == stem[stem.size() - 2])
        result.push_back(stem.substr(0, stem.size() - 1));
    }
  return result;
}

/// "There is", "it does": says again what was asked.
bool takes_up_question(const WordList& words) {
  return words == WordList{"so"} || words == WordList{"yes"} || words == WordList{"not"} ||
         words == WordList{"no"} ||
         (words.size() <= 3 && is_among(words.front(), {"there", "it", "they", "you", "that"}) &&
          is_among(words.back(), {"is", "are", "does", "do", "can", "has", "have", "not", "n't"}));
}

class SequelSearch {
public:
  SequelSearch(Parser& parser, const WordList& words, const PartParser& parse_part)
    : parser_(parser), words_(words), parse_part_(parse_part) {}

  std::optional<PackedLogicalForm> question_beside() {
    for (std::size_t i = 1; i + 1 < words_.size(); ++i) {
      if (!is_link(words_[i]) || is_link(words_[i - 1]))
        continue;
      const auto before = part(0, i);
      const auto after = part(i, words_.size());
      const bool asks_after = begins_question(after);
      const bool asks_before = begins_question(before);
      if (asks_after == asks_before && !(asks_after && has_pronoun(after)))
        continue;
      // "Where was the ball before?" is asked of who moves it, as requests are.
      auto first = parsed(before);
      if (!first || !(requests(*first) || (asks_before && asks(*first))))
        continue;
      const auto second = parsed(after);
      if (!second || !(requests(*second) || (asks_after && asks(*second))))
        continue;
      first->sequel = Sequel{written(after), asks_after};
      return first;
    }
    return std::nullopt;
  }

  std::optional<PackedLogicalForm> in_order() {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const auto& word = words_[i];
      std::optional<PackedLogicalForm> result;
      if (word == "if" || word == "unless")
        result = on_condition(i);
      else if (is_among(word, {"before", "after", "once", "when"}))
        result = in_time(i);
      if (result)
        return result;
    }
    return std::nullopt;
  }

private:
  // -- conditions

  /// \param at place of "if"
  std::optional<PackedLogicalForm> on_condition(std::size_t at) {
    const bool is_negated = words_[at] == "unless";
    const auto before = part(0, at);
    if (!before.empty() &&
        is_among(before.back(), {"see", "check", "me", "know", "ask", "say", "as", "even", "what"}))
      return std::nullopt;
    if (!before.empty() && (begins_question(before) || is_among(before.front(), {"can", "could"})))
      if (auto result = on_answer(before, at))
        return result;
    if (!before.empty()) {
      auto rest = part(at + 1, words_.size());
      const auto otherwise = split_otherwise(rest);
      auto request = before;
      while (!request.empty() && (request.back() == "only" || is_link(request.back())))
        request.pop_back();
      // "Take the ball if it is red."
      return conditional(with_thing_of(parser_, rest, request), request, otherwise, is_negated);
    }
    for (auto i = at + 2; i + 1 < words_.size(); ++i)
      if (const bool is_boundary = words_[i] == "," || words_[i] == "then" ||
                                   words_[i] == "please" ||
                                   is_handling_verb(words_[i], parser_.lexicon());
          is_boundary) {
        auto request = part(i, words_.size());
        const auto otherwise = split_otherwise(request);
        if (auto result = conditional(condition(at + 1, i), request, otherwise, is_negated))
          return result;
      }
    return std::nullopt;
  }

  /// "So" says that it is, in "if so".
  WordList condition(std::size_t begin, std::size_t end) const {
    auto result = part(begin, end);
    return result.empty() && words_[begin] == "so" ? WordList{"so"} : result;
  }

  /// "Can it stand on the cube, and if so, will you put it there?"
  /// \param at place of "if"
  std::optional<PackedLogicalForm> on_answer(const WordList& question, std::size_t at) {
    for (auto i = at + 2; i + 1 < words_.size(); ++i) {
      const auto clause = condition(at + 1, i);
      if (clause.empty() || !takes_up_question(clause))
        continue;
      auto request = part(i, words_.size());
      const auto otherwise = split_otherwise(request);
      const bool is_negated = is_among(clause.back(), {"not", "no", "n't"});
      return conditional(question, request, otherwise, is_negated);
    }
    return std::nullopt;
  }

  /// Takes what is to be done otherwise off the end.
  WordList split_otherwise(WordList& words) const {
    for (std::size_t i = 1; i < words.size(); ++i) {
      const bool is_or_else = words[i] == "else" && words[i - 1] == "or";
      const bool is_if_not =
        words[i] == "if" && i + 1 < words.size() && is_among(words[i + 1], {"not", "no"});
      if (words[i] != "otherwise" && !is_or_else && !is_if_not)
        continue;
      auto result = trimmed(words_between(words, i + (is_if_not ? 2 : 1), words.size()));
      words = trimmed(words_between(words, 0, is_or_else ? i - 1 : i));
      return result;
    }
    return {};
  }

  std::optional<PackedLogicalForm> conditional(const WordList& condition, const WordList& request,
                                               const WordList& otherwise, bool is_negated) {
    if (condition.empty() || request.empty() || !may_follow(request) ||
        !(otherwise.empty() || may_follow(otherwise)))
      return std::nullopt;
    Sequel sequel{written(request), false, true, written(otherwise)};
    if (is_negated)
      std::swap(sequel.words, sequel.otherwise);
    std::optional<PackedLogicalForm> result;
    if (takes_up_question(condition))
      result = parser_.parse_whole(
        {is_among(condition.back(), {"not", "no", "n't"}) ? std::string{"no"} : "yes"});
    else
      result = parsed(condition);
    if (!result)
      return std::nullopt;
    result->sequel = std::move(sequel);
    const auto move = move_of(*result, parser_.lexicon());
    const bool can_be_so = takes_up_question(condition) ||
                           move.type == DialogueMoveType::question_yn ||
                           asks_for_ability(move.content);
    return can_be_so ? result : std::nullopt;
  }

  /// Whether it is something to do, or not to do, or to say.
  bool may_follow(const WordList& words) {
    const auto form = parsed(words);
    return form && (requests(*form) || asks(*form));
  }

  // -- order

  /// \param at place of the word that says which comes first
  std::optional<PackedLogicalForm> in_time(std::size_t at) {
    const bool is_other_first = words_[at] != "before";
    if (at > 0) {
      auto main = part(0, at);
      return main.empty() ? std::nullopt
                          : ordered(main, part(at + 1, words_.size()), is_other_first);
    }
    for (std::size_t i = 2; i + 1 < words_.size(); ++i)
      if (words_[i] == ",")
        if (auto result = ordered(part(i, words_.size()), part(1, i), is_other_first))
          return result;
    return std::nullopt;
  }

  /// \param other as it is said of the order: "you have moved the ball", "moving the ball"
  std::optional<PackedLogicalForm> ordered(const WordList& main, const WordList& other,
                                           bool is_other_first) {
    for (auto request : requests_in(other)) {
      const auto other_form = parsed(request);
      if (!other_form || !requests(*other_form))
        continue;
      // "Before you move the ball, tell me where it is."
      const auto named = with_thing_of(parser_, main, request);
      if (is_other_first) {
        auto first = other_form;
        const auto later = with_places_before(named);
        const auto then = parsed(later);
        if (!then || !(requests(*then) || asks(*then)))
          continue;
        first->sequel = Sequel{written(later), asks(*then)};
        return first;
      }
      auto first = parsed(named);
      if (!first || !(requests(*first) || asks(*first)))
        continue;
      first->sequel = Sequel{written(request), false};
      return first;
    }
    return std::nullopt;
  }

  /// "Put the cube where the ball is, after you have moved the ball": where it was then.
  static WordList with_places_before(WordList words) {
    const auto where = std::ranges::find(words, "where");
    const auto verb = std::find_if(where, words.end(), [](const auto& x) {
      return is_among(x, {"is", "'s", "are"});
    });
    if (verb != words.end())
      *verb = *verb == "are" ? "were" : "was";
    return words;
  }

  /// "You have moved the ball", "moving the ball" as requests, as many as there may be.
  std::vector<WordList> requests_in(const WordList& words) const {
    std::size_t verb = 0;
    if (!words.empty() && is_among(words[0], {"you", "we", "i"}))
      ++verb;
    const bool is_had =
      verb > 0 && verb < words.size() && is_among(words[verb], {"have", "'ve", "had", "did"});
    if (is_had)
      ++verb;
    if (verb + 1 >= words.size())
      return {};
    auto bases = base_forms(words[verb]);
    if (verb == 1)
      bases.insert(bases.begin(), words[verb]);
    std::vector<WordList> result;
    for (auto& base : bases) {
      result.push_back(words_between(words, verb, words.size()));
      result.back().front() = std::move(base);
    }
    return result;
  }

  // -- parts

  WordList part(std::size_t begin, std::size_t end) const {
    return trimmed(words_between(words_, begin, end));
  }

  /// Without what links it to other parts.
  static WordList trimmed(WordList words) {
    while (!words.empty() && is_link(words.back()))
      words.pop_back();
    words.erase(words.begin(),
                std::ranges::find_if(words, [](const auto& x) { return !is_link(x); }));
    return words;
  }

  std::optional<PackedLogicalForm> parsed(const WordList& words) const {
    auto form = words.empty() ? std::nullopt : parse_part_(words);
    return form && !form->sequel ? form : std::nullopt;
  }

  bool requests(const PackedLogicalForm& form) const {
    return asks_for_handling(form, parser_.lexicon()) || is_prohibition(form, parser_.lexicon());
  }

  /// Whether it is a question about what is there, or what was done.
  bool asks(const PackedLogicalForm& form) const {
    const auto move = move_of(form, parser_.lexicon());
    return move.type == DialogueMoveType::question_w ||
           move.type == DialogueMoveType::question_yn || move.type == DialogueMoveType::small_talk;
  }

  Parser& parser_;
  const WordList& words_;
  const PartParser& parse_part_;
};

} // namespace

std::optional<PackedLogicalForm> parsed_question_beside(Parser& parser, const WordList& words,
                                                        const PartParser& parse_part) {
  return SequelSearch{parser, words, parse_part}.question_beside();
}

bool asks_about_answer(const WordList& words) {
  const auto link = std::ranges::find(words, "and");
  if (link == words.end() || !is_among(words.front(), {"what", "which", "where", "who", "how"}))
    return false;
  const WordList after(std::next(link), words.end());
  return begins_question(after) && has_pronoun(after);
}

bool has_condition_on_it(const WordList& words) {
  const auto begin =
    std::ranges::find_if(words, [](const auto& x) { return x == "if" || x == "unless"; });
  return begin != words.begin() && begin != words.end() &&
         has_pronoun(WordList(std::next(begin), words.end()));
}

std::optional<PackedLogicalForm> parsed_in_order(Parser& parser, const WordList& words,
                                                 const PartParser& parse_part) {
  return SequelSearch{parser, words, parse_part}.in_order();
}

std::optional<bool> truth_said(const Response& response) {
  if (response.sentences.empty() || response.sentences.front().content.nominals.empty())
    return std::nullopt;
  const auto& said = response.sentences.front().content;
  const auto& root = *find_nominal(said, said.root);
  const auto* marker = root.sort == "marker" ? &root : dependent(said, root, "Marker");
  if (marker == nullptr || (marker->proposition != "yes" && marker->proposition != "no"))
    return std::nullopt;
  return marker->proposition == "yes";
}

Continuation continued(const DialogueMove& move, Response response,
                       std::optional<bool> last_answer) {
  if (!move.sequel)
    return {std::move(response), {}};
  if (!move.sequel->is_conditional)
    return {std::move(response), move.sequel->words};
  auto is_so = truth_said(response);
  if (last_answer && move.type == DialogueMoveType::accept)
    is_so = last_answer;
  else if (last_answer && move.type == DialogueMoveType::reject)
    is_so = !*last_answer;
  auto next = !is_so ? std::string{} : *is_so ? move.sequel->words : move.sequel->otherwise;
  if (is_so && next.empty())
    response = {RhetoricalRelation::answer, {}, "I do nothing then.", {}};
  return {std::move(response), std::move(next)};
}

} // namespace castor::communication
