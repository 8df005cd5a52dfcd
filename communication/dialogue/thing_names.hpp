#pragma once

#include "castor/communication/parsing/parser.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// Whether the words name things and do not say where they are: "the red cubes", "everything".
bool names_things(Parser& parser, const std::vector<std::string>& said);

/// The words as they name things, with an article if one is missing: "the ball" for "ball". Nothing
/// if they name none, or are a pronoun.
std::optional<std::vector<std::string>> name_of_things(Parser& parser,
                                                       const std::vector<std::string>& said);

/// With the articles that are missing after verbs of requests, and after words that begin a place:
/// "take the cylinder and put it on the red cube" for "take cylinder and put it on red cube".
/// Nothing if none is missing.
std::optional<std::vector<std::string>> with_articles(Parser& parser,
                                                      const std::vector<std::string>& words);

} // namespace castor::communication
