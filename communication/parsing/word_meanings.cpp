#include "castor/communication/parsing/word_meanings.hpp"

#include "castor/base/suggestion.hpp"

#include <algorithm>

namespace castor::communication {

namespace {

using Pieces = std::vector<Piece>;

const std::vector<std::string_view> known_keywords = {
  "concept",      "general",   "content", "quality",  "value", "look", "relation",
  "surroundings", "addressee", "action",  "handling", "side",  "reply"};

/// Kinds of features whose values are words for what something is like, as binding calls them.
const std::vector<std::string_view> feature_kinds = {"colour", "shape", "size", "material", "name"};

void read_pairs(const Pieces& pieces, WordMeanings::Words& into) {
  for (const auto& piece : pieces) {
    auto pair = word_pair_of(piece);
    into.insert_or_assign(std::move(pair.word), std::move(pair.other));
  }
}

void read_qualities(const Pieces& pieces, WordMeanings& meanings) {
  for (const auto& piece : pieces) {
    auto pair = word_pair_of(piece);
    if (std::ranges::find(feature_kinds, pair.other) == feature_kinds.end()) {
      const auto meant = did_you_mean(pair.other, feature_kinds);
      fail(piece, "no kind of features is called \"" + pair.other + '"',
           meant.empty() ? "Write QUALITY=KIND, where the kind is colour, shape, size, material or "
                           "name."
                         : meant);
    }
    meanings.qualities.insert_or_assign(std::move(pair.word), std::move(pair.other));
  }
}

void require_quality(const Piece& piece, const WordMeanings& meanings) {
  if (meanings.qualities.contains(piece.text))
    return;
  std::vector<std::string_view> names;
  for (auto& [name, kind] : meanings.qualities)
    names.push_back(name);
  const auto meant = did_you_mean(piece.text, names);
  fail(piece, "there is no quality \"" + piece.text + '"',
       meant.empty() ? "Write before it: quality " + piece.text + "=KIND" : meant);
}

void read_values(const Pieces& pieces, WordMeanings& meanings) {
  require_quality(pieces.front(), meanings);
  read_pairs({pieces.begin() + 1, pieces.end()}, meanings.values[pieces.front().text]);
}

void read_look(const Pieces& pieces, WordMeanings& meanings) {
  if (pieces.size() < 3)
    fail(pieces.front(), "it does not say what looks so", "Write: look WORD QUALITY VALUE...");
  require_quality(pieces[1], meanings);
  auto& look = meanings.looks[pieces.front().text];
  look.quality = pieces[1].text;
  for (std::size_t i = 2; i < pieces.size(); ++i) {
    const auto& word = pieces[i].text;
    if (word == "?")
      fail(pieces[i], "there is no value after \"?\"", "Write ?VALUE where it is not known.");
    if (word.front() == '?')
      look.unknown.insert(word.substr(1));
    else
      look.values.insert(word);
  }
}

void read_side(const Pieces& pieces, WordMeanings& meanings) {
  if (pieces.size() < 2)
    fail(pieces.front(), "it does not say which side that is",
         "Write: side NOUN left right top bottom, or some of these, or corner");
  auto& side = meanings.sides[pieces.front().text];
  side = {};
  const std::map<std::string_view, bool*> parts{{"left", &side.left},
                                                {"right", &side.right},
                                                {"top", &side.top},
                                                {"bottom", &side.bottom},
                                                {"corner", &side.corner}};
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const auto part = parts.find(pieces[i].text);
    if (part == parts.end())
      fail(pieces[i], "no side is called \"" + pieces[i].text + '"',
           "Write left, right, top, bottom or corner.");
    *part->second = true;
  }
}

void read_reply(const Pieces& pieces, WordMeanings& meanings) {
  if (pieces.size() < 2)
    fail(pieces.front(), "it does not say what to reply", "Write: reply TOPIC SENTENCE");
  auto& text = meanings.replies[pieces.front().text];
  text.clear();
  for (std::size_t i = 1; i < pieces.size(); ++i)
    text += (text.empty() ? "" : " ") + pieces[i].text;
}

void read_surroundings(const Pieces& pieces, WordMeanings& meanings) {
  if (pieces.size() < 2)
    fail(pieces.front(), "it does not say by which word something is there",
         "Write: surroundings NOUN REGION..., such as surroundings table on");
  WordMeanings::Surroundings where{pieces.front().text, {}};
  for (std::size_t i = 1; i < pieces.size(); ++i)
    where.regions.push_back(pieces[i].text);
  std::erase_if(meanings.surroundings, [&](auto& x) { return x.noun == where.noun; });
  meanings.surroundings.push_back(std::move(where));
}

} // namespace

bool is_meaning_keyword(std::string_view word) {
  return std::ranges::find(known_keywords, word) != known_keywords.end();
}

const std::vector<std::string_view>& meaning_keywords() {
  return known_keywords;
}

void read_meaning(const Piece& keyword, const Pieces& pieces, WordMeanings& meanings) {
  const auto& what = keyword.text;
  if (what == "concept")
    read_pairs(pieces, meanings.concepts);
  else if (what == "general")
    for (const auto& piece : pieces)
      meanings.general.push_back(piece.text);
  else if (what == "content")
    for (const auto& piece : pieces)
      meanings.contents.insert(piece.text);
  else if (what == "quality")
    read_qualities(pieces, meanings);
  else if (what == "value")
    read_values(pieces, meanings);
  else if (what == "look")
    read_look(pieces, meanings);
  else if (what == "relation")
    read_pairs(pieces, meanings.relations);
  else if (what == "surroundings")
    read_surroundings(pieces, meanings);
  else if (what == "addressee")
    meanings.addressee = pieces.front().text;
  else if (what == "action")
    read_pairs(pieces, meanings.actions);
  else if (what == "handling")
    for (const auto& piece : pieces)
      meanings.handling.insert(piece.text);
  else if (what == "reply")
    read_reply(pieces, meanings);
  else
    read_side(pieces, meanings);
}

} // namespace castor::communication
