#include "castor/communication/dialogue/request_gist.hpp"

#include "castor/communication/dialogue/beside_requests.hpp"
#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/thing_names.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

/// Of one utterance; what is said in earnest takes fewer.
constexpr int most_gist_parses = 300;

/// In words: a thing or a place.
constexpr std::size_t longest_part = 10;

/// What may not be left out, and makes a request another one.
bool decides(std::string_view word) {
  return is_among(word, {"not",     "n't",    "no",      "never",  "nothing", "without",  "except",
                         "but",     "unless", "until",   "if",     "only",    "instead",  "or",
                         "none",    "non",    "neither", "nor",    "avoid",   "opposite", "reverse",
                         "pretend", "half",   "when",    "nobody", "nowhere", "almost",   "nearly",
                         "hardly",  "barely", "mean",    "rather", "who",     "what",     "which",
                         "where",   "why",    "how",     "whose",  "than"});
}

bool may_ask(std::string_view word) {
  return is_among(word, {"what", "which", "who",    "where", "how",   "why",      "when",   "is",
                         "are",  "was",   "were",   "do",    "does",  "did",      "has",    "am",
                         "tell", "say",   "should", "may",   "whose", "describe", "explain"});
}

/// After it comes where something was.
bool begins_origin(std::string_view word) {
  return is_among(word, {"from", "off"});
}

bool is_pronoun_word(std::string_view word) {
  return is_among(word, {"it", "them", "this", "that", "these", "those"});
}

bool is_recipient(std::string_view word) {
  return is_among(word, {"me", "us"});
}

bool begins_place_phrase(std::string_view word) {
  return is_among(word, {"on",    "onto",    "in",      "into",   "at",       "by",       "to",
                         "near",  "next",    "close",   "beside", "behind",   "left",     "right",
                         "over",  "between", "towards", "toward", "against",  "together", "beneath",
                         "along", "above",   "under",   "just",   "directly", "all"});
}

class GistSearch {
public:
  GistSearch(Parser& parser, const WordList& words) : parser_(parser), words_(words) {}

  std::optional<PackedLogicalForm> run() {
    if (words_.size() < 3 || may_ask(words_.front()) || std::ranges::any_of(words_, decides))
      return std::nullopt;
    find_phrases();
    if (things_ == 0 || !is_rest_empty() || begins_with_other_verb())
      return std::nullopt;
    for (const auto& verb : verbs())
      for (const bool with_pronouns : {true, false})
        for (const bool things_first : {false, true}) {
          // Of several things, "it" is one.
          const bool is_clear = with_pronouns || things_ == 1;
          if (auto result = is_clear ? request_of(verb, with_pronouns, things_first) : std::nullopt)
            return result;
        }
    return std::nullopt;
  }

private:
  enum class Kind { thing, pronoun, place };

  struct Phrase {
    Kind kind = Kind::thing;
    WordList words;
  };

  const Lexicon& lexicon() const { return parser_.lexicon(); }

  std::optional<PackedLogicalForm> parse(WordList words) {
    return ++parses_ > most_gist_parses ? std::nullopt : parser_.parse_whole(std::move(words));
  }

  void find_phrases() {
    for (std::size_t i = 0; i < words_.size();) {
      if (auto found = phrase_at(i)) {
        const bool is_origin = i > 0 && begins_origin(words_[i - 1]);
        i += found->second;
        if (is_origin && found->first.kind == Kind::thing)
          continue;
        if (found->first.kind == Kind::thing)
          ++things_;
        phrases_.push_back(std::move(found->first));
      } else
        left_out_.push_back(words_[i++]);
    }
  }

  /// The longest one, and how many words are said.
  std::optional<std::pair<Phrase, std::size_t>> phrase_at(std::size_t begin) {
    const auto& first = words_[begin];
    if (first == "," || is_handling_verb(first, lexicon()))
      return std::nullopt;
    for (auto length = std::min(longest_part, words_.size() - begin); length > 0; --length) {
      auto said = words_between(words_, begin, begin + length);
      if (std::ranges::any_of(said, [&](auto& x) { return x == "," || says_nothing(x); }) ||
          is_among(said.back(), {"the", "a", "and"}))
        continue;
      if (begins_place_phrase(first) && is_place(said))
        return {{{Kind::place, std::move(said)}, length}};
      if (auto thing = thing_in(said))
        return {{{Kind::thing, std::move(*thing)}, length}};
    }
    if (is_pronoun_word(first))
      return {{{Kind::pronoun, {first}}, 1}};
    return std::nullopt;
  }

  std::optional<WordList> thing_in(const WordList& said) {
    const bool may_be_place = begins_place_phrase(said.front()) && said.front() != "left" &&
                              said.front() != "right" && !is_thing(said);
    ++parses_;
    return may_be_place || parses_ > most_gist_parses ? std::nullopt
                                                      : name_of_things(parser_, said);
  }

  bool is_thing(const WordList& said) {
    return ++parses_ <= most_gist_parses && names_things(parser_, said);
  }

  /// "Please", "real quick".
  bool says_nothing(const std::string& word) const {
    return !begins_place_phrase(word) &&
           (lexicon().filler(word) != nullptr || lexicon().is_in(WordClass::aside, word));
  }

  bool is_place(const WordList& said) {
    if (said.size() == 1 && !is_among(said.front(), {"left", "right", "together"}))
      return false;
    // "Weld the cube to the ball" does not say where the cube is to go.
    const bool may_be_otherwise = is_among(said.front(), {"to", "in", "into", "over", "at"});
    if (may_be_otherwise && is_thing(words_between(said, 1, said.size())))
      return false;
    for (const auto* pronoun : {"it", "them"}) {
      WordList request{"put", pronoun};
      request.insert(request.end(), said.begin(), said.end());
      if (const auto form = parse(std::move(request)); form && asks_for_handling(*form, lexicon()))
        return true;
    }
    return false;
  }

  /// "Measure the voltage of the cube for me" asks for nothing that is done with a cube.
  bool begins_with_other_verb() const {
    return !left_out_.empty() && left_out_.front() == words_.front() &&
           !lexicon().is_in(WordClass::aside, words_.front()) &&
           !lexicon().is_in(WordClass::frame, words_.front()) &&
           std::ranges::any_of(left_out_,
                               [&](const auto& x) {
                                 return x != "," && is_english_word(x) && !lexicon().knows(x);
                               }) &&
           std::ranges::find(phrases_, Kind::place, &Phrase::kind) == phrases_.end();
  }

  /// Whether nothing that is left out says something of a thing or a place.
  bool is_rest_empty() {
    return std::ranges::none_of(left_out_, [&](const auto& word) { return matters(word); });
  }

  bool matters(const std::string& word) {
    if (std::isdigit(static_cast<unsigned char>(word.front())) != 0)
      return true;
    if (is_among(word,
                 {"left",   "right",       "front",       "back",   "middle", "centre", "center",
                  "edge",   "corner",      "between",     "behind", "beside", "under",  "below",
                  "above",  "top",         "side",        "all",    "both",   "other",  "others",
                  "each",   "every",       "apart",       "two",    "three",  "four",   "five",
                  "cm",     "centimetres", "centimeters", "far",    "row",    "rows",   "line",
                  "column", "circle",      "ring",        "tower",  "stack",  "pile",   "order"}))
      return true;
    if (says_nothing(word) || is_recipient(word) || word == ",")
      return false;
    return lexicon().knows(word) && !is_among(word, {"a", "the", "i", "you"}) &&
           (is_thing({"the", word}) || is_thing({"the", word, "thing"}));
  }

  /// What is to be done: as it is said, or else what is done to things that go somewhere.
  std::vector<WordList> verbs() const {
    std::vector<WordList> result;
    const bool is_for_speaker = std::ranges::any_of(words_, is_recipient);
    const bool has_place =
      std::ranges::find(phrases_, Kind::place, &Phrase::kind) != phrases_.end();
    for (const auto& word : words_)
      if (is_handling_verb(word, lexicon()) &&
          std::ranges::find(result, WordList{word}) == result.end())
        result.push_back({word});
    const bool may_be_put = has_place || result.empty();
    if (result.size() > 1)
      result.clear();
    if (may_be_put)
      result.push_back({"put"});
    if (is_for_speaker && !has_place)
      result.insert(result.begin(), {"give", "me"});
    return result;
  }

  std::optional<PackedLogicalForm> request_of(const WordList& verb, bool with_pronouns,
                                              bool things_first) {
    auto request = verb;
    const auto add = [&](bool places, bool others) {
      for (const auto& x : phrases_) {
        const bool is_wanted = x.kind == Kind::place ? places : others;
        if (is_wanted && (with_pronouns || x.kind != Kind::pronoun))
          request.insert(request.end(), x.words.begin(), x.words.end());
      }
    };
    if (things_first) {
      add(false, true);
      add(true, false);
    } else
      add(true, true);
    auto form = parse(request);
    if (!form || !asks_for_handling(*form, lexicon()))
      return std::nullopt;
    form->partial = PartialRequest{{}, written(request), false};
    return form;
  }

  Parser& parser_;
  const WordList& words_;
  std::vector<Phrase> phrases_;
  WordList left_out_;
  std::size_t things_ = 0;
  int parses_ = 0;
};

} // namespace

std::optional<PackedLogicalForm> request_gist(Parser& parser, const WordList& words) {
  if (auto result = GistSearch{parser, words}.run())
    return result;
  const auto needed = without_reasons(words, parser.lexicon());
  return needed.size() < words.size() ? GistSearch{parser, needed}.run() : std::nullopt;
}

} // namespace castor::communication
