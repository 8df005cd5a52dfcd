#include "castor/communication/dialogue/likely_meaning.hpp"

#include "castor/communication/dialogue/asides.hpp"
#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/thing_names.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/examples.hpp"
#include "castor/communication/parsing/stem.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;
using Pieces = std::vector<ExamplePiece>;

/// How certain a meaning has to be, so that it is done, a question is answered, or the speaker is
/// asked: its likeness, and by how much the next one is less like.
constexpr double least_to_do = 0.8;
constexpr double least_to_answer = 0.65;
constexpr double least_to_ask = 0.38;

/// If it says the same things and places, however.
constexpr double least_to_do_the_same = 0.45;

/// How like the examples it has to be to be done or answered, if no other meaning is near.
constexpr double least_likeness = 0.5;

/// In words: "further" and the like are found in much that means something else.
constexpr std::size_t shortest_meaning_to_ask = 3;

/// Meanings that are tried, the nearest first.
constexpr std::size_t most_meanings = 3;

/// Of an utterance; examples are shorter.
constexpr std::size_t most_words = 24;

/// In words: what names things.
constexpr std::size_t longest_name = 6;

bool stands_for_things(std::string_view word) {
  return is_among(word, {"it", "them", "they", "these", "those"});
}

bool may_begin_question(std::string_view word) {
  return is_among(word, {"what", "which", "where", "how", "why", "who", "is", "are"});
}

WordList without_articles(WordList words) {
  std::erase_if(words, [](const auto& x) { return is_among(x, {"the", "a", "an", "please"}); });
  return words;
}

bool joins_names(const ExamplePiece& piece) {
  return !piece.names_things && is_among(piece.words.front(), {",", "and", "then"});
}

/// Each an article and one word at most.
bool are_short(const ExamplePiece& a, const ExamplePiece& b) {
  return a.words.size() <= 2 && b.words.size() <= 2;
}

/// Says nothing of what is to be done.
bool is_function_word(std::string_view word) {
  return is_among(word, {",",   "a",   "an",   "the",  "at",    "in",    "on",    "to",
                         "of",  "for", "i",    "we",   "you",   "it",    "'s",    "'d",
                         "'ll", "let", "want", "like", "would", "can",   "will",  "could",
                         "get", "be",  "have", "put",  "move",  "place", "along", "please"});
}

bool may_precede_verb(std::string_view word) {
  return is_among(word, {"i", "you", "we"});
}

/// What any thing may be called.
bool is_general_name(std::string_view word) {
  return is_among(word, {"thing", "things", "object", "objects", "item", "items", "one", "ones",
                         "everything", "stuff"});
}

} // namespace

class LikelyMeaning::Search {
public:
  Search(Parser& parser, const WordList& words)
    : parser_(parser), said_(words), words_(without_asides(words, parser.lexicon(), true)) {}

  /// \param is_proposed whether the speaker may be asked
  std::optional<PackedLogicalForm> run(bool is_proposed) {
    if (words_.empty() || words_.size() > most_words || may_name_other_thing())
      return std::nullopt;
    if (!pieces_)
      pieces_ = pieces_of_words();
    if (!is_proposed && ends_with_other_clause(*pieces_))
      return std::nullopt;
    if (!matches_)
      matches_ = matches(*pieces_);
    auto found = *matches_;
    const bool asks = may_begin_question(words_.front());
    // "Can you put the ball on the left" does not ask whether it is there.
    const bool is_request =
      words_.front() == "please" ||
      std::ranges::any_of(words_, [&](const auto& x) { return is_handling_verb(x, lexicon()); });
    if (!asks && is_request)
      std::erase_if(found, [](const auto& x) { return may_begin_question(x.meaning.front()); });
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto& meaning = found[i].meaning;
      const auto next = i + 1 < found.size() ? found[i + 1].likeness : 0;
      auto certainty = 2 * found[i].likeness - next;
      // What is little like anything is never done.
      if (found[i].likeness < least_likeness)
        certainty = std::min(certainty, least_to_answer - 0.01);
      const bool is_question = may_begin_question(meaning.front());
      if (!is_question && certainty >= least_to_do_the_same && says_the_same(meaning))
        certainty = std::max(certainty, least_to_do);
      if (has_unknown_verb() && !says_where_to(meaning))
        certainty = std::min(certainty, least_to_do - 0.01);
      if (certainty < (is_proposed ? least_to_ask : least_to_do))
        break;
      auto form = parser_.parse_whole(meaning);
      if (!form || (asks && !is_question && certainty < least_to_do))
        continue;
      const bool is_handled = asks_for_handling(*form, lexicon());
      const auto least = is_question                        ? least_to_answer
                         : is_prohibition(*form, lexicon()) ? least_to_ask
                                                            : least_to_do;
      if (certainty < least) {
        if (is_question || !is_handled || meaning.size() < shortest_meaning_to_ask)
          continue;
        form->partial = PartialRequest{{}, written(meaning), false};
      } else if ((is_question || is_handled) &&
                 without_articles(meaning) != without_articles(words_))
        // What the robot can not do it need not repeat in other words.
        form->corrections.push_back({written(said_), written(meaning)});
      return form;
    }
    return std::nullopt;
  }

private:
  const Lexicon& lexicon() const { return parser_.lexicon(); }

  static bool says_where_to(const WordList& meaning) {
    return std::ranges::any_of(meaning, [](const auto& x) {
      return is_among(x, {"on", "at", "in", "to", "next", "between", "behind", "beside"});
    });
  }

  /// "Weld the cubes together" is not what it is like; "load the cube onto the box" may be.
  bool has_unknown_verb() const {
    for (std::size_t i = 0; i + 1 < pieces_->size(); ++i) {
      const auto& piece = (*pieces_)[i];
      const bool may_be_verb = i == 0 || may_precede_verb((*pieces_)[i - 1].words.back());
      if (may_be_verb && !piece.names_things && (*pieces_)[i + 1].names_things &&
          !lexicon().knows(piece.words.front()))
        return true;
    }
    return false;
  }

  /// Whether the meaning says all that is said, and no more.
  bool says_the_same(const WordList& meaning) const {
    const auto said = contents_of(words_);
    const auto meant = contents_of(meaning);
    return !said.empty() && std::ranges::includes(meant, said) &&
           std::ranges::all_of(meant, [&](const auto& x) {
             return said.contains(x) || is_among(x, {"put", "edg", "side", "tabl"});
           });
  }

  /// Stems of what is said of things and places.
  std::set<std::string> contents_of(const WordList& words) const {
    std::set<std::string> result;
    for (const auto& word : words)
      if (!is_function_word(word) && !lexicon().is_in(WordClass::aside, word) &&
          !lexicon().is_in(WordClass::frame, word) && lexicon().filler(word) == nullptr)
        result.insert(stem_of(word));
    return result;
  }

  /// Words that are not known may; those that only say how do not, "gingerly", and neither do
  /// verbs: "may I borrow the ball".
  bool may_name_other_thing() const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const auto& word = words_[i];
      const bool may_be_verb = i > 0 && may_precede_verb(words_[i - 1]);
      if (word != "," && !may_be_verb && !lexicon().knows(word) && !lexicon().is_in_a_class(word) &&
          !word.ends_with("ly") && !word.ends_with("ing"))
        return true;
    }
    return false;
  }

  /// "And be quick", that names nothing.
  static bool ends_with_other_clause(const Pieces& pieces) {
    const auto last = std::ranges::find_if(pieces.rbegin(), pieces.rend(), joins_names);
    return last != pieces.rend() &&
           std::none_of(pieces.rbegin(), last, [](const auto& x) { return x.names_things; }) &&
           std::any_of(pieces.rbegin(), last,
                       [](const auto& x) { return x.words.front() != "please"; });
  }

  std::vector<Examples::Match> matches(const Pieces& pieces) {
    std::vector<Examples::Match> result;
    for (const auto& said : {pieces, with_lists(pieces), with_words_for_all(pieces)})
      for (auto& match : lexicon().examples().nearest(said, most_meanings)) {
        const auto same = std::ranges::find(result, match.meaning, &Examples::Match::meaning);
        if (same == result.end())
          result.push_back(std::move(match));
        else
          same->likeness = std::max(same->likeness, match.likeness);
      }
    std::ranges::stable_sort(result, std::ranges::greater{}, &Examples::Match::likeness);
    return result;
  }

  Pieces pieces_of_words() {
    Pieces result;
    for (std::size_t i = 0; i < words_.size();) {
      auto [piece, length] = piece_at(i);
      result.push_back(std::move(piece));
      i += length;
    }
    return result;
  }

  /// And how many words it has.
  std::pair<ExamplePiece, std::size_t> piece_at(std::size_t begin) {
    const auto& first = words_[begin];
    const std::pair word{ExamplePiece{{first}, false}, std::size_t{1}};
    if (stands_for_things(first)) {
      const bool is_of_all = begin + 1 < words_.size() && words_[begin + 1] == "all";
      return {{{first == "they" ? "them" : first}, true}, is_of_all ? 2U : 1U};
    }
    const bool is_asked_for =
      begin > 0 && is_among(words_[begin - 1], {"which", "what", "how", "many", "whose"});
    if (is_asked_for || is_handling_verb(first, lexicon()))
      return word;
    for (auto length = std::min(longest_name, words_.size() - begin); length > 0; --length) {
      const auto said = words_between(words_, begin, begin + length);
      if (!may_name_things(said))
        continue;
      if (auto name = name_in(said))
        return {{std::move(*name), true}, length};
    }
    return word;
  }

  /// "The blue ball" for "blue ball", and for "ball blue".
  std::optional<WordList> name_in(const WordList& said) {
    if (said.size() == 1 && is_among(said.front(), {"one", "ones"}))
      return std::nullopt;
    auto with_article = said;
    with_article.insert(with_article.begin(), "the");
    if (names_things(parser_, with_article))
      return with_article;
    const bool has_article = is_among(said.front(), {"the", "a", "this", "that"});
    if (said.size() == (has_article ? 3 : 2)) {
      const auto& noun = said[said.size() - 2];
      const WordList turned{"the", said.back(), noun};
      if (!lexicon().examples().has_common_word(noun) && names_things(parser_, turned))
        return turned;
    }
    return names_things(parser_, said) ? std::optional{said} : std::nullopt;
  }

  /// Its last word does, and no word says what is to be done.
  bool may_name_things(const WordList& said) {
    if (says_nothing(said.front()) ||
        (number_of_word(said.back()) && !is_general_name(said.back())) ||
        std::isdigit(static_cast<unsigned char>(said.back().front())) != 0 ||
        std::ranges::find(said, ",") != said.end())
      return false;
    // "A circle of things" is what they are to make.
    const auto of = std::ranges::find(said, "of");
    if (of != said.end() && of != said.begin() &&
        lexicon().examples().has_common_word(*std::prev(of)) && !is_general_name(*std::prev(of)))
      return false;
    const auto& last = said.back();
    if (lexicon().examples().has_common_word(last) && !is_general_name(last))
      return false;
    const auto known = names_.find(last);
    return known != names_.end()
             ? known->second
             : names_.emplace(last, is_general_name(last) || name_of_things(parser_, {last}))
                 .first->second;
  }

  /// Such as "then", or "to" of "give to me".
  bool says_nothing(const std::string& word) const {
    return lexicon().filler(word) != nullptr || lexicon().is_in(WordClass::aside, word) ||
           is_among(word, {"and", "or", "of", "to", "for", "from", "with", "on", "in", "at", "by"});
  }

  /// "Red, green and blue" as what is named once.
  static Pieces with_lists(const Pieces& pieces) {
    Pieces result;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      auto next = i;
      while (next < pieces.size() && joins_names(pieces[next]))
        ++next;
      // "Purple red yellow" are several, a "cube square" is one that stands square.
      const bool is_joined = next > i || (i > 0 && are_short(pieces[i - 1], pieces[i]));
      const bool goes_on = !result.empty() && result.back().names_things && next < pieces.size() &&
                           pieces[next].names_things && is_joined;
      if (!goes_on) {
        result.push_back(pieces[i]);
        continue;
      }
      const bool is_last = std::none_of(pieces.begin() + static_cast<std::ptrdiff_t>(next) + 1,
                                        pieces.end(), [](const auto& x) { return x.names_things; });
      auto& list = result.back().words;
      list.emplace_back(is_last ? "and" : ",");
      list.insert(list.end(), pieces[next].words.begin(), pieces[next].words.end());
      i = next;
    }
    return result;
  }

  /// With "everything" and pronouns as words.
  static Pieces with_words_for_all(const Pieces& pieces) {
    Pieces result;
    for (const auto& piece : pieces)
      if (piece.names_things &&
          (stands_for_things(piece.words.front()) || is_general_name(piece.words.back())))
        for (const auto& word : piece.words)
          result.push_back({{word}, false});
      else
        result.push_back(piece);
    return result;
  }

  Parser& parser_;
  const WordList& said_;
  /// Without asides.
  WordList words_;
  std::optional<Pieces> pieces_;
  std::optional<std::vector<Examples::Match>> matches_;
  /// Whether a word may be the last one of what names things.
  std::map<std::string, bool> names_;
};

LikelyMeaning::LikelyMeaning(Parser& parser, const WordList& words)
  : search_(std::make_unique<Search>(parser, words)) {}

LikelyMeaning::~LikelyMeaning() = default;

std::optional<PackedLogicalForm> LikelyMeaning::likely() {
  return search_->run(false);
}

std::optional<PackedLogicalForm> LikelyMeaning::possible() {
  return search_->run(true);
}

} // namespace castor::communication
