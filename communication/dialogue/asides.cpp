#include "castor/communication/dialogue/asides.hpp"

#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

/// In words. Longer ones say something of their own.
constexpr std::size_t longest_frame = 12;

/// More words that are not known are no frame.
constexpr std::size_t most_unknown = 3;

std::string joined(std::span<const std::string> words) {
  std::string result;
  for (auto& word : words)
    if (word != ",")
      result += (result.empty() ? "" : " ") + word;
  return result;
}

/// Number of words of the longest aside at the beginning; 0 if there is none.
std::size_t aside_at_begin(std::span<const std::string> words, const Lexicon& lexicon) {
  for (auto length = std::min(words.size(), lexicon.longest_aside()); length > 0; --length)
    if (words[length - 1] != "," && lexicon.is_in(WordClass::aside, joined(words.first(length))))
      return length;
  return 0;
}

/// Without words that have no meaning of their own wherever they stand.
WordList without_fillers(WordList words, const Lexicon& lexicon) {
  std::erase_if(words, [&](auto& word) { return word != "," && lexicon.filler(word) != nullptr; });
  return words;
}

/// "On the right", "what kind", "further right": what follows is no aside.
bool is_before_noun(std::string_view word) {
  return is_among(word, {"the", "a", "an", "it", "what", "which", "every", "each", "no", "further",
                         "more", "to", "far"});
}

} // namespace

WordList without_asides(std::span<const std::string> words, const Lexicon& lexicon,
                        bool is_known_kept) {
  WordList result;
  for (std::size_t i = 0; i < words.size();) {
    const bool may_be_aside = i == 0 || !is_before_noun(words[i - 1]);
    auto length = may_be_aside ? aside_at_begin(words.subspan(i), lexicon) : 0;
    if (is_known_kept && length > 0 && !lexicon.find(joined(words.subspan(i, length))).empty())
      length = 0;
    // "Which, if any, are red?"
    const bool is_between_commas = length > 0 && !result.empty() && result.back() == "," &&
                                   i + length < words.size() && words[i + length] == ",";
    if (is_between_commas) {
      result.pop_back();
      ++length;
    }
    if (length == 0 && !(words[i] == "," && (result.empty() || result.back() == ",")))
      result.push_back(words[i]);
    i += std::max<std::size_t>(length, 1);
  }
  while (!result.empty() && result.back() == ",")
    result.pop_back();
  return result;
}

namespace {

/// Whether an unknown word may say where, when or how something is: "underwater", "painted".
bool may_be_adverb(std::string_view word) {
  constexpr std::array endings{"ly", "day", "where", "water", "side", "wards", "ing", "ed"};
  return std::ranges::any_of(endings, [&](auto* ending) { return word.ends_with(ending); });
}

/// Whether somebody is named at a position, since it is told there what they say or hear: "Zorg
/// says", "tell the zorgs".
bool is_beside_telling(std::span<const std::string> words, std::size_t i, const Lexicon& lexicon) {
  const auto tells = [&](std::size_t at) {
    return at < words.size() && lexicon.is_in(WordClass::telling, words[at]);
  };
  const bool has_article = i > 0 && (words[i - 1] == "the" || words[i - 1] == "my");
  const auto before = has_article ? 2u : 1u;
  return tells(i + 1) || (i >= before && tells(i - before));
}

} // namespace

std::optional<Frame> frame_of(std::span<const std::string> words, const Lexicon& lexicon) {
  Frame result;
  if (words.size() > longest_frame)
    return std::nullopt;
  const auto is_person_at = [&](std::size_t i) {
    return i < words.size() &&
           (lexicon.is_in(WordClass::person, words[i]) || lexicon.is_in(WordClass::name, words[i]));
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (const auto length = aside_at_begin(words.subspan(i), lexicon); length > 0) {
      result.has_person =
        result.has_person || (length == 1 && is_beside_telling(words, i, lexicon));
      i += length - 1;
      continue;
    }
    auto& word = words[i];
    const bool is_person = is_person_at(i);
    // "If I may", but not "whether the ball is red".
    const bool is_polite = is_among(word, {"if", "whether"}) && is_person_at(i + 1);
    if (lexicon.is_in(WordClass::decisive, word))
      return std::nullopt;
    const bool is_harmless = word == "," || is_person || is_polite ||
                             lexicon.is_in(WordClass::frame, word) ||
                             lexicon.filler(word) != nullptr;
    if (!is_harmless && (lexicon.knows(word) || is_quoted(word)))
      return std::nullopt;
    result.unknown += is_harmless ? 0 : 1;
    result.has_adverb = result.has_adverb || (!is_harmless && may_be_adverb(word));
    result.has_person =
      result.has_person || is_person || (!is_harmless && is_beside_telling(words, i, lexicon));
  }
  if (result.unknown > most_unknown || (result.has_adverb && !result.has_person))
    return std::nullopt;
  return result;
}

namespace {

/// That of an utterance that is understood.
LogicalForm first_reading(const PackedLogicalForm& form) {
  return unpack(form, form.readings.front().id).front();
}

bool is_request(const LogicalForm& form) {
  return feature(*find_nominal(form, form.root), "Mood") == "imp";
}

/// Whether something is said or asked; a phrase may go on with the sentence before.
bool is_sentence(const LogicalForm& form) {
  const auto& root = *find_nominal(form, form.root);
  return is_clause(form, root) || feature(root, "Mood") == "int" || root.sort == "small-talk";
}

} // namespace

bool says_sentence(const PackedLogicalForm& form) {
  return is_sentence(first_reading(form));
}

namespace {

/// Looks for the part of an utterance that is understood by itself.
class CoreSearch {
public:
  CoreSearch(Parser& parser, const WordList& words) : parser_(parser), words_(words) {}

  std::optional<PackedLogicalForm> run() {
    for (const auto end : ends())
      for (const auto begin : begins(end))
        if (begin > 0 || end < words_.size())
          if (auto form = core(begin, end)) {
            note_left_out(0, begin, *form);
            note_left_out(end, words_.size(), *form);
            return form;
          }
    return std::nullopt;
  }

private:
  const Lexicon& lexicon() const { return parser_.lexicon(); }

  std::optional<Frame> frame(std::size_t begin, std::size_t end) const {
    return frame_of(std::span{words_}.subspan(begin, end - begin), lexicon());
  }

  bool is_after_pause(std::size_t position) const { return words_[position - 1] == ","; }

  /// Where the matter may end; least is left out first.
  std::vector<std::size_t> ends() const {
    std::vector<std::size_t> result{words_.size()};
    for (auto i = words_.size(); i-- > 1;)
      if (words_[i] == ",")
        if (auto x = frame(i, words_.size()); x && (x->has_person || x->unknown == 0))
          result.push_back(i);
    return result;
  }

  /// Where the matter may begin: with the first word, or after a frame; the longest is left out
  /// first, since shorter ones leave a part of it.
  std::vector<std::size_t> begins(std::size_t end) const {
    std::vector<std::size_t> result{0};
    for (auto i = end; i-- > 1;)
      if (auto x = frame(0, i); x && words_[i] != "," && !is_before_noun(words_[i - 1]) &&
                                (x->has_person || is_after_pause(i)) &&
                                !(x->unknown > 0 && is_topic(i, end)))
        result.push_back(i);
    return result;
  }

  /// "My zorg, what colour is it?" speaks of the zorg.
  bool is_topic(std::size_t begin, std::size_t end) const {
    return is_among(words_.front(), {"my", "your", "our"}) && is_after_pause(begin) &&
           std::any_of(words_.begin() + static_cast<std::ptrdiff_t>(begin),
                       words_.begin() + static_cast<std::ptrdiff_t>(end), [](auto& word) {
                         return is_among(word, {"it", "its", "they", "them", "that", "those",
                                                "this", "these", "one", "ones"});
                       });
  }

  std::optional<PackedLogicalForm> core(std::size_t begin, std::size_t end) {
    const bool is_after_person = begin > 0 && !is_after_pause(begin);
    while (begin > 0 && begin < end && is_among(words_[begin], {",", "but", "and", "so", "that"}))
      ++begin;
    const auto said = std::span{words_}.subspan(begin, end - begin);
    auto words = without_asides(said, lexicon());
    if (words.empty())
      words = without_asides(said, lexicon(), true);
    // "Do you, robot?" says to whom.
    if (words.empty() || words == WordList{"robot"})
      return std::nullopt;
    if (is_after_person && is_asked_for(begin, words.front())) {
      auto request = words;
      request.insert(request.begin(), {"tell", "me"});
      if (auto form = parser_.parse_whole(std::move(request)))
        return form;
    }
    auto form = parser_.parse_whole(std::move(words));
    if (!form || (!is_after_person && end == words_.size()))
      return form;
    const auto core = first_reading(*form);
    return is_sentence(core) && !is_request(core) ? std::move(form) : std::nullopt;
  }

  /// "... whether it is red", "... what colour it is", "... to know the colour of the ball".
  bool is_asked_for(std::size_t begin, std::string_view next) const {
    return is_among(next, {"whether", "if", "what", "which", "how", "where", "who"}) ||
           is_among(words_[begin - 1], {"know", "learn", "hear", "for", "told"});
  }

  void note_left_out(std::size_t begin, std::size_t end, PackedLogicalForm& form) const {
    if (begin < end && frame(begin, end)->unknown > 0)
      form.corrections.push_back({joined(std::span{words_}.subspan(begin, end - begin)), {}});
  }

  Parser& parser_;
  const WordList& words_;
};

} // namespace

std::optional<PackedLogicalForm> parsed_without_asides(Parser& parser, const WordList& words) {
  if (const auto most = without_asides(words, parser.lexicon(), true); most.size() < words.size())
    if (auto form = parser.parse_whole(most))
      return form;
  const auto core = without_asides(words, parser.lexicon());
  if (core.empty())
    return std::nullopt;
  if (core.size() < words.size())
    if (auto form = parser.parse_whole(core))
      return form;
  if (auto plain = without_fillers(core, parser.lexicon()); plain.size() < core.size())
    if (auto form = parser.parse_whole(std::move(plain)); form && is_sentence(first_reading(*form)))
      return form;
  return CoreSearch{parser, words}.run();
}

} // namespace castor::communication
