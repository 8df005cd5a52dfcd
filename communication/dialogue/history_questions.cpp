#include "castor/communication/dialogue/history_questions.hpp"

#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

namespace castor::communication {

namespace {

using WordSpan = std::span<const std::string>;

bool says(WordSpan words, std::initializer_list<std::string_view> any) {
  return std::ranges::any_of(words, [&](const auto& x) { return is_among(x, any); });
}

bool is_thing(std::string_view word) {
  return is_among(word, {"thing",  "things", "object",  "objects",   "item",  "items", "piece",
                         "pieces", "one",    "ones",    "of",        "the",   "them",  "these",
                         "those",  "all",    "exactly", "different", "other", "others"});
}

bool is_kind(std::string_view word) {
  return is_among(word, {"balls", "cubes", "cylinders", "boxes", "blocks", "discs"});
}

bool is_move(std::string_view word) {
  return is_among(word, {"move", "moved", "touch", "touched", "shift", "shifted", "displace",
                         "displaced", "handle", "handled", "relocate", "relocated", "transport",
                         "transported", "rearrange", "rearranged", "change", "changed"});
}

bool is_deed(std::string_view word) {
  return is_among(word, {"do", "done", "did", "accomplish", "accomplished", "achieve", "achieved"});
}

bool is_choice(std::string_view word) {
  return is_among(word,
                  {"choose", "chose", "chosen", "pick", "picked", "select", "selected", "take",
                   "took", "taken", "use", "used", "grab", "grabbed", "pushed", "push"});
}

bool is_number_of_moves(std::string_view word) {
  return is_among(word, {"moves", "movements", "actions", "steps", "operations", "times"});
}

/// Says of a question about moves only when they were made, or why.
bool may_follow_verb(std::string_view word) {
  return is_among(
    word,
    {"so",     "far",        "already", "until",    "now",        "up",      "to",        "for",
     "that",   "this",       "since",   "we",       "began",      "started", "the",       "start",
     "last",   "first",      "just",    "have",     "had",        "in",      "total",     "today",
     "at",     "all",        "before",  "yet",      "of",         "them",    "it",        "me",
     "my",     "then",       "there",   "by",       "altogether", "during",  "request",   "us",
     "been",   "recently",   "order",   "sequence", "ago",        "please",  "beginning", "end",
     "moment", "previously", "earlier", "doing",    "process",    "and",     "where",     "why"});
}

/// Whether one of the first words stands before one of the others: "for that", "by me".
bool says_pair(WordSpan words, std::initializer_list<std::string_view> first,
               std::initializer_list<std::string_view> next) {
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (is_among(words[i], first) && is_among(words[i + 1], next))
      return true;
  return false;
}

/// "For that", "by that", "since the last request".
bool is_of_last_request(WordSpan words) {
  return says(words, {"doing", "process", "request"}) ||
         says_pair(words, {"for", "by"}, {"that", "this", "it"});
}

/// "Can you tell me", "describe in one sentence".
WordSpan without_lead(WordSpan words) {
  const auto is_lead = [](const std::string& x) {
    return is_among(x,
                    {"and",    "now",   "so",      "then",     "please", "ok",        "okay",
                     ",",      "can",   "could",   "would",    "will",   "you",       "tell",
                     "me",     "us",    "say",     "remind",   "let",    "know",      "describe",
                     "report", "in",    "one",     "sentence", "list",   "summarise", "summarize",
                     "show",   "state", "explain", "briefly",  "again",  "do",        "remember"});
  };
  while (!words.empty() && is_lead(words.front())) {
    const bool asks_itself =
      words.size() > 2 && words[0] == "in" && is_among(words[1], {"which", "what"});
    if (asks_itself)
      break;
    words = words.subspan(1);
  }
  return words;
}

/// What the question says before, as and after its verb.
struct QuestionParts {
  WordSpan before;
  std::string verb;
  WordSpan after;
  bool is_denied = false;
};

bool is_auxiliary(std::string_view word) {
  return is_among(word, {"did", "have", "had", "has", "you", "'ve", "was", "were", "been", "just",
                         "not", "n't", "already", "to", "actually", "that", "'d"});
}

/// "Did you have to move", "have been moved": from the auxiliary to the verb.
std::optional<QuestionParts> parts_of(WordSpan words) {
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (!is_among(words[i], {"did", "have", "has", "had", "you", "was", "were"}))
      continue;
    auto verb = i;
    while (verb < words.size() && is_auxiliary(words[verb]))
      ++verb;
    // "What did you do" and "what you did" have their auxiliary as a verb.
    if (verb == words.size() && is_deed(words[verb - 1]))
      --verb;
    if (verb == words.size() || verb == i)
      return std::nullopt;
    const auto auxiliaries = words.subspan(i, verb - i);
    const bool is_of_robot = says(auxiliaries, {"you"});
    const bool is_passive = says(auxiliaries, {"was", "were", "been"});
    if (!is_of_robot && !is_passive)
      return std::nullopt;
    return QuestionParts{words.first(i), words[verb], words.subspan(verb + 1),
                         says(auxiliaries, {"not", "n't"})};
  }
  return std::nullopt;
}

} // namespace

std::optional<std::vector<std::string>>
question_about_moves(const std::vector<std::string>& words) {
  auto asked = without_lead(words);
  if (asked.size() < 3 || !is_among(asked[0], {"which", "what", "how", "in"}))
    return std::nullopt;
  const auto parts = parts_of(asked);
  if (!parts || !std::ranges::all_of(parts->after, may_follow_verb))
    return std::nullopt;
  const auto begin = parts->before.front();
  const auto about = parts->before.subspan(1);
  // What somebody else has moved it does not know.
  if (says_pair(parts->after, {"by"}, {"me", "us", "them"}))
    return std::nullopt;
  const bool is_last =
    (says(parts->after, {"last"}) && !is_of_last_request(parts->after)) || says(asked, {"just"});
  const auto in_words = [](std::string_view text) { return words_of(text); };
  if (begin == "how" && (about.empty() || !is_among(about[0], {"many", "often"})))
    return std::nullopt;
  if (begin == "in")
    return about.size() > 1 && is_among(about[1], {"order", "sequence"}) && is_move(parts->verb)
             ? std::optional{in_words("in which order did you move them")}
             : std::nullopt;
  const bool is_about_moves =
    about.size() > 1 && about[0] == "many" && is_number_of_moves(about[1]);
  const bool is_made = is_move(parts->verb) || is_deed(parts->verb) ||
                       is_among(parts->verb, {"make", "made", "perform", "performed"});
  if (is_about_moves || (!about.empty() && about[0] == "often"))
    return is_made && !parts->is_denied ? std::optional{in_words("how many moves have you made")}
                                        : std::nullopt;
  const auto kind = std::ranges::find_if(about, is_kind);
  const bool is_of_things = std::ranges::all_of(
    about, [](const auto& x) { return x == "many" || is_thing(x) || is_kind(x) || x == ","; });
  if (!is_of_things)
    return std::nullopt;
  if (is_deed(parts->verb))
    return begin != "what" ? std::nullopt
           : is_last || parts->after.empty()
             ? std::optional{in_words("what did you do last")}
             : std::optional{in_words("in which order did you move them")};
  if (is_choice(parts->verb) && !parts->is_denied)
    return begin != "which" ? std::nullopt : std::optional{in_words("which one did you move last")};
  if (!is_move(parts->verb))
    return std::nullopt;
  if (says(parts->after, {"first"}))
    return in_words("what did you move first");
  // "What did you just move?" is about all that was moved for the last request.
  if (is_last && begin == "what" && says(asked, {"just"}) && !says(parts->after, {"last"}))
    return in_words("which things have you moved for that");
  if (is_last)
    return in_words("what did you move last");
  const auto things = kind == about.end() ? std::string{"things"} : *kind;
  if (parts->is_denied)
    return in_words("which " + things + " have you not moved");
  if (kind == about.end() && is_of_last_request(parts->after))
    return in_words("which things have you moved for that");
  return in_words("which " + things + " have you moved");
}

} // namespace castor::communication
