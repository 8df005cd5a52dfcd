#include "castor/communication/parsing/chatter.hpp"

#include "castor/communication/parsing/pauses.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

/// What people say of themselves and of whom they talk to begins with one of these.
constexpr std::array persons{
  "i",  "me",  "my",  "myself", "you", "your",      "yourself", "we",       "us",      "our",
  "he", "him", "his", "she",    "her", "everybody", "everyone", "somebody", "someone", "people"};

/// A part that begins with one of these says nothing of the scene if it has no words for that.
constexpr std::array openers{"sorry",     "pardon",   "forgive", "apologies", "excuse", "thanks",
                             "please",    "quick",    "listen",  "look",      "hey",    "hello",
                             "hi",        "good",     "dear",    "well",      "okay",   "ok",
                             "according", "honestly", "say",     "oh"};

/// "If you do not mind", "if I may ask": a condition that is none.
constexpr std::array polite{"mind",   "may",     "please",   "trouble", "ask",
                            "asking", "kind",    "bother",   "good",    "ok",
                            "okay",   "alright", "possible", "permit",  "allow"};

/// What may exclude something or set a condition.
constexpr std::array restrictive{"if",      "unless",   "suppose", "supposing", "imagine",
                                 "assume",  "assuming", "except",  "without",   "besides",
                                 "only",    "when",     "once",    "after",     "before",
                                 "while",   "until",    "where",   "ignoring",  "excluding",
                                 "instead", "pretend",  "apart",   "nobody",    "nothing"};

/// Verbs of what somebody takes to be so, before a statement.
constexpr std::array attitudes{"believe",   "believes", "suppose", "think",  "thinks", "guess",
                               "reckon",    "say",      "says",    "bet",    "heard",  "hear",
                               "told",      "tell",     "tells",   "claim",  "claims", "notice",
                               "noticed",   "gather",   "presume", "assume", "sure",   "certain",
                               "convinced", "feel",     "know",    "knows"};

/// What makes an attitude none, or the opposite.
constexpr std::array denials{"not",   "n't",   "never", "no",    "nobody", "hardly",
                             "doubt", "wrong", "false", "would", "if",     "did",
                             "do",    "does",  "hope",  "wish",  "was",    "used"};

/// WordList before a question within a sentence or before the quality that is asked for.
constexpr std::array transfers{"know",    "tell", "me",     "us",        "ask",  "learn",  "hear",
                               "give",    "say",  "wonder", "wondering", "see",  "check",  "name",
                               "confirm", "sure", "find",   "out",       "idea", "curious"};

constexpr std::array question_words{"what", "which", "how", "where", "whereabouts", "whether"};

constexpr std::array auxiliaries{"is", "are", "do", "does", "can", "could", "would", "have"};

constexpr std::array quality_nouns{"colour", "color", "shape", "size", "number"};

template <std::size_t N>
bool is_among(std::string_view word, const std::array<const char*, N>& words) {
  return std::ranges::find(words, word) != words.end();
}

template <std::size_t N>
bool has_any_of(std::span<const std::string> part, const std::array<const char*, N>& words) {
  return std::ranges::any_of(part, [&](auto& word) { return is_among(word, words); });
}

/// Sorts of what is said of the scene.
constexpr std::array sorts_of_scene{"thing",    "colour",     "size",    "shape",
                                    "material", "region",     "quality", "selection",
                                    "number",   "comparison", "property"};

/// WordList that a phrase about people may have although they may stand for things, too.
constexpr std::array demonstratives{"it", "this", "that"};

/// Whether a word by itself may say something of the scene.
bool is_about_scene(const std::string& word, const Lexicon& lexicon) {
  if (is_quoted(word))
    return true;
  if (is_among(word, demonstratives) || is_among(word, persons))
    return false;
  for (const auto number : lexicon.find(word)) {
    const auto& entry = lexicon.entry(number);
    for (auto& x : entry.predications)
      if (x.kind == Predication::Kind::sort &&
          is_among(lexicon.symbols().text(x.value), sorts_of_scene))
        return true;
  }
  return false;
}

/// Whether a part between pauses says nothing of the scene.
bool is_chatter(std::span<const std::string> part, const Lexicon& lexicon) {
  if (part.empty())
    return true;
  if (std::ranges::any_of(part, [&](auto& x) {
        return is_about_scene(x, lexicon) && !is_among(x, openers) && !is_among(x, polite);
      }))
    return false;
  if (part.front() == "if") {
    const auto rest = part.subspan(1);
    return has_any_of(rest, polite) && !has_any_of(rest, restrictive);
  }
  if (has_any_of(part, restrictive))
    return false;
  return has_any_of(part, persons) || is_among(part.front(), openers);
}

/// Endings of words that say where, when or how rather than who.
constexpr std::array adverb_endings{"ly", "day", "where", "water", "side", "wards", "ing", "ed"};

/// Somebody who is spoken to, by a name that is not known.
bool is_name(std::span<const std::string> part, const Lexicon& lexicon) {
  return part.size() == 1 && !lexicon.knows(part.front()) &&
         std::ranges::none_of(adverb_endings,
                              [&](auto* ending) { return part.front().ends_with(ending); });
}

std::vector<WordList> parts_of(const WordList& words) {
  std::vector<WordList> parts(1);
  for (auto& word : words)
    if (word == ",")
      parts.emplace_back();
    else
      parts.back().push_back(word);
  return parts;
}

bool is_anaphor(const std::string& word) {
  return word == "it" || word == "its" || word == "they" || word == "them" || word == "that" ||
         word == "one" || word == "ones";
}

/// "My zorg, what colour is it?" speaks of the zorg.
bool may_be_topic(std::span<const std::string> part, std::span<const WordList> rest) {
  constexpr std::array determiners{"my", "your", "our", "his", "her"};
  return !part.empty() && is_among(part.front(), determiners) &&
         std::ranges::any_of(rest, [](auto& x) { return std::ranges::any_of(x, is_anaphor); });
}

/// Where the question or the statement begins in what somebody says that they want to know or take
/// to be so; the words that take the place of those before it.
struct Frame {
  std::size_t end = 0;
  WordList replacement;
};

std::optional<Frame> frame_of(const WordList& part, const Lexicon& lexicon) {
  for (std::size_t i = 1; i < part.size(); ++i) {
    const std::span before{part.data(), i};
    if (is_about_scene(part[i - 1], lexicon) && !is_among(part[i - 1], polite))
      return std::nullopt;
    const auto& last = part[i - 1];
    const auto& next = part[i];
    const bool is_personal = has_any_of(before, persons);
    if (is_personal && is_among(next, question_words))
      return Frame{i, {"tell", "me"}};
    if (is_personal && next == "if" && is_among(last, transfers) && i + 1 < part.size() &&
        !is_among(part[i + 1], persons))
      return Frame{i, {"tell", "me"}};
    if (is_personal && next == "the" && i + 1 < part.size() &&
        is_among(part[i + 1], quality_nouns) && is_among(last, transfers))
      return Frame{i, {"tell", "me"}};
    const bool is_attitude =
      has_any_of(before, attitudes) && !has_any_of(before, denials) &&
      (is_among(last, attitudes) || last == "me" || last == "us" || last == "you");
    if (is_attitude && !is_among(part.front(), auxiliaries) && next == "that")
      return Frame{i + 1, {}};
    const bool begins_statement = next == "there" || next == "the" || next == "all" ||
                                  next == "every" || next == "no" || next == "both" ||
                                  next == "everything" || next == "most" || next == "some";
    if (is_attitude && is_personal && is_among(last, attitudes) && begins_statement &&
        !is_among(part.front(), auxiliaries))
      return Frame{i, {}};
    // "I do believe there is a ball."
    if (i >= 3 && part[i - 2] == "do" && part.front() == "i" && i == 3 &&
        is_among(last, attitudes) && (begins_statement || next == "that"))
      return Frame{i + (next == "that" ? 1U : 0U), {}};
  }
  return std::nullopt;
}

/// A sentence, not a phrase that goes on with the sentence before.
bool is_sentence(const PackedLogicalForm& form) {
  return std::ranges::any_of(form.nominals, [](const PackedNominal& x) {
    return std::ranges::any_of(x.sorts, [](auto& sort) {
      return sort.value == "ascription" || sort.value == "existence" || sort.value == "action" ||
             sort.value == "small-talk";
    });
  });
}

PackedLogicalForm form_without_chatter(Parser& parser, WordList words) {
  IncrementalParse parse{parser};
  for (auto& word : words)
    parse.add(std::move(word));
  parse.finish();
  return parse.form();
}

bool is_understood(const PackedLogicalForm& form) {
  return form.unparsable.empty() && !form.readings.empty();
}

} // namespace

std::optional<WordList> without_chatter(const WordList& words, const Lexicon& lexicon) {
  auto parts = parts_of(words);
  const auto is_left_out = [&](const WordList& part, std::span<const WordList> rest) {
    return (is_chatter(part, lexicon) || is_name(part, lexicon)) && !may_be_topic(part, rest);
  };
  bool is_shorter = false;
  while (parts.size() > 1 && is_left_out(parts.front(), std::span{parts}.subspan(1))) {
    parts.erase(parts.begin());
    is_shorter = true;
    if (auto& next = parts.front();
        next.size() > 1 && (next.front() == "but" || next.front() == "so"))
      next.erase(next.begin());
  }
  while (parts.size() > 1 && is_left_out(parts.back(), {})) {
    parts.pop_back();
    is_shorter = true;
  }
  if (auto frame = frame_of(parts.front(), lexicon)) {
    auto& part = parts.front();
    part.erase(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(frame->end));
    part.insert(part.begin(), frame->replacement.begin(), frame->replacement.end());
    is_shorter = is_shorter || part != parts_of(words).front();
  }
  if (!is_shorter || parts.front().empty())
    return std::nullopt;
  WordList result;
  for (auto& part : parts) {
    if (!result.empty())
      result.emplace_back(",");
    result.insert(result.end(), part.begin(), part.end());
  }
  return result;
}

std::optional<PackedLogicalForm> parsed_otherwise(Parser& parser, const WordList& words,
                                                  const PackedLogicalForm& form) {
  if (is_understood(form))
    return std::nullopt;
  // "Any of them a ball" is no list of two phrases.
  if (auto with_pause = parsed_with_pause(parser, words, form);
      with_pause && is_sentence(*with_pause))
    return with_pause;
  const auto core = without_chatter(words, parser.lexicon());
  if (!core)
    return std::nullopt;
  auto result = form_without_chatter(parser, *core);
  if (!is_understood(result))
    if (auto with_pause = parsed_with_pause(parser, *core, result))
      result = std::move(*with_pause);
  // What is left of "the red one, I liked it" is no sentence.
  if (!is_understood(result) || !is_sentence(result))
    return std::nullopt;
  return result;
}

} // namespace castor::communication
