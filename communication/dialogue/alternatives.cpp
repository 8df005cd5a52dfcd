#include "castor/communication/dialogue/alternatives.hpp"

#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/feasibility.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;

bool is_link(const std::string& word) {
  return is_among(word, {",", "or", "and", "then", "but", "so", "either"});
}

WordList trimmed(WordList words) {
  while (!words.empty() && is_link(words.back()))
    words.pop_back();
  words.erase(words.begin(), std::ranges::find_if_not(words, is_link));
  return words;
}

bool begins_place(const std::string& word) {
  return is_among(word, {"in", "on", "at", "behind", "between", "next", "beside", "near", "to",
                         "by", "onto", "into", "under", "where", "over", "close"});
}

/// What is said, taken apart.
struct Parts {
  WordList request;
  /// Empty if there is no other.
  WordList alternative;
};

/// Where there is to be room, and what for: "there is room behind the cube for the ball".
struct Room {
  WordList place;
  WordList thing;
};

std::optional<Room> room_in(const WordList& clause) {
  const auto room = std::ranges::find_if(clause, [](const auto& x) {
    return is_among(x, {"room", "space", "gap"});
  });
  const bool is_said = clause.size() > 3 && clause.front() == "there" &&
                       is_among(clause[1], {"is", "'s"}) && room != clause.end() &&
                       !says_it_fails(clause);
  if (!is_said)
    return std::nullopt;
  const auto purpose = std::find(std::next(room), clause.end(), "for");
  Room result;
  if (purpose != clause.end() && purpose == std::next(room)) {
    const auto place = std::find_if(purpose, clause.end(), begins_place);
    result = {{place, clause.end()}, {std::next(purpose), place}};
  } else {
    result.place = {std::next(room), purpose};
    if (purpose != clause.end())
      result.thing = {std::next(purpose), clause.end()};
  }
  return result.place.empty() ? std::nullopt : std::optional{std::move(result)};
}

/// "Put it there" with what is said of the room.
WordList put_there(const WordList& request, const Room& room) {
  WordList result;
  for (const auto& word : request)
    if (word == "there")
      result.insert(result.end(), room.place.begin(), room.place.end());
    else if (word == "it" && !room.thing.empty())
      result.insert(result.end(), room.thing.begin(), room.thing.end());
    else
      result.push_back(word);
  return result;
}

/// "Leave it where it is": nothing is to be done.
bool leaves_it(const WordList& words) {
  return !words.empty() && (is_among(words.front(), {"leave", "do", "tell", "say", "let"}));
}

/// Number of words of "otherwise", "else", "if not", "if there is not"; 0 if it is none of them.
std::ptrdiff_t end_of_else(const WordList& words) {
  if (is_among(words.front(), {"otherwise", "else"}))
    return 1;
  if (words.front() != "if")
    return 0;
  constexpr std::ptrdiff_t most_words = 4;
  for (std::ptrdiff_t i = 1; i < std::min(std::ssize(words), most_words + 1); ++i)
    if (const auto& word = words[static_cast<std::size_t>(i)]; word == "not" || word == "n't")
      return i + 1;
  return 0;
}

/// \param at place of "if", or of "failing"
std::optional<Parts> parts_at(const WordList& words, std::size_t at) {
  const auto before = trimmed(words_between(words, 0, at));
  const std::size_t begin = words[at] == "if" ? at + 1 : at;
  const auto pause =
    std::find(words.begin() + static_cast<std::ptrdiff_t>(begin), words.end(), ",");
  const auto end = static_cast<std::size_t>(std::distance(words.begin(), pause));
  const auto clause = words_between(words, begin, end);
  const auto after = trimmed(words_between(words, end, words.size()));
  if (says_it_fails(clause)) {
    if (!after.empty())
      return before.empty() ? std::nullopt : std::optional{Parts{before, after}};
    // "Behind the cube, or in front of it if there is no room".
    const auto either = std::ranges::find(before, "or");
    if (either == before.end())
      return std::nullopt;
    return Parts{trimmed({before.begin(), either}), trimmed({either, before.end()})};
  }
  const auto room = room_in(clause);
  const bool is_there = room && before.empty() && std::ranges::find(after, "there") != after.end();
  if (!is_there && !says_it_succeeds(clause))
    return std::nullopt;
  auto rest = before.empty() ? after : before;
  auto alternative = before.empty() ? WordList{} : after;
  // "If you can, put it on the left, otherwise on the right."
  if (before.empty())
    for (std::size_t i = 1; i + 1 < rest.size(); ++i)
      if (const bool is_or_else = rest[i] == "or" && rest[i + 1] == "else";
          is_or_else || rest[i] == "otherwise" || (rest[i] == "if" && i > 2)) {
        alternative = words_between(rest, i, rest.size());
        rest.resize(i);
        break;
      }
  alternative = trimmed(std::move(alternative));
  if (!alternative.empty()) {
    const auto link = end_of_else(alternative);
    if (link == 0)
      return std::nullopt;
    alternative.erase(alternative.begin(), alternative.begin() + link);
  }
  alternative = trimmed(std::move(alternative));
  if (is_there)
    rest = put_there(rest, *room);
  if (leaves_it(alternative))
    alternative.clear();
  return Parts{trimmed(std::move(rest)), std::move(alternative)};
}

class AlternativeSearch {
public:
  AlternativeSearch(Parser& parser, const PartParser& parse_part)
    : parser_(parser), parse_part_(parse_part) {}

  std::optional<PackedLogicalForm> of(const Parts& parts) const {
    auto result = requested(parts.request);
    if (!result || parts.alternative.empty())
      return result;
    auto other = parts.alternative;
    if (!requested(other)) {
      other = with_place(parts.request, other);
      if (other.empty())
        return std::nullopt;
    }
    result->sequel = Sequel{{}, false, true, written(other)};
    return result;
  }

private:
  std::optional<PackedLogicalForm> requested(const WordList& words) const {
    auto form = words.empty() ? std::nullopt : parse_part_(words);
    return form && !form->sequel && asks_for_handling(*form, parser_.lexicon()) ? form
                                                                                : std::nullopt;
  }

  /// The request with another place; empty if that is none.
  WordList with_place(const WordList& request, const WordList& place) const {
    if (place.empty() || !begins_place(place.front()))
      return {};
    for (auto end = request.size(); end-- > 2;) {
      if (!begins_place(request[end]))
        continue;
      auto result = words_between(request, 0, end);
      result.insert(result.end(), place.begin(), place.end());
      if (requested(result))
        return result;
    }
    return {};
  }

  Parser& parser_;
  const PartParser& parse_part_;
};

} // namespace

std::optional<PackedLogicalForm> parsed_alternative(Parser& parser, const WordList& words,
                                                    const PartParser& parse_part) {
  const AlternativeSearch search{parser, parse_part};
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "if" || words[i] == "failing")
      if (const auto parts = parts_at(words, i))
        if (auto result = search.of(*parts))
          return result;
  return std::nullopt;
}

} // namespace castor::communication
