#include "castor/communication/dialogue/aside_clauses.hpp"

#include "castor/communication/dialogue/asides.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

using Words = std::span<const std::string>;

bool has_any_of(Words words, std::initializer_list<std::string_view> wanted) {
  return std::ranges::any_of(words, [&](const auto& x) { return is_among(x, wanted); });
}

/// Conditions, exceptions and what else changes the request beside them, wherever it stands.
bool restricts(Words words) {
  return has_any_of(words, {"unless",   "until",   "till",      "except",   "without", "only",
                            "instead",  "if",      "nobody",    "nothing",  "never",   "none",
                            "neither",  "nor",     "no",        "whenever", "once",    "otherwise",
                            "provided", "suppose", "supposing", "assuming", "mean",    "meant",
                            "forbid",   "hardly",  "rather"});
}

bool is_negation(std::string_view word) {
  return word == "not" || word == "n't";
}

bool is_finite(std::string_view word) {
  return is_among(word, {"is",    "are",    "was",    "were",  "am",    "'s",     "'re",   "'m",
                         "'ve",   "'d",     "'ll",    "has",   "have",  "had",    "do",    "does",
                         "did",   "can",    "could",  "will",  "would", "may",    "might", "must",
                         "shall", "should", "looks",  "look",  "seems", "seem",   "wants", "want",
                         "needs", "need",   "likes",  "loves", "feels", "sounds", "gets",  "goes",
                         "makes", "keeps",  "stands", "lies",  "sits",  "belongs"});
}

/// Finite verbs that the lexicon does not know end like that.
bool may_be_finite(const std::string& word, const Lexicon& lexicon) {
  return is_finite(word) ||
         (!lexicon.knows(word) && word.size() > 3 && (word.ends_with('s') || word.ends_with("ed")));
}

bool is_article(std::string_view word) {
  return is_among(word, {"the", "a", "an", "this", "that", "these", "those", "either", "both",
                         "every", "each", "all", "some", "another", "one"});
}

bool is_possessive(std::string_view word) {
  return is_among(word, {"my", "your", "his", "her", "its", "our", "their"});
}

/// Number of words of the subject that a statement begins with; 0 if it begins with none.
std::size_t subject_length(Words words, const Lexicon& lexicon) {
  const auto finite_after = [&](std::size_t length) {
    return length < words.size() && may_be_finite(words[length], lexicon);
  };
  const auto& first = words.front();
  if (is_among(first, {"i", "we", "he", "she", "they"}))
    return words.size() > 1 ? 1 : 0;
  const bool is_pronoun =
    is_among(first, {"it", "this", "that", "these", "those", "there", "everything", "everybody",
                     "everyone", "somebody", "someone", "something"}) ||
    lexicon.is_in(WordClass::name, first) || lexicon.is_in(WordClass::person, first);
  if (is_pronoun && finite_after(1))
    return 1;
  if (!is_article(first) && !is_possessive(first))
    return 0;
  // "The one that glows" tells which one is meant, and "the cube is" does not.
  constexpr std::size_t longest = 6;
  for (std::size_t length = 2; length <= std::min(longest, words.size()); ++length)
    if (is_among(words[length - 1], {"that", "which", "who", "of", "with", ","}))
      return 0;
    else if (finite_after(length))
      return length;
  return 0;
}

/// Statements with a negation that say nothing about what is to be done.
bool is_harmless_negation(Words statement, std::size_t subject) {
  const auto negation = std::ranges::find_if(statement, is_negation);
  const auto at = static_cast<std::size_t>(negation - statement.begin());
  if (has_any_of(statement, {"you", "your", "want", "let", "must", "should", "shall", "may", "to",
                             "like", "wish"}) ||
      at != subject + 1 || std::ranges::count_if(statement, is_negation) > 1)
    return false;
  const auto& who = statement.front();
  const auto after = statement.subspan(at + 1);
  if (is_among(who, {"i", "we", "he", "she", "they"}) &&
      is_among(statement[subject], {"do", "does", "did", "can", "could", "have", "has"}))
    return !after.empty() &&
           is_among(after.front(), {"need", "see", "reach", "know", "remember", "find", "care",
                                    "mind", "understand", "believe", "think", "recall", "feel",
                                    "needed", "seen", "noticed", "found"});
  return is_among(who, {"it", "that", "this", "they", "these", "those", "the", "he", "she", "i"}) &&
         is_among(statement[subject], {"is", "are", "was", "were", "'s", "'re", "'m", "am"});
}

bool is_statement(Words words, Beside beside, const Lexicon& lexicon) {
  const auto subject = subject_length(words, lexicon);
  if (subject == 0)
    return false;
  // "Two of them vanish, how many are left?"
  if (beside == Beside::question && std::ranges::any_of(words, [&](const auto& x) {
        return lexicon.meanings().actions.contains(x);
      }))
    return false;
  return std::ranges::none_of(words, is_negation) || is_harmless_negation(words, subject);
}

bool is_decisive(Words words, const Lexicon& lexicon) {
  return std::ranges::any_of(words,
                             [&](const auto& x) { return lexicon.is_in(WordClass::decisive, x); });
}

/// "Polish the cube", "tickle it".
bool is_other_deed(Words words, const Lexicon& lexicon) {
  if (words.size() < 2 || is_decisive(words, lexicon))
    return false;
  const auto& verb = words.front();
  const bool may_be_verb = !lexicon.knows(verb) || lexicon.meanings().actions.contains(verb) ||
                           is_among(verb, {"make", "let", "keep", "have", "help", "tell"});
  return may_be_verb && !is_article(verb) &&
         (is_article(words[1]) || is_possessive(words[1]) ||
          is_among(words[1], {"it", "them", "me", "him", "us", "sure", "up"}));
}

/// "Just kidding": before a request, words that are not known or say nothing of it.
bool is_exclamation(Words words, const Lexicon& lexicon) {
  constexpr std::size_t longest = 3;
  return words.size() <= longest && !is_decisive(words, lexicon) &&
         std::ranges::none_of(words, is_negation) && std::ranges::all_of(words, [&](const auto& x) {
           return !lexicon.knows(x) || lexicon.is_in(WordClass::aside, x) ||
                  lexicon.is_in(WordClass::frame, x) || is_among(x, {"fine", "good", "great"});
         });
}

/// "Be quick", "hurry up", "mind the cylinder".
bool is_manner(Words words, const Lexicon& lexicon) {
  constexpr std::size_t longest = 4;
  if (words.size() > longest || is_decisive(words, lexicon))
    return false;
  if (begins_caution(words))
    return true;
  if (words.front() == "be")
    return words.size() > 1 && !is_article(words[1]) &&
           std::ranges::none_of(words.subspan(1), [&](const auto& x) {
             return is_among(x, {"on", "in", "at", "to", "near", "there", "here", "left", "right"});
           });
  return is_among(words.front(), {"hurry", "quick", "careful", "gently", "go"}) &&
         words.size() <= 2;
}

/// "Maestro" after all else calls somebody.
bool is_vocative(Words words, const Lexicon& lexicon) {
  const auto frame = words.size() == 1 ? frame_of(words, lexicon) : std::nullopt;
  return frame && !frame->has_adverb && !words.front().ends_with("er");
}

/// "Nearly touching", "for a second look": what is said after a request of how it is meant, but of
/// no other thing, and no place.
bool is_appendix(Words words, const Lexicon& lexicon) {
  constexpr std::size_t longest = 6;
  const auto& first = words.front();
  return words.size() <= longest && !is_decisive(words, lexicon) &&
         std::ranges::none_of(words, is_negation) && !is_article(first) && !is_possessive(first) &&
         !is_among(first, {"on",   "in",    "at",    "to",    "into",  "onto",   "next",   "beside",
                           "left", "right", "near",  "with",  "of",    "or",     "which",  "who",
                           "that", "by",    "from",  "after", "above", "below",  "under",  "where",
                           "up",   "down",  "over",  "out",   "there", "here",   "as",     "like",
                           "and",  "but",   "so",    "all",   "both",  "two",    "than",   "behind",
                           "what", "how",   "until", "while", "when",  "before", "between"});
}

class AsideJudge {
public:
  AsideJudge(const Lexicon& lexicon, Beside beside) : lexicon_(lexicon), beside_(beside) {}

  bool clause(Words words, bool is_first) const {
    if (words.empty())
      return true;
    if (const auto frame = frame_of(words, lexicon_);
        frame && (is_first || frame->has_person || frame->unknown == 0))
      return !restricts_more(words);
    return !restricts(words) &&
           (is_manner(words, lexicon_) || is_statement(words, beside_, lexicon_) ||
            is_vocative(words, lexicon_) ||
            (is_first && beside_ == Beside::request && is_exclamation(words, lexicon_)) ||
            (!is_first && beside_ == Beside::request && is_appendix(words, lexicon_)) ||
            (beside_ == Beside::request && is_other_deed(words, lexicon_)));
  }

private:
  /// A polite "if" is known as one.
  static bool restricts_more(Words words) {
    return has_any_of(words, {"mean", "meant", "instead", "only"});
  }

  const Lexicon& lexicon_;
  Beside beside_;
};

} // namespace

bool begins_caution(std::span<const std::string> words) {
  return words.size() > 1 && is_among(words[0], {"mind", "watch"}) && words[1] != "out";
}

bool joins_clauses(const std::string& word) {
  return is_among(word, {"and", "so", "but", "then", "because", "since", "though", "well", "now"});
}

bool is_aside(const Lexicon& lexicon, std::span<const std::string> words, Beside beside,
              bool is_first) {
  const AsideJudge judge{lexicon, beside};
  // The whole may be a frame, such as "would you be a dear and".
  if (judge.clause(words, is_first) && std::ranges::find(words, ",") == words.end())
    return true;
  std::vector<std::string> clause;
  const auto is_next_aside = [&] {
    auto said = std::exchange(clause, {});
    auto begin = said.begin();
    while (begin != said.end() && joins_clauses(*begin))
      ++begin;
    auto end = said.end();
    while (end != begin && joins_clauses(*std::prev(end)))
      --end;
    return judge.clause({begin, end}, is_first);
  };
  for (const auto& word : words) {
    if (word == "," && !is_next_aside())
      return false;
    if (word != ",")
      clause.push_back(word);
  }
  return is_next_aside();
}

} // namespace castor::communication
