#include "castor/tests/communication/reply_reader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace castor::communication::test {

namespace {

using ReplyKind = ReadReply::Kind;
using Words = std::vector<std::string>;

constexpr std::array numbers{"zero", "one",   "two",   "three", "four", "five",
                             "six",  "seven", "eight", "nine",  "ten"};
constexpr std::array colours{"red",    "blue",   "green", "yellow", "grey", "pink",
                             "orange", "purple", "brown", "black",  "white"};
constexpr std::array sizes{"small", "large"};
constexpr std::array shapes{"cube",   "ball",     "cylinder", "pyramid", "sphere",
                            "circle", "triangle", "disc",     "square",  "rectangle"};

template <class T>
bool is_in(const T& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::optional<std::size_t> number_of(const std::string& word) {
  const auto found = std::find(numbers.begin(), numbers.end(), word);
  if (found == numbers.end())
    return std::nullopt;
  return static_cast<std::size_t>(found - numbers.begin());
}

std::vector<Words> sentences_in(std::string_view text) {
  std::vector<Words> result(1);
  std::string word;
  auto end_word = [&] {
    if (!word.empty())
      result.back().push_back(word);
    word.clear();
  };
  for (char c : text) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else
      end_word();
    if ((c == '.' || c == '?') && !result.back().empty())
      result.emplace_back();
  }
  end_word();
  if (result.back().empty())
    result.pop_back();
  return result;
}

bool begins_with(const Words& words, std::size_t at, std::initializer_list<const char*> with) {
  if (words.size() < at + with.size())
    return false;
  return std::equal(with.begin(), with.end(), words.begin() + static_cast<std::ptrdiff_t>(at));
}

std::string shape_of(const std::string& noun) {
  return noun == "sphere" ? "ball" : noun == "circle" ? "disc" : noun;
}

bool is_indefinite_article(const std::string& word) {
  return word == "a" || word == "an";
}

/// The adjectives and the noun after an article.
ReadReply::Described description(const Words& words, std::size_t at) {
  ReadReply::Described result;
  for (; at < words.size(); ++at) {
    auto& word = words[at];
    if (is_in(colours, word))
      result.colour = word;
    else if (is_in(sizes, word))
      result.size = word;
    else {
      if (is_in(shapes, word))
        result.shape = shape_of(word);
      break;
    }
  }
  return result;
}

void read_existence(const Words& words, std::size_t at, ReadReply& reply) {
  if (begins_with(words, at, {"at", "least"})) {
    reply.is_at_least = true;
    at += 2;
  }
  if (at >= words.size())
    return;
  if (auto number = number_of(words[at]))
    reply.number = number;
  else if (words[at] == "no" || words[at] == "nothing")
    reply.number = 0;
  else
    for (; at < words.size(); ++at)
      if (is_indefinite_article(words[at]))
        reply.described.push_back(description(words, at + 1));
}

void read_ascription(const Words& words, std::size_t at, ReadReply& reply) {
  if (at < words.size() && words[at] == "not") {
    reply.is_denied = true;
    ++at;
  }
  // "It is the red ball", as "there is a red ball".
  if (at < words.size() && words[at] == "the")
    reply.is_existence = true;
  if (at < words.size() && (is_indefinite_article(words[at]) || words[at] == "the")) {
    reply.described.push_back(description(words, at + 1));
    ++at;
  }
  for (; at < words.size(); ++at) {
    if (!is_in(colours, words[at]) && !is_in(sizes, words[at]) && !is_in(shapes, words[at]))
      break;
    reply.ascribed.push_back(shape_of(words[at]));
  }
}

void read_values(const Words& words, ReadReply& reply) {
  auto verb = std::ranges::find_if(words, [](auto& x) { return x == "is" || x == "are"; });
  for (; verb != words.end(); ++verb) {
    if (is_in(colours, *verb))
      reply.colours.push_back(*verb);
    if (is_in(sizes, *verb))
      reply.sizes.push_back(*verb);
    for (auto noun : {*verb, verb->ends_with('s') ? verb->substr(0, verb->size() - 1) : *verb})
      if (is_in(shapes, noun)) {
        reply.shapes.push_back(shape_of(noun));
        break;
      }
  }
}

void read_mentions(const Words& words, ReadReply& reply) {
  for (std::size_t at = 0; at < words.size(); ++at)
    if (is_indefinite_article(words[at]) || words[at] == "the") {
      auto noun = at + 1;
      while (noun < words.size() && (is_in(colours, words[noun]) || is_in(sizes, words[noun])))
        ++noun;
      if (noun < words.size() && (is_in(shapes, words[noun]) || words[noun] == "thing"))
        reply.mentioned.push_back(description(words, at + 1));
    }
}

void read_sentence(const Words& words, std::size_t at, ReadReply& reply) {
  if (begins_with(words, at, {"there", "is"}) || begins_with(words, at, {"there", "are"}))
    read_existence(words, at + 2, reply);
  else if (begins_with(words, at, {"it", "is"}))
    read_ascription(words, at + 2, reply);
  read_values(words, reply);
  read_mentions(words, reply);
}

} // namespace

ReadReply read_reply(std::string_view text) {
  ReadReply reply;
  const auto has = [&text](std::string_view what) {
    return text.find(what) != std::string_view::npos;
  };
  if (has("<no words>"))
    return reply;
  if (has("I do not understand") || has("means here") || has("I do not know the word") ||
      has("What about it") || has("what that is about") || has("for '")) {
    reply.kind = ReplyKind::not_understood;
    return reply;
  }
  const auto sentences = sentences_in(text);
  if (sentences.empty())
    return reply;
  auto& first = sentences.front();
  if (begins_with(first, 0, {"yes"}))
    reply.kind = ReplyKind::yes;
  else if (begins_with(first, 0, {"no"}))
    reply.kind = ReplyKind::no;
  else if (begins_with(first, 0, {"ok"}))
    reply.kind = ReplyKind::accepted;
  else if (begins_with(first, 0, {"i", "do", "not", "know"}))
    reply.kind = ReplyKind::unknown;
  else if (begins_with(first, 0, {"i", "do", "not", "see"}))
    reply.kind = ReplyKind::not_seen;
  else if (begins_with(first, 0, {"which"}))
    reply.kind = ReplyKind::asked_back;
  else if (begins_with(first, 0, {"there"}) || begins_with(first, 0, {"it"}))
    reply.kind = ReplyKind::statement;
  else if (begins_with(first, 0, {"the"}) || begins_with(first, 0, {"both"}) ||
           begins_with(first, 0, {"they"}))
    reply.kind = ReplyKind::statement;
  else if (number_of(first.front())) {
    // "Two of the three cubes are red."
    reply.kind = ReplyKind::statement;
    reply.number = number_of(first.front());
  }
  reply.is_existence = begins_with(first, 0, {"there"});
  const bool has_marker = reply.kind == ReplyKind::yes || reply.kind == ReplyKind::no;
  for (auto& words : sentences)
    read_sentence(words, &words == &first && has_marker ? 1 : 0, reply);
  return reply;
}

} // namespace castor::communication::test
