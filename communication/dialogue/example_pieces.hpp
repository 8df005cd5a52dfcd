#pragma once

#include "castor/communication/parsing/example_features.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

/// The words of an utterance as the lexicon's examples have them: words that name things are one
/// piece, with an article.
std::vector<ExamplePiece> example_pieces(Parser& parser, const std::vector<std::string>& words);

/// "Red, green and blue" as what is named once.
std::vector<ExamplePiece> with_lists(const std::vector<ExamplePiece>& pieces);

/// With "everything" and pronouns as words.
std::vector<ExamplePiece> with_words_for_all(const std::vector<ExamplePiece>& pieces);

/// "It", "them".
bool stands_for_things(std::string_view word);

/// What any thing may be called: "thing", "everything".
bool is_general_name(std::string_view word);

/// "And", between what names things.
bool joins_names(const ExamplePiece& piece);

} // namespace castor::communication
