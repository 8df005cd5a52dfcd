#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// The words of an utterance without what is said around its question or statement: "forgive me for
/// asking, ...", "I would be grateful to know ...", "..., my dear". Words that say something of
/// the scene, exclude something or set a condition are kept, and so is the part that they are in.
/// Nothing if no part is left out.
///
/// \param words in the form returned by words_of()
std::optional<std::vector<std::string>> without_chatter(const std::vector<std::string>& words,
                                                        const Lexicon& lexicon);

/// The form of an utterance that is not understood as it stands: with a pause where one was left
/// out, or without chatter. Nothing if it is not understood in these ways either, or is understood
/// as it stands.
///
/// \param form of the words as they stand
std::optional<PackedLogicalForm> parsed_otherwise(Parser& parser,
                                                  const std::vector<std::string>& words,
                                                  const PackedLogicalForm& form);

} // namespace castor::communication
