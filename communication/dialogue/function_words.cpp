#include "castor/communication/dialogue/function_words.hpp"

#include "castor/communication/dialogue/clause_parts.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

/// In words. Longer utterances are seldom telegraphic.
constexpr std::size_t longest_sentence = 16;

/// How often an utterance is parsed with other function words.
constexpr std::size_t most_parses = 60;

/// Ways to put articles into an utterance that are tried.
constexpr std::size_t most_completions = 12;

/// Those of them that are tried with other function words too.
constexpr std::size_t most_rearranged = 4;

template <std::size_t N>
bool is_any(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::ranges::find(words, word) != words.end();
}

constexpr std::array<std::string_view, 6> question_words{"what", "which", "where",
                                                         "who",  "how",   "whose"};
constexpr std::array<std::string_view, 20> finite_verbs{
  "is", "are",  "'s",  "'re", "am",    "was",  "were",  "has", "have",  "had",
  "do", "does", "did", "can", "could", "will", "would", "may", "might", "be"};

/// Pairs of verbs for one thing and for several.
constexpr std::array<std::array<std::string_view, 2>, 5> verb_numbers{
  {{"is", "are"}, {"has", "have"}, {"does", "do"}, {"lies", "lie"}, {"touches", "touch"}}};

/// Stands for an article where a noun may be meant in its plural.
constexpr std::string_view plural_mark = "+s";

/// "On left", "in middle".
constexpr std::array<std::string_view, 8> sides{"left",   "right", "middle", "centre",
                                                "center", "back",  "edge",   "far"};
constexpr std::array<std::string_view, 5> before_sides{"on", "to", "in", "at", "from"};

/// "Most of things", "besides cubes".
constexpr std::array<std::string_view, 5> before_the_named{"of", "besides", "from", "except",
                                                           "for"};

/// "Is there cube", "you see cube", "it has corner": something that was not spoken of.
constexpr std::array<std::string_view, 14> introducing{
  "not",  "n't",   "there",  "see",  "have",    "has",      "find",
  "spot", "exist", "exists", "with", "contain", "contains", "show"};

/// What a word may be in a noun phrase.
struct WordUse {
  bool is_singular = false;
  bool is_plural = false;
  /// Of a number, or an amount.
  bool is_count = false;
  /// Belongs to a thing: "colour", "side".
  bool is_part = false;
  /// What things are made of.
  bool is_material = false;
  bool is_modifier = false;
  bool is_determiner = false;
  /// Of several things only: "these", "two".
  bool is_plural_determiner = false;
  bool is_pronoun = false;

  bool is_noun() const { return is_singular || is_plural; }
};

WordUse use_of(const std::string& word, const Lexicon& lexicon) {
  WordUse result;
  bool is_singular_determiner = false;
  for (const auto entry : lexicon.find(word)) {
    const auto& category = lexicon.categories()[lexicon.entry(entry).category];
    const auto text = to_string(category, lexicon.symbols());
    const auto& arguments = category.arguments;
    if (arguments.empty()) {
      result.is_singular = result.is_singular || text.starts_with("n[sg");
      result.is_plural = result.is_plural || text.starts_with("n[pl");
      result.is_part = result.is_part || text.ends_with("part]");
      result.is_material = result.is_material || text == "mat";
      result.is_count = result.is_count || text.ends_with("count]");
      result.is_pronoun = result.is_pronoun || text == "np" || text.starts_with("np[");
      continue;
    }
    const auto& last = arguments.back();
    if (last.direction != SlashDirection::forward || !last.category.arguments.empty() ||
        lexicon.symbols().text(last.category.result.name) != "n")
      continue;
    const auto& name = lexicon.symbols().text(category.result.name);
    const bool is_of_noun = name == "n";
    const bool is_phrase = name == "np" && std::ranges::all_of(arguments, [](auto& x) {
                             return x.direction == SlashDirection::forward;
                           });
    if (!is_of_noun && !is_phrase && !is_any(word, question_words))
      continue;
    const auto number = last.category.result.features.front();
    const bool is_of_several =
      number > 0 && lexicon.symbols().text(static_cast<Symbol>(number)) == "pl";
    result.is_modifier = result.is_modifier || (is_of_noun && arguments.size() == 1 &&
                                                last.mode != SlashMode::application);
    result.is_determiner = result.is_determiner || !is_of_noun;
    result.is_plural_determiner = result.is_plural_determiner || (!is_of_noun && is_of_several);
    is_singular_determiner = is_singular_determiner || (!is_of_noun && !is_of_several);
  }
  result.is_plural_determiner = result.is_plural_determiner && !is_singular_determiner;
  return result;
}

/// "Balls" for "ball"; empty if the lexicon has no such word.
std::string plural_of(const std::string& noun, const Lexicon& lexicon) {
  for (const auto number : lexicon.find(noun)) {
    const auto& singular = lexicon.entry(number);
    if (!to_string(lexicon.categories()[singular.category], lexicon.symbols()).starts_with("n[sg"))
      continue;
    const auto plural = std::ranges::find_if(lexicon.entries(), [&](const LexicalEntry& x) {
      return x.family == singular.family && x.predicate == singular.predicate &&
             x.phrase.front() == noun.front() &&
             to_string(lexicon.categories()[x.category], lexicon.symbols()).starts_with("n[pl");
    });
    if (plural != lexicon.entries().end())
      return plural->phrase;
  }
  return {};
}

/// A place where an article may be missing, and the articles, the likeliest first; empty for none.
struct Gap {
  std::size_t position = 0;
  /// Where the noun is.
  std::size_t noun = 0;
  std::vector<std::string> articles;
};

/// Finds the noun phrases of an utterance.
class NounPhrases {
public:
  NounPhrases(WordList words, const Lexicon& lexicon)
    : words_(std::move(words)), lexicon_(lexicon) {
    for (auto& word : words_)
      uses_.push_back(use_of(word, lexicon));
    for (std::size_t i = 0; i < words_.size(); ++i)
      if (const auto noun = noun_from(i); noun < words_.size()) {
        if (needs_plural(i))
          if (auto plural = plural_of(words_[noun], lexicon); !plural.empty()) {
            words_[noun] = std::move(plural);
            uses_[noun] = {.is_plural = true};
          }
        add_gap(i, noun);
        i = noun;
      } else if (is_bare_side(i) || is_bare_same(i) || is_bare_colour(i))
        gaps_.push_back({i, i, {"the"}});
  }

  /// With nouns in their number.
  const WordList& words() const { return words_; }
  const std::vector<Gap>& gaps() const { return gaps_; }

private:
  /// The first noun after words that say what a thing is like; else the number of words.
  std::size_t noun_from(std::size_t i) const {
    const auto begin = i;
    auto noun = words_.size();
    for (bool goes_on = true; goes_on && i < words_.size(); ++i) {
      // "The yellow one", but not "one ball".
      if (uses_[i].is_noun() && (!uses_[i].is_determiner || i > begin))
        noun = i;
      goes_on = uses_[i].is_modifier && !(noun == i && !is_noun_at(i + 1));
    }
    return noun;
  }

  bool is_noun_at(std::size_t i) const {
    while (i + 1 < words_.size() && uses_[i].is_modifier && !uses_[i].is_noun())
      ++i;
    return i < words_.size() && uses_[i].is_noun();
  }

  bool is_bare_side(std::size_t i) const {
    return i > 0 && is_any(words_[i], sides) && is_any(words_[i - 1], before_sides);
  }

  /// "Move yellow away from blue": the yellow one.
  bool is_bare_colour(std::size_t i) const {
    const auto is_colour = [&](auto entry) {
      const auto& category = lexicon_.categories()[lexicon_.entry(entry).category];
      return to_string(category, lexicon_.symbols()) == "col";
    };
    // "The cube is yellow", "cube yellow".
    const bool is_predicate =
      i == 0 || is_any(words_[i - 1], finite_verbs) || uses_[i - 1].is_noun();
    return !is_predicate && !uses_[i - 1].is_determiner &&
           std::ranges::any_of(lexicon_.find(words_[i]), is_colour);
  }

  bool is_bare_same(std::size_t i) const {
    return words_[i] == "same" && (i == 0 || !uses_[i - 1].is_determiner);
  }

  /// Whether the word belongs to a phrase with words before it: "in front of".
  bool is_in_phrase(std::size_t i) const {
    for (std::size_t begin = i > 2 ? i - 2 : 0; begin < i; ++begin) {
      auto phrase = words_[begin];
      for (auto end = begin + 1; end < words_.size() && end < i + 3; ++end) {
        phrase += ' ' + words_[end];
        if (end > i && !lexicon_.find(phrase).empty())
          return true;
      }
    }
    return false;
  }

  /// "More balls than cubes", "as many balls as cubes".
  bool are_numbers_compared() const {
    return std::ranges::any_of(
      words_, [](auto& word) { return word == "more" || word == "fewer" || word == "many"; });
  }

  bool is_after_determiner(std::size_t i) const {
    return i > 0 && uses_[i - 1].is_determiner && !uses_[i - 1].is_modifier;
  }

  bool needs_plural(std::size_t i) const {
    if (i == 0)
      return false;
    const bool goes_on = words_[i - 1] == "and" || words_[i - 1] == "or";
    return uses_[i - 1].is_plural_determiner ||
           (i > 1 && words_[i - 1] == "of" && uses_[i - 2].is_count) ||
           (i > 1 && goes_on && uses_[i - 2].is_plural);
  }

  void add_gap(std::size_t begin, std::size_t noun) {
    // "..., robot": who is spoken to.
    const bool is_called = words_[noun] == "robot" ||
                           (begin > 0 && words_[begin - 1] == "," && noun + 1 == words_.size());
    if (is_called)
      return;
    if (auto articles = articles_of(begin, noun); !articles.empty())
      gaps_.push_back({begin, noun, std::move(articles)});
  }

  /// What may be missing before a noun phrase; empty if nothing.
  std::vector<std::string> articles_of(std::size_t begin, std::size_t noun) const {
    const auto before = begin > 0 ? std::string_view{words_[begin - 1]} : std::string_view{};
    const auto use_before = begin > 0 ? uses_[begin - 1] : WordUse{};
    const bool is_after_count = begin > 1 && uses_[begin - 2].is_count;
    if (uses_[noun].is_plural && is_any(before, before_the_named) && !is_after_count)
      return {"the", ""};
    if (!uses_[noun].is_singular)
      return {};
    // "It is true that cube is red", "the cube 's colour", "made of wood".
    if ((before == "that" && begin > 1) || (before == "'s" && uses_[noun].is_part) ||
        (before == "of" && uses_[noun].is_material))
      return {"", "the"};
    if (is_after_determiner(begin) || (begin > 0 && begin == noun && is_in_phrase(begin)))
      return {};
    const std::string plural{plural_mark};
    if ((before == "than" || before == "as") && are_numbers_compared())
      return {plural, "the"};
    if ((before == "are" || before == "not" || before == "n't") &&
        std::ranges::find(words_, "are") != words_.end())
      return {plural, "the"};
    if (use_before.is_noun())
      return use_before.is_part ? std::vector<std::string>{"of the", "", "the"}
                                : std::vector<std::string>{"", "a", "the"};
    // "The cube is toy", but not "what is colour".
    const bool is_predicate = begin > 1 && words_.front() != "which" &&
                              (before == "is" || before == "'s") &&
                              !is_any(words_[begin - 2], question_words);
    if (is_predicate || is_any(before, introducing) || use_before.is_pronoun)
      return {"a", "the"};
    return {"the"};
  }

  WordList words_;
  const Lexicon& lexicon_;
  std::vector<WordUse> uses_;
  std::vector<Gap> gaps_;
};

/// The utterance with articles, the likeliest first.
std::vector<WordList> with_articles(const NounPhrases& phrases, const Lexicon& lexicon) {
  const auto& gaps = phrases.gaps();
  std::vector<std::vector<std::size_t>> choices{{}};
  for (auto& gap : gaps) {
    std::vector<std::vector<std::size_t>> longer;
    for (auto& choice : choices)
      for (std::size_t i = 0; i < gap.articles.size(); ++i) {
        longer.push_back(choice);
        longer.back().push_back(i);
      }
    choices = std::move(longer);
    if (choices.size() > most_completions)
      choices.resize(most_completions);
  }
  std::ranges::stable_sort(
    choices, {}, [](auto& x) { return std::accumulate(x.begin(), x.end(), std::size_t{0}); });
  std::vector<WordList> result;
  for (auto& choice : choices) {
    auto words = phrases.words();
    for (auto i = choice.size(); i-- > 0;) {
      const auto& article = gaps[i].articles[choice[i]];
      const auto position = gaps[i].position;
      if (article == plural_mark) {
        if (auto plural = plural_of(words[gaps[i].noun], lexicon); !plural.empty())
          words[gaps[i].noun] = std::move(plural);
      } else if (const auto articles = words_of(article); !articles.empty())
        words.insert(words.begin() + static_cast<std::ptrdiff_t>(position), articles.begin(),
                     articles.end());
    }
    result.push_back(std::move(words));
  }
  return result;
}

/// "How many things is red": the utterance with one of its verbs in the other number.
std::vector<WordList> with_other_number(const WordList& words) {
  std::vector<WordList> result;
  for (std::size_t i = 0; i < words.size(); ++i)
    for (auto& [singular, plural] : verb_numbers)
      if (words[i] == singular || words[i] == plural) {
        result.push_back(words);
        result.back()[i] = words[i] == singular ? plural : singular;
      }
  return result;
}

WordList inserted(WordList words, std::size_t position, std::initializer_list<std::string> what) {
  words.insert(words.begin() + static_cast<std::ptrdiff_t>(position), what);
  return words;
}

/// The other ways to say an utterance with the same words about things.
class Rearrangements {
public:
  explicit Rearrangements(const WordList& words) {
    add_all(words);
    if (auto turned = with_question_word_first(words); !turned.empty()) {
      result_.push_back(turned);
      add_all(turned);
    }
  }

  const std::vector<WordList>& result() const { return result_; }

private:
  void add_all(const WordList& words) {
    if (is_any(words.front(), question_words))
      add_questions(words);
    else
      add_copulas(words, 0, std::min<std::size_t>(words.size(), 2));
    add_auxiliary(words);
    add_without_surplus(words);
    add_subject_first(words);
  }

  /// "Where the ball is", "where ball".
  void add_questions(const WordList& words) {
    result_.push_back(inserted(words, 0, {"tell", "me"}));
    // "Which one larger" asks for one.
    const bool may_go_on = words.front() == "which" || words.front() == "what";
    add_copulas(words, may_go_on ? 2 : 1, std::min<std::size_t>(words.size(), 7));
    if (may_go_on)
      add_copulas(words, 1, 2);
    if (words.front() == "which" && words.size() > 1 && is_any(words[1], finite_verbs)) {
      auto other = words;
      other.front() = "what";
      result_.push_back(std::move(other));
    }
  }

  void add_copulas(const WordList& words, std::size_t begin, std::size_t end) {
    if (std::ranges::any_of(words, [](auto& word) { return is_any(word, finite_verbs); }))
      return;
    for (auto i = begin; i < end; ++i)
      if (words[i] != "and" && words[i] != "or")
        for (const auto* verb : {"is", "are"})
          result_.push_back(inserted(words, i, {verb}));
  }

  /// "You see a ball", "how many balls you see".
  void add_auxiliary(const WordList& words) {
    for (std::size_t i = 0; i + 1 < words.size(); ++i)
      if (words[i] == "you" && (i == 0 || !is_any(words[i - 1], finite_verbs)))
        result_.push_back(inserted(words, i, {"do"}));
  }

  /// "Does the ball is red", "do you can see a ball".
  void add_without_surplus(WordList words) {
    if (words.front() != "do" && words.front() != "does")
      return;
    const auto verb = std::find_if(words.begin() + 1, words.end(), [](auto& word) {
      return word == "is" || word == "are" || word == "can" || word == "has";
    });
    if (verb == words.end())
      return;
    if (*verb == "has") {
      *verb = "have";
    } else {
      words.front() = *verb;
      words.erase(verb);
    }
    result_.push_back(std::move(words));
  }

  /// "Is red the ball".
  void add_subject_first(WordList words) {
    if (words.front() != "is" && words.front() != "are")
      return;
    const auto subject = std::find(words.begin() + 1, words.end(), "the");
    if (subject == words.end() || subject != words.begin() + 2)
      return;
    std::rotate(words.begin() + 1, subject, words.end());
    result_.push_back(std::move(words));
  }

  /// "The ball what colour", "red things: how many"; empty if it is not like that.
  static WordList with_question_word_first(WordList words) {
    const auto asked = std::find_if(words.begin() + 1, words.end(),
                                    [](auto& word) { return is_any(word, question_words); });
    const auto pause = std::find(words.begin(), words.end(), ",");
    if (asked == words.end() || is_any(words.front(), question_words) ||
        (pause < asked && pause + 1 != asked))
      return {};
    std::rotate(words.begin(), asked, words.end());
    if (words.back() == ",")
      words.pop_back();
    return words;
  }

  std::vector<WordList> result_;
};

std::string text_of(const WordList& words) {
  std::string result;
  for (auto& word : words)
    result += (result.empty() || word.front() == '\'' || word == "," ? "" : " ") + word;
  return result;
}

bool says_something(const PackedLogicalForm& form) {
  const auto said = unpack(form, form.readings.front().id).front();
  const auto type = dialogue_move_type(said);
  return !is_elliptical(said) &&
         (type == DialogueMoveType::question_w || type == DialogueMoveType::question_yn ||
          type == DialogueMoveType::assertion || type == DialogueMoveType::action_directive);
}

/// Parses as often as is allowed for one utterance.
class Attempts {
public:
  explicit Attempts(Parser& parser) : parser_(parser) {}

  std::optional<PackedLogicalForm> parse(const WordList& words) {
    if (words.empty() || count_ == most_parses)
      return std::nullopt;
    ++count_;
    auto form = parser_.parse_whole(words);
    return form && says_something(*form) ? std::move(form) : std::nullopt;
  }

private:
  Parser& parser_;
  std::size_t count_ = 0;
};

} // namespace

std::optional<PackedLogicalForm> parsed_with_function_words(Parser& parser, const WordList& words) {
  const auto& lexicon = parser.lexicon();
  const bool is_known =
    std::ranges::all_of(words, [&](auto& word) { return word == "," || lexicon.knows(word); });
  if (words.size() < 2 || words.size() > longest_sentence || !is_known)
    return std::nullopt;
  auto completions = with_articles(NounPhrases{words, lexicon}, lexicon);
  Attempts attempts{parser};
  for (auto& completion : completions) {
    if (completion != words)
      if (auto form = attempts.parse(completion))
        return form;
    for (auto& other : with_other_number(completion))
      if (auto form = attempts.parse(other))
        return form;
  }
  if (completions.size() > most_rearranged)
    completions.resize(most_rearranged);
  for (auto& completion : completions) {
    const Rearrangements others{completion};
    for (auto& other : others.result())
      if (auto form = attempts.parse(other)) {
        form->corrections.push_back({text_of(words), text_of(other)});
        return form;
      }
  }
  return std::nullopt;
}

} // namespace castor::communication
