#include "castor/communication/dialogue/likely_meaning.hpp"

#include "castor/communication/dialogue/asides.hpp"
#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/example_pieces.hpp"
#include "castor/communication/dialogue/thing_names.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/examples.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/stem.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;
using Pieces = std::vector<ExamplePiece>;

/// How certain a meaning has to be, so that it is done, a question is answered, or the speaker is
/// asked. Of sentences of writers from whom nothing was learned, 95 to 97 of a hundred that are
/// done are right, and 91 to 95 of those that are asked back or done.
constexpr double least_to_do = 1.1;
constexpr double least_to_answer = 0.9;
constexpr double least_to_ask = 0.1;

/// If it says the same things and places, however.
constexpr double least_to_do_the_same = 0.5;

/// How like the examples it has to be to be done or answered, however certain its meaning is.
constexpr double least_likeness = 0.12;

/// To be asked; words that make another matter of it leave less.
constexpr double least_likeness_to_ask = 0.06;

/// The same of what does not begin like a question, but is taken for one; and how certain it has to
/// be if it begins like another question.
constexpr double least_likeness_of_question = 0.25;
constexpr double least_to_answer_other = 1.6;

/// In words: "further" and the like are found in much that means something else.
constexpr std::size_t shortest_meaning_to_ask = 3;

/// The meaning of what asks for nothing, and how certain it has to be.
constexpr auto remark = "that is a remark";
constexpr auto impossible = "do magic";
constexpr double least_for_impossible = 1.6;
constexpr double least_for_remark = 0.5;
constexpr std::size_t shortest_remark = 3;

/// Meanings that are tried, the most certain first.
constexpr std::size_t most_meanings = 3;

/// Of an utterance; examples are shorter.
constexpr std::size_t most_words = 24;

bool may_begin_question(std::string_view word) {
  return is_among(word, {"what", "which", "where", "how", "why", "who", "is", "are"});
}

bool begins_yes_no_question(std::string_view word) {
  return is_among(word, {"has", "have", "had", "do", "does", "did", "was", "were", "can", "could",
                         "will", "would", "shall", "should", "may", "might", "am"});
}

/// "What" and "which" ask for the same.
bool begin_same_question(std::string_view a, std::string_view b) {
  const auto ask_for_things = [](auto word) { return is_among(word, {"what", "which", "who"}); };
  return a == b || (ask_for_things(a) && ask_for_things(b));
}

WordList without_articles(WordList words) {
  std::erase_if(words, [](const auto& x) { return is_among(x, {"the", "a", "an", "please"}); });
  return words;
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

/// "Do not", "you must not"; but not "why do you not", "don't you".
bool says_not_to(const WordList& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_not = is_among(words[i], {"not", "n't", "never", "dont"});
    const bool is_asked = is_among(words.front(), {"why", "what", "how"}) ||
                          (i + 1 < words.size() && is_among(words[i + 1], {"you", "we", "i"}));
    const bool is_denied = i == 0 || words[i] == "dont" ||
                           is_among(words[i - 1], {"do", "must", "should", "may", "shall", ","});
    if (is_not && is_denied && !is_asked)
      return true;
  }
  return false;
}

bool may_precede_name(std::string_view word) {
  return is_among(word, {"the", "a", "an", "this", "that", "these", "those", "my", "your", "some",
                         "any", "no", "another", "which", "of"});
}

} // namespace

class LikelyMeaning::Search {
public:
  Search(Parser& parser, const WordList& words)
    : parser_(parser), said_(words), words_(without_asides(words, parser.lexicon(), true)) {
    const auto begin = std::ranges::find_if(words_, [](const auto& x) {
      return x != "," && !is_among(x, {"and", "so", "but", "then"});
    });
    words_.erase(words_.begin(), begin);
    asks_ = !words_.empty() && may_begin_question(words_.front());
  }

  /// \param is_proposed whether the speaker may be asked
  std::optional<PackedLogicalForm> run(bool is_proposed) {
    if (words_.empty() || words_.size() > most_words || may_name_other_thing())
      return std::nullopt;
    if (!is_proposed && ends_with_other_clause(pieces()))
      return std::nullopt;
    if (!matches_)
      matches_ = matches(pieces());
    auto found = *matches_;
    // "Can you put the ball on the left" does not ask whether it is there.
    if (!asks_ && has_handling_verb())
      std::erase_if(found, [](const auto& x) { return may_begin_question(x.meaning.front()); });
    std::erase_if(found, [&](const auto& x) { return cannot_mean(x); });
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto& meaning = found[i].meaning;
      const bool is_question = may_begin_question(meaning.front());
      auto certainty = is_doubtful(found[i]) ? std::min(found[i].certainty, least_to_answer - 0.01)
                                             : found[i].certainty;
      if (!is_question && certainty >= least_to_do_the_same && says_the_same(meaning))
        certainty = std::max(certainty, least_to_do);
      if (has_unknown_verb() && !says_where_to(meaning))
        certainty = std::min(certainty, least_to_do - 0.01);
      if (certainty < (is_proposed ? least_to_ask : least_to_do))
        break;
      auto form = parser_.parse_whole(meaning);
      if (!form || (asks_ && !is_question && (certainty < least_to_do || asks_whether_so())))
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
      if (written(meaning) == remark)
        form->mention = mention();
      return form;
    }
    return std::nullopt;
  }

  bool is_remark(bool is_alone) {
    if (words_.size() < shortest_remark || words_.size() > most_words || !may_be_remark(is_alone))
      return false;
    const auto least = has_handling_verb() ? least_to_do : least_for_remark;
    const auto is_like_remarks = [&](const Pieces& said) {
      return lexicon().examples().certainty_of(remark, said) >= least;
    };
    return is_like_remarks(pieces()) || is_like_remarks(with_words_for_all(pieces()));
  }

  bool is_wish() {
    const bool wishes = std::ranges::any_of(words_, [](const auto& x) {
      return is_among(x, {"want", "need", "prefer", "wish", "like", "love", "should", "must"});
    });
    return wishes && is_among(words_.front(), {"i", "we", "you"}) &&
           std::ranges::any_of(pieces(), [](const auto& x) {
             return x.names_things && !is_general_name(x.words.back());
           });
  }

  std::optional<WordList> name() {
    const ExamplePiece* name = nullptr;
    for (const auto& piece : pieces()) {
      if (!piece.names_things || stands_for_things(piece.words.front()) ||
          is_general_name(piece.words.back()))
        continue;
      if (name != nullptr)
        return std::nullopt;
      name = &piece;
    }
    return name == nullptr ? std::nullopt : std::optional{name->words};
  }

  std::optional<LogicalForm> mention() {
    const auto named = name();
    const auto words = named ? with_place(*named) : only_phrase();
    const auto form = words.empty() ? std::nullopt : parser_.parse_whole(words);
    if (!form)
      return std::nullopt;
    auto said = unpack(*form, form->readings.front().id);
    return said.size() == 1 ? std::optional{std::move(said.front())} : std::nullopt;
  }

private:
  const Lexicon& lexicon() const { return parser_.lexicon(); }

  /// "The ball at the back" of a name, "the ball": as much as is said of the thing.
  WordList with_place(const WordList& name) {
    const auto begin = std::ranges::search(words_, name).begin();
    const auto longest = phrase_at(begin);
    return longest.size() > name.size() ? longest : name;
  }

  /// The only phrase with "the" that names a thing; empty if there are several.
  WordList only_phrase() {
    WordList result;
    for (auto at = words_.begin(); at != words_.end(); ++at) {
      auto phrase = *at == "the" ? phrase_at(at) : WordList{};
      if (phrase.empty())
        continue;
      if (!result.empty())
        return {};
      at += std::ssize(phrase) - 1;
      result = std::move(phrase);
    }
    return result;
  }

  /// The longest that begins there and names a thing; empty if none does.
  WordList phrase_at(WordList::const_iterator begin) {
    constexpr std::ptrdiff_t most_words = 10;
    for (auto end = begin + std::min(most_words, words_.end() - begin); end != begin; --end) {
      WordList phrase(begin, end);
      if (const auto form = parser_.parse_whole(phrase); form && thing_said(*form))
        return phrase;
    }
    return {};
  }

  const Pieces& pieces() {
    if (!pieces_)
      pieces_ = example_pieces(parser_, words_);
    return *pieces_;
  }

  /// What is little like anything, or says another side or question, is never done.
  bool is_doubtful(const Examples::Match& match) {
    const auto& meaning = match.meaning;
    const bool is_question = may_begin_question(meaning.front());
    const bool says_other_side =
      !side_in(pieces()).empty() &&
      std::ranges::none_of(meaning, [](const auto& x) { return !side_of(x).empty(); });
    const bool asks_for_other = is_question && asks_ && match.certainty < least_to_answer_other &&
                                !begin_same_question(words_.front(), meaning.front());
    return says_other_side || asks_for_other ||
           match.likeness < (is_question && !asks_ ? least_likeness_of_question : least_likeness);
  }

  /// Says by what things are compared, or measured, or that they were moved, and the meaning does
  /// not.
  bool says_more_than(const WordList& meaning) const {
    using Matter = std::vector<std::string_view>;
    static const std::array<Matter, 5> matters{
      Matter{"height", "tall", "taller", "tallest", "heights"},
      Matter{"width", "wide", "wider", "widest", "thickness"},
      Matter{"colour", "color", "colours", "colors", "coloured"},
      Matter{"shape", "shapes", "shaped"}, Matter{"cm", "degrees"}};
    static const Matter moving{"moved", "touched", "placed", "picked", "handled", "shifted"};
    const auto says = [](const WordList& words, const Matter& matter) {
      return std::ranges::any_of(
        words, [&](const auto& x) { return std::ranges::find(matter, x) != matter.end(); });
    };
    const auto is_only_said = [&](const Matter& matter) {
      return says(words_, matter) && !says(meaning, matter);
    };
    const bool is_about_moves = is_only_said(moving) && may_begin_question(meaning.front()) &&
                                std::ranges::none_of(meaning, [](const auto& x) {
                                  return is_among(x, {"move", "do", "did", "was", "were"});
                                });
    return is_about_moves || std::ranges::any_of(matters, is_only_said);
  }

  /// "Move the cube nearer to the ball" is not about the ball, however like that the examples are;
  /// "on the cube goes the ball" is.
  bool exchanges_names(const WordList& meaning) {
    std::vector<WordList> names;
    std::string before;
    for (const auto& piece : pieces())
      if (piece.names_things)
        names.push_back(piece.words);
      else if (names.empty())
        for (const auto& word : piece.words)
          if (!may_precede_name(word))
            before = word;
    const bool begins_with_verb = is_handling_verb(before, lexicon()) ||
                                  is_handling_verb(stem_of(before), lexicon()) ||
                                  is_among(before, {"brought", "took", "gave", "got", "slid"});
    if (names.size() != 2 || names[0] == names[1] || !begins_with_verb)
      return false;
    const auto first = std::ranges::search(meaning, names[0]);
    const auto second = std::ranges::search(meaning, names[1]);
    return !first.empty() && !second.empty() && second.begin() < first.begin();
  }

  /// What makes a request of it, or another matter.
  bool cannot_mean(const Examples::Match& match) {
    const auto& meaning = match.meaning;
    if (written(meaning) != remark && written(meaning) != impossible && says_more_than(meaning))
      return true;
    if (may_begin_question(meaning.front()))
      return false;
    if (exchanges_names(meaning))
      return true;
    if (written(meaning) == remark)
      return !may_be_remark(false) || has_handling_verb();
    // Nothing that it can do may be denied. What is not known is named: "I do not know how to
    // recite".
    if (written(meaning) == impossible)
      return match.certainty < least_for_impossible || !lexicon().knows(words_.front());
    // "Don't put it down yet" is no "put it down".
    if (says_not_to(words_) && !says_not_to(meaning))
      return true;
    const auto says_push = [](const WordList& words) {
      return std::ranges::find(words, "push") != words.end();
    };
    return match.likeness < least_likeness_to_ask || (says_push(words_) && !says_push(meaning));
  }

  /// Asks for nothing, as far as single words tell.
  bool may_be_remark(bool is_alone) {
    if (asks_ || words_.front() == "please" || begins_yes_no_question(words_.front()) ||
        is_handling_verb(words_.front(), lexicon()) || is_wish())
      return false;
    for (std::size_t i = 1; i < words_.size(); ++i)
      if (words_[i - 1] == "," && may_begin_question(words_[i]))
        return false;
    return is_alone || std::ranges::all_of(words_, [&](const auto& x) {
             return x == "," || lexicon().knows(x) || lexicon().is_in_a_class(x) ||
                    lexicon().examples().has_word(x) || is_english_word(x);
           });
  }

  /// "Is the left side clear?" asks for nothing else; "is there a chance of that?" may.
  bool asks_whether_so() const {
    const bool may_ask_for_more = std::ranges::any_of(words_, [](const auto& x) {
      return is_among(x, {"you", "chance", "way", "possible", "possibility", "ok", "okay", "time"});
    });
    return is_among(words_[0], {"is", "are", "was", "were", "did", "does"}) && !may_ask_for_more;
  }

  bool has_handling_verb() const {
    return words_.front() == "please" || std::ranges::any_of(words_, [&](const auto& x) {
             return is_handling_verb(x, lexicon());
           });
  }

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
  /// verbs: "may I borrow the ball", nor what examples say without an article.
  bool may_name_other_thing() const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const auto& word = words_[i];
      const bool may_be_verb = i > 0 && may_precede_verb(words_[i - 1]);
      const bool is_example_word =
        (i == 0 || !may_precede_name(words_[i - 1])) && lexicon().examples().has_word(word);
      if (word != "," && !may_be_verb && !is_example_word && !lexicon().knows(word) &&
          !lexicon().is_in_a_class(word) && !word.ends_with("ly") && !word.ends_with("ing"))
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
      for (auto& match : lexicon().examples().likeliest(said, most_meanings)) {
        const auto same = std::ranges::find(result, match.meaning, &Examples::Match::meaning);
        if (same == result.end())
          result.push_back(std::move(match));
        else if (same->certainty < match.certainty)
          *same = std::move(match);
      }
    std::ranges::stable_sort(result, std::ranges::greater{}, &Examples::Match::certainty);
    return result;
  }

  Parser& parser_;
  const WordList& said_;
  /// Without asides.
  WordList words_;
  /// Whether it begins like a question.
  bool asks_ = false;
  std::optional<Pieces> pieces_;
  std::optional<std::vector<Examples::Match>> matches_;
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

bool LikelyMeaning::is_remark(bool is_alone) {
  return search_->is_remark(is_alone);
}

bool LikelyMeaning::is_wish() {
  return search_->is_wish();
}

std::optional<std::vector<std::string>> LikelyMeaning::name() {
  return search_->name();
}

std::optional<LogicalForm> LikelyMeaning::mention() {
  return search_->mention();
}

std::vector<std::string> with_thing_of(Parser& parser, std::vector<std::string> words,
                                       const std::vector<std::string>& other) {
  const auto pronoun = std::ranges::find_if(words, [](const auto& x) {
    return is_among(x, {"it", "them"});
  });
  bool is_named_before = false;
  for (auto x = words.begin(); x != pronoun; ++x) {
    const auto next = std::next(x);
    // "What is to the left of it" names nothing.
    const bool is_side = *x == "the" && next != pronoun &&
                         is_among(*next, {"left", "right", "front", "back", "side", "middle"});
    is_named_before = is_named_before || (*x == "the" && !is_side) ||
                      name_of_things(parser, {*x}) || is_among(*x, {"everything", "one", "ones"});
  }
  if (pronoun == words.end() || is_named_before)
    return words;
  if (const auto name = LikelyMeaning{parser, other}.name())
    words.insert(words.erase(pronoun), name->begin(), name->end());
  return words;
}

} // namespace castor::communication
