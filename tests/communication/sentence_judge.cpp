#include "castor/tests/communication/sentence_judge.hpp"

#include "castor/tests/communication/reply_reader.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

namespace castor::communication::test {

namespace {

using Expected = ExpectedReply::Kind;
using Read = ReadReply::Kind;

/// Without "I take 'bal' for 'ball'." and "I leave out 'my friends say'."
std::string_view without_correction(std::string_view text) {
  for (std::string_view begin : {"I take '", "I leave out '"})
    if (const auto end = text.find("'. "); text.starts_with(begin) && end != text.npos)
      text.remove_prefix(end + 3);
  return text;
}

std::string noun_of(const std::string& shape) {
  return shape == "sphere" ? "ball" : shape == "circle" ? "disc" : shape;
}

bool is_like(const ThingInSet& x, const ReadReply::Described& words) {
  return (words.colour.empty() || words.colour == x.colour) &&
         (words.shape.empty() || words.shape == noun_of(x.shape)) &&
         (words.size.empty() || (words.size == "large") == x.is_large());
}

bool contains_id(const std::vector<std::string>& ids, const std::string& id) {
  return std::ranges::find(ids, id) != ids.end();
}

/// Whether all things with these ids are described, each once, and no others.
bool are_described(const std::vector<std::string>& ids, const std::vector<ThingInSet>& things,
                   const ReadReply& reply) {
  std::set<std::string> used;
  for (auto& words : reply.mentioned) {
    const auto thing = std::ranges::find_if(things, [&](auto& x) {
      return is_like(x, words) && contains_id(ids, x.id) && !used.contains(x.id);
    });
    if (thing == things.end())
      return false;
    used.insert(thing->id);
  }
  return used.size() == ids.size();
}

bool is_at(const std::pair<std::string, std::string>& place, const std::vector<ThingInSet>& things,
           const ReadReply& reply, std::string_view text) {
  if (text.find(place.first) == std::string_view::npos)
    return false;
  return place.second == "table" || std::ranges::any_of(reply.mentioned, [&](auto& words) {
           return std::ranges::any_of(
             things, [&](auto& x) { return x.id == place.second && is_like(x, words); });
         });
}

bool is_denial(const ReadReply& reply) {
  return reply.kind == Read::no || reply.kind == Read::not_seen ||
         (reply.kind == Read::statement && reply.number == 0u);
}

bool is_small_talk(const Reply& reply, std::string_view text) {
  constexpr std::array words{"robot", "fine", "welcome", "Ask me", "I can tell you"};
  return reply.relation == RhetoricalRelation::greeting ||
         std::ranges::any_of(
           words, [&](const char* word) { return text.find(word) != std::string_view::npos; });
}

/// The words of the reply that are among those that could be asked for.
std::set<std::string> said_of(Expected kind, const ReadReply& reply) {
  const auto& words = kind == Expected::colour  ? reply.colours
                      : kind == Expected::shape ? reply.shapes
                                                : reply.sizes;
  return {words.begin(), words.end()};
}

bool is_right(const Reply& reply, const ReadReply& read, std::string_view text,
              const ExpectedReply& expected, const std::vector<ThingInSet>& things) {
  switch (expected.kind) {
    case Expected::yes:
      return read.kind == Read::yes || read.kind == Read::accepted ||
             (read.kind == Read::statement && read.is_existence && read.number != 0u);
    case Expected::no:
      return is_denial(read);
    case Expected::count:
      return read.kind == Read::not_seen ? expected.number == 0 : read.number == expected.number;
    case Expected::colour:
    case Expected::shape:
    case Expected::size: {
      std::set<std::string> values;
      for (auto& x : expected.values)
        values.insert(expected.kind == Expected::shape ? noun_of(x) : x);
      return said_of(expected.kind, read) == values;
    }
    case Expected::objects:
      if (expected.things.empty())
        return is_denial(read);
      return are_described(expected.things, things, read);
    case Expected::place:
      return std::ranges::any_of(expected.places,
                                 [&](auto& place) { return is_at(place, things, read, text); });
    case Expected::description: {
      std::vector<std::string> all;
      for (auto& x : things)
        all.push_back(x.id);
      return are_described(all, things, read);
    }
    case Expected::accepted:
      return read.kind == Read::accepted || read.kind == Read::yes;
    case Expected::contradicted:
      return is_denial(read) || (read.kind == Read::statement && read.is_existence);
    case Expected::small_talk:
      return is_small_talk(reply, text);
    case Expected::presupposition_failure:
      return read.kind == Read::not_seen || (read.kind == Read::statement && read.number == 0u);
    case Expected::unknown:
      return read.kind == Read::not_seen;
  }
  return false;
}

} // namespace

SentenceJudgement judge(const Reply& reply, const ExpectedReply& expected,
                        const std::vector<ThingInSet>& things) {
  const auto text = without_correction(reply.text);
  const auto read = read_reply(text);
  const bool is_open = !reply.is_parsed || read.kind == Read::not_understood ||
                       read.kind == Read::unknown || read.kind == Read::asked_back ||
                       text.find("I can not do") != std::string_view::npos || reply.silences > 0;
  if (is_open)
    return expected.kind == Expected::unknown ? SentenceJudgement::right
                                              : SentenceJudgement::not_answered;
  return is_right(reply, read, text, expected, things) ? SentenceJudgement::right
                                                       : SentenceJudgement::wrong;
}

} // namespace castor::communication::test
