#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// What says the same by the lexicon's paraphrases, each of which is applied as often as it fits,
/// in the order of the lexicon; nothing if none fits.
///
/// \param is_understood whether the words are understood: then only replacements are made
std::optional<std::vector<std::string>> paraphrased(std::vector<std::string> words,
                                                    const Lexicon& lexicon, bool is_understood);

/// The form of an utterance that is not understood as it stands: with a pause that was left out,
/// without asides, or in other words that say the same. Nothing if it is understood, or none of it
/// helps.
///
/// \param form of the words as they stand
std::optional<PackedLogicalForm> reparsed(Parser& parser, const std::vector<std::string>& words,
                                          const PackedLogicalForm& form);

} // namespace castor::communication
