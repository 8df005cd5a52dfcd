#include "castor/communication/dialogue/thing_names.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>

namespace castor::communication {

namespace {

/// In words: "small green cube".
constexpr std::size_t longest_bare_name = 3;

/// Words after which an article is likelier missing than that the next word is no noun.
bool may_stand_before_article(const std::string& word, const Lexicon& lexicon) {
  return is_handling_verb(word, lexicon) ||
         is_among(word, {"to", "on", "onto", "beside", "behind", "near", "of", "between", "and",
                         "from", "off", "under", "by", ",", "then"});
}

/// Of one thing, without an article.
bool is_bare_name(Parser& parser, const std::vector<std::string>& said) {
  if (is_among(said.front(), {"one", "two", "the", "a", "it"}) || is_among(said.back(), {"one"}))
    return false;
  auto definite = said;
  definite.insert(definite.begin(), "the");
  auto indefinite = said;
  indefinite.insert(indefinite.begin(), "a");
  return names_things(parser, definite) && names_things(parser, indefinite);
}

} // namespace

std::optional<std::vector<std::string>> with_articles(Parser& parser,
                                                      const std::vector<std::string>& words) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i == 0 || may_stand_before_article(words[i - 1], parser.lexicon()))
      for (auto length = std::min(longest_bare_name, words.size() - i); length > 0; --length)
        if (is_bare_name(parser, words_between(words, i, i + length))) {
          result.emplace_back("the");
          break;
        }
    result.push_back(words[i]);
  }
  return result.size() > words.size() ? std::optional{std::move(result)} : std::nullopt;
}

/// Where they are, the grammar adds: "put the ball on the left" has no ball that is there.
bool names_things(Parser& parser, const std::vector<std::string>& said) {
  const auto form = parser.parse_whole(said);
  const auto thing = form ? thing_said(*form) : std::nullopt;
  return thing && dependent(*thing, *find_nominal(*thing, thing->root), "Location") == nullptr;
}

std::optional<std::vector<std::string>> name_of_things(Parser& parser,
                                                       const std::vector<std::string>& said) {
  // "The zorgish one" is not any.
  if (said.size() == 1 &&
      is_among(said.front(), {"it", "them", "this", "that", "these", "those", "one", "ones"}))
    return std::nullopt;
  if (names_things(parser, said))
    return said;
  auto with_article = said;
  with_article.insert(with_article.begin(), "the");
  return names_things(parser, with_article) ? std::optional{std::move(with_article)} : std::nullopt;
}

} // namespace castor::communication
