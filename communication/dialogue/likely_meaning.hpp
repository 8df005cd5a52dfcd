#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// What an utterance means that is not understood but much like the lexicon's examples of one
/// meaning: "blue ball belongs on the cube's left" is "put the blue ball to the left of the cube".
/// The form has a correction, so that it is said back what the utterance was taken for.
std::optional<PackedLogicalForm> likely_meaning(Parser& parser,
                                                const std::vector<std::string>& words);

/// The same for an utterance that is less like them. The form of a request is `partial`: it is only
/// done if the speaker agrees.
std::optional<PackedLogicalForm> possible_meaning(Parser& parser,
                                                  const std::vector<std::string>& words);

} // namespace castor::communication
