#include "castor/communication/dialogue/example_pieces.hpp"

#include "castor/communication/dialogue/thing_names.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace castor::communication {

namespace {

using WordList = std::vector<std::string>;
using Pieces = std::vector<ExamplePiece>;

/// In words: what names things.
constexpr std::size_t longest_name = 6;

/// Each an article and one word at most.
bool are_short(const ExamplePiece& a, const ExamplePiece& b) {
  return a.words.size() <= 2 && b.words.size() <= 2;
}

class PieceReader {
public:
  PieceReader(Parser& parser, const WordList& words) : parser_(parser), words_(words) {}

  Pieces read() {
    Pieces result;
    for (std::size_t i = 0; i < words_.size();) {
      auto [piece, length] = piece_at(i);
      result.push_back(std::move(piece));
      i += length;
    }
    return result;
  }

private:
  const Lexicon& lexicon() const { return parser_.lexicon(); }

  /// And how many words it has.
  std::pair<ExamplePiece, std::size_t> piece_at(std::size_t begin) {
    const auto& first = words_[begin];
    const std::pair word{ExamplePiece{{first}, false}, std::size_t{1}};
    if (stands_for_things(first)) {
      const bool is_of_all = begin + 1 < words_.size() && words_[begin + 1] == "all";
      return {{{first == "they" ? "them" : first}, true}, is_of_all ? 2U : 1U};
    }
    const bool is_asked_for =
      begin > 0 && is_among(words_[begin - 1], {"which", "what", "how", "many", "whose"});
    if (is_asked_for || is_handling_verb(first, lexicon()))
      return word;
    for (auto length = std::min(longest_name, words_.size() - begin); length > 0; --length) {
      const auto said = words_between(words_, begin, begin + length);
      if (!may_name_things(said))
        continue;
      if (auto name = name_in(said))
        return {{std::move(*name), true}, length};
    }
    return word;
  }

  /// "The blue ball" for "blue ball", and for "ball blue".
  std::optional<WordList> name_in(const WordList& said) {
    if (said.size() == 1 && is_among(said.front(), {"one", "ones"}))
      return std::nullopt;
    auto with_article = said;
    with_article.insert(with_article.begin(), "the");
    if (names_things(parser_, with_article))
      return with_article;
    const bool has_article = is_among(said.front(), {"the", "a", "this", "that"});
    if (said.size() == (has_article ? 3 : 2)) {
      const auto& noun = said[said.size() - 2];
      const WordList turned{"the", said.back(), noun};
      if (!lexicon().examples().has_common_word(noun) && names_things(parser_, turned))
        return turned;
    }
    return names_things(parser_, said) ? std::optional{said} : std::nullopt;
  }

  /// Its last word does, and no word says what is to be done.
  bool may_name_things(const WordList& said) {
    if (says_nothing(said.front()) ||
        (number_of_word(said.back()) && !is_general_name(said.back())) ||
        std::isdigit(static_cast<unsigned char>(said.back().front())) != 0 ||
        std::ranges::find(said, ",") != said.end())
      return false;
    // "A circle of things" is what they are to make.
    const auto of = std::ranges::find(said, "of");
    if (of != said.end() && of != said.begin() &&
        lexicon().examples().has_common_word(*std::prev(of)) && !is_general_name(*std::prev(of)))
      return false;
    const auto& last = said.back();
    if (lexicon().examples().has_common_word(last) && !is_general_name(last))
      return false;
    const auto known = names_.find(last);
    return known != names_.end()
             ? known->second
             : names_.emplace(last, is_general_name(last) || name_of_things(parser_, {last}))
                 .first->second;
  }

  /// Such as "then", or "to" of "give to me".
  bool says_nothing(const std::string& word) const {
    return lexicon().filler(word) != nullptr || lexicon().is_in(WordClass::aside, word) ||
           is_among(word, {"and", "or", "of", "to", "for", "from", "with", "on", "in", "at", "by"});
  }

  Parser& parser_;
  const WordList& words_;
  /// Whether a word may be the last one of what names things.
  std::map<std::string, bool> names_;
};

} // namespace

bool stands_for_things(std::string_view word) {
  return is_among(word, {"it", "them", "they", "these", "those"});
}

bool is_general_name(std::string_view word) {
  return is_among(word, {"thing", "things", "object", "objects", "item", "items", "one", "ones",
                         "everything", "stuff"});
}

bool joins_names(const ExamplePiece& piece) {
  return !piece.names_things && is_among(piece.words.front(), {",", "and", "then"});
}

Pieces example_pieces(Parser& parser, const WordList& words) {
  return PieceReader{parser, words}.read();
}

Pieces with_lists(const Pieces& pieces) {
  Pieces result;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    auto next = i;
    while (next < pieces.size() && joins_names(pieces[next]))
      ++next;
    // "Purple red yellow" are several, a "cube square" is one that stands square.
    const bool is_joined = next > i || (i > 0 && are_short(pieces[i - 1], pieces[i]));
    const bool goes_on = !result.empty() && result.back().names_things && next < pieces.size() &&
                         pieces[next].names_things && is_joined;
    if (!goes_on) {
      result.push_back(pieces[i]);
      continue;
    }
    const bool is_last = std::none_of(pieces.begin() + static_cast<std::ptrdiff_t>(next) + 1,
                                      pieces.end(), [](const auto& x) { return x.names_things; });
    auto& list = result.back().words;
    list.emplace_back(is_last ? "and" : ",");
    list.insert(list.end(), pieces[next].words.begin(), pieces[next].words.end());
    i = next;
  }
  return result;
}

Pieces with_words_for_all(const Pieces& pieces) {
  Pieces result;
  for (const auto& piece : pieces)
    if (piece.names_things &&
        (stands_for_things(piece.words.front()) || is_general_name(piece.words.back())))
      for (const auto& word : piece.words)
        result.push_back({{word}, false});
    else
      result.push_back(piece);
  return result;
}

} // namespace castor::communication
