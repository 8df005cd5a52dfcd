#include "castor/communication/dialogue/thing_names.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/utterance_parts.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/word_lists.hpp"

namespace castor::communication {

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
