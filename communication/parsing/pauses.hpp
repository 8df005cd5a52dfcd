#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// The form of an utterance in which somebody has left a pause out: "the ball what colour is it".
/// Nothing if it has one part, more than two, or is not understood with a pause either.
///
/// \param form of the words as they stand
std::optional<PackedLogicalForm> parsed_with_pause(Parser& parser, std::vector<std::string> words,
                                                   const PackedLogicalForm& form);

} // namespace castor::communication
