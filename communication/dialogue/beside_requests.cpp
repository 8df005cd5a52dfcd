#include "castor/communication/dialogue/beside_requests.hpp"

#include "castor/communication/dialogue/aside_clauses.hpp"
#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/likely_meaning.hpp"
#include "castor/communication/dialogue/thing_names.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

/// In words, of what begins a reason.
constexpr std::size_t longest_reason_word = 4;

/// In words, of what begins a remark.
constexpr std::size_t longest_remark_word = 7;

std::string text_of(const WordList& words) {
  std::string result;
  for (const auto& word : words)
    if (word != ",")
      result += (result.empty() ? "" : " ") + word;
  return result;
}

WordList piece(const WordList& words, std::size_t begin, std::size_t end) {
  auto result = words_between(words, begin, end);
  while (!result.empty() && result.back() == ",")
    result.pop_back();
  return result;
}

bool begins_reason(const WordList& words, std::size_t at, const Lexicon& lexicon) {
  for (auto end = std::min(at + longest_reason_word, words.size()); end > at; --end)
    if (lexicon.is_in(WordClass::reason, text_of(piece(words, at, end))))
      return true;
  return false;
}

/// \param is_after whether something else is said before it
bool is_clear_request(const LogicalForm& said, bool is_after) {
  const auto& root = *find_nominal(said, said.root);
  // "Could you give me the ball?"
  const bool is_asked =
    root.sort == "action" && feature(root, "Mood") == "int" && !feature(root, "Modality").empty();
  if (feature(root, "Mood") != "imp" && !is_asked)
    return false;
  return !is_after || std::ranges::none_of(part_of(said, said.root).nominals,
                                           [](const Nominal& x) { return is_pronoun(x); });
}

bool is_clear_request(const PackedLogicalForm& form, bool is_after) {
  return std::ranges::any_of(form.readings, [&](const Reading& reading) {
    const auto said = unpack(form, reading.id);
    return said.size() == 1 && is_clear_request(said.front(), is_after);
  });
}

std::optional<PackedLogicalForm> clear_request(Parser& parser, WordList words,
                                               const WordList& left_out, bool is_after) {
  if (words.empty() || left_out.empty())
    return std::nullopt;
  if (is_after)
    words = with_thing_of(parser, std::move(words), left_out);
  auto form = parser.parse_whole(words);
  if (!form)
    form = LikelyMeaning{parser, words}.likely();
  if (!form || !is_clear_request(*form, is_after))
    return std::nullopt;
  form->corrections.push_back({text_of(left_out), {}});
  return form;
}

std::optional<PackedLogicalForm> without_reason(Parser& parser, const WordList& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!begins_reason(words, i, parser.lexicon()))
      continue;
    if (i > 0)
      return clear_request(parser, piece(words, 0, i), piece(words, i, words.size()), false);
    for (std::size_t end = 1; end < words.size(); ++end)
      if (words[end] == ",")
        if (auto form = clear_request(parser, piece(words, end + 1, words.size()),
                                      piece(words, 0, end), true))
          return form;
  }
  return std::nullopt;
}

/// "If", "unless": they say when a request is meant, or that another one is.
bool decides(const std::string& word) {
  return is_among(
    word, {"if", "unless", "until", "except", "only", "when", "while", "rather", "opposite"});
}

/// The parts of an utterance between pauses.
std::vector<WordList> pieces_of(const WordList& words) {
  std::vector<WordList> result{{}};
  for (const auto& word : words)
    if (word != ",")
      result.back().push_back(word);
    else if (!result.back().empty())
      result.emplace_back();
  if (result.back().empty())
    result.pop_back();
  return result;
}

bool is_remark(const WordList& words, const Lexicon& lexicon) {
  // "And if that does not work" begins with a word that decides.
  for (auto end = std::min(longest_remark_word, words.size()); end > 0; --end)
    if (lexicon.is_in(WordClass::comment, text_of(piece(words, 0, end))))
      return std::none_of(words.begin() + static_cast<std::ptrdiff_t>(end), words.end(), decides);
  return false;
}

/// "I need to put my bag there", "he wants it": what people say of themselves, if they do not wish
/// something for a thing by it: "I want it on the right".
bool is_about_people(const WordList& words, Parser& parser) {
  if (words.size() < 3 || !is_among(words[0], {"i", "we", "he", "she", "they", "my", "our", "his",
                                               "her", "someone", "somebody", "something"}))
    return false;
  const auto is_wish = [&](std::size_t i) {
    return is_among(words[i], {"want", "need", "like", "prefer", "love"}) && i + 1 < words.size() &&
           is_among(words[i + 1], {"it", "them", "that", "this", "these", "those", "the", "both",
                                   "all", "everything", "one"});
  };
  const bool is_own_wish = is_among(words[0], {"i", "we"}) && (is_wish(1) || is_wish(2));
  // "My aunt admired it there" may be about the thing: it is better to ask.
  const bool is_own_plan = is_among(words[1], {"want", "need", "have"}) && words[2] == "to";
  const bool may_be_about_thing = !is_own_plan && std::ranges::any_of(words, [](const auto& x) {
    return is_among(x, {"it", "them", "this", "that", "one"});
  });
  if (is_own_wish || may_be_about_thing ||
      !is_aside(parser.lexicon(), words, Beside::request, false))
    return false;
  // "I need some space" asks for something.
  const auto form = parser.parse_whole(words);
  return !form || !is_clear_request(*form, false);
}

/// "That'll be my backdrop": what it is for.
bool says_purpose(const WordList& words) {
  constexpr std::size_t longest = 8;
  if (words.size() < 4 || words.size() > longest || !is_among(words[0], {"that", "this", "it"}))
    return false;
  const bool is_future = is_among(words[1], {"'ll", "will"}) && words[2] == "be";
  const auto& next = words[is_future ? 3 : 2];
  return (is_future || is_among(words[1], {"is", "'s"})) && is_among(next, {"my", "our", "for"}) &&
         std::ranges::none_of(words, decides);
}

/// "To kick us off this morning, ..."
bool is_purpose_before(const WordList& words, Parser& parser) {
  const auto begin = is_among(words[0], {"and", "so", "just", "now"}) ? std::size_t{1} : 0;
  if (words.size() < begin + 2 || words[begin] != "to" ||
      is_among(words[begin + 1], {"the", "my", "your", "left", "right", "me", "its", "his", "her"}))
    return false;
  return std::ranges::none_of(words, [&](const auto& x) {
    return decides(x) || is_handling_verb(x, parser.lexicon()) || names_things(parser, {"the", x});
  });
}

/// "Like a little centrepiece": of what is not known, or no arrangement.
bool is_comparison(const WordList& words, const Lexicon& lexicon) {
  if (words.size() < 3 || !is_among(words[0], {"like", "as"}) ||
      std::ranges::any_of(words, decides))
    return false;
  const bool is_arrangement =
    is_among(words.back(), {"tower", "stack", "pile", "row", "line", "circle", "ring", "wall",
                            "square", "triangle", "pyramid", "column", "queue"});
  return is_among(words[1], {"a", "an"})
           ? !is_arrangement && words[0] == "like"
           : is_among(words[1], {"the", "my", "our"}) && !lexicon.knows(words.back());
}

/// "And mind the cylinder".
bool is_caution(const WordList& words) {
  constexpr std::size_t longest = 6;
  const auto begin = is_among(words[0], {"and", "but", "so"}) ? std::size_t{1} : 0;
  return words.size() > begin + 1 && words.size() <= longest &&
         (words[begin] == "careful" || begins_caution(std::span{words}.subspan(begin))) &&
         std::ranges::none_of(words, decides);
}

/// "That looks a little crowded", before "so move the cube": says only why.
bool says_why(const WordList& words, const Lexicon& lexicon) {
  const bool is_statement = is_among(words.front(), {"i", "that", "this", "it", "you", "we",
                                                     "there", "they", "he", "she", "my", "our"});
  return is_statement && std::ranges::none_of(words, decides) &&
         std::ranges::none_of(words, [&](const auto& x) {
           return is_among(x, {"want", "need", "like", "prefer", "should", "must", "wish",
                               "belongs", "belong", "goes", "go", "not", "n't", "meant", "mean"}) ||
                  is_handling_verb(x, lexicon);
         });
}

bool begins_with_if(const WordList& words) {
  return words.front() == "if" || (words.size() > 1 && words[1] == "if");
}

/// "Take the cube away, I do not need it": without remarks.
std::optional<PackedLogicalForm> without_remarks(Parser& parser, const WordList& words) {
  const auto pieces = pieces_of(words);
  if (pieces.size() < 2)
    return std::nullopt;
  WordList request;
  WordList left_out;
  // "And if that does not work, on the disc": what follows is part of it.
  bool is_alternative = false;
  bool begins_with_remark = false;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& x = pieces[i];
    const bool is_before_so = i + 1 < pieces.size() && pieces[i + 1].front() == "so";
    const bool is_aside_piece =
      (is_before_so && says_why(x, parser.lexicon())) || is_remark(x, parser.lexicon()) ||
      is_about_people(x, parser) || says_purpose(x) || is_caution(x) ||
      is_comparison(x, parser.lexicon()) || (request.empty() && is_purpose_before(x, parser)) ||
      (!begins_with_if(x) && LikelyMeaning{parser, x}.is_remark(false));
    if (request.empty() && left_out.empty())
      begins_with_remark = is_aside_piece;
    const bool is_left_out = is_alternative || is_aside_piece;
    is_alternative = is_left_out && (is_alternative || begins_with_if(x));
    auto& to = is_left_out ? left_out : request;
    if (!to.empty())
      to.emplace_back(",");
    to.insert(to.end(), x.begin(), x.end());
  }
  return clear_request(parser, request, left_out, begins_with_remark);
}

/// "Ball", "purple ball".
bool begins_name(Parser& parser, const WordList& words, std::size_t begin) {
  for (const auto length : {1, 2})
    if (const auto end = begin + static_cast<std::size_t>(length);
        end <= words.size() && name_of_things(parser, piece(words, begin, end)))
      return true;
  return false;
}

/// Adverbs that are not known, and adjectives before names: "that gorgeous purple ball".
std::optional<PackedLogicalForm> without_manner(Parser& parser, const WordList& words) {
  const auto& lexicon = parser.lexicon();
  WordList known;
  WordList left_out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto& word = words[i];
    const bool is_manner =
      word.ends_with("ly") && !lexicon.knows(word) && !lexicon.is_in(WordClass::decisive, word);
    const bool is_before_name =
      i > 0 && is_among(words[i - 1], {"the", "that", "this", "my", "our", "your"}) &&
      !lexicon.knows(word) && !lexicon.is_in_a_class(word) && is_english_word(word) &&
      begins_name(parser, words, i + 1);
    (is_manner || is_before_name ? left_out : known).push_back(word);
  }
  return clear_request(parser, known, left_out, false);
}

} // namespace

std::optional<PackedLogicalForm> parsed_without_asking(Parser& parser, const WordList& words) {
  if (words.size() < 3 || !is_among(words[0], {"can", "could", "will", "would"}) ||
      words[1] != "you")
    return std::nullopt;
  auto form = parser.parse_whole(piece(words, 2, words.size()));
  if (!form)
    return std::nullopt;
  const auto said = unpack(*form, form->readings.front().id).front();
  const auto& root = *find_nominal(said, said.root);
  return root.sort == "conjunction" && feature(root, "Mood") == "imp" ? std::move(form)
                                                                      : std::nullopt;
}

std::vector<std::string> without_reasons(const WordList& words, const Lexicon& lexicon) {
  WordList result;
  bool is_reason = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    is_reason = words[i] != "," && (is_reason || begins_reason(words, i, lexicon));
    if (!is_reason)
      result.push_back(words[i]);
  }
  return result;
}

std::optional<PackedLogicalForm> parsed_prohibition_alone(Parser& parser, const WordList& words) {
  auto pieces = pieces_of(words);
  // Who is to check something first may also lift it.
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto until = std::ranges::find_if(pieces[i], [](const auto& x) {
      return is_among(x, {"until", "till"});
    });
    if (until == pieces[i].begin() || until == pieces[i].end())
      continue;
    WordList rest{until, pieces[i].end()};
    pieces[i].erase(until, pieces[i].end());
    pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(rest));
  }
  if (pieces.size() < 2)
    return std::nullopt;
  for (const auto& piece : pieces) {
    auto form = parser.parse_whole(piece);
    if (!form)
      form = LikelyMeaning{parser, piece}.likely();
    if (!form || !is_prohibition(*form, parser.lexicon()))
      continue;
    WordList left_out;
    for (const auto& other : pieces) {
      if (&other == &piece)
        continue;
      // "Set the cubes in a row, and leave the balls alone" asks for more than that.
      const bool names_things = std::ranges::any_of(
        other, [&](const auto& x) { return name_of_things(parser, {x}).has_value(); });
      if (names_things && begins_with_handling(other, parser.lexicon()))
        return std::nullopt;
      left_out.insert(left_out.end(), other.begin(), other.end());
    }
    form->corrections = {{text_of(left_out), {}}};
    return form;
  }
  return std::nullopt;
}

std::optional<PackedLogicalForm> parsed_request_alone(Parser& parser, const WordList& words) {
  if (auto result = without_reason(parser, words))
    return result;
  if (auto result = without_remarks(parser, words))
    return result;
  return without_manner(parser, words);
}

} // namespace castor::communication
