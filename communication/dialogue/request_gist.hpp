#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// The request that the things and places of an utterance make with its verb, where the utterance
/// is not understood: "shift the cube so it sits left of the ball" is "shift the cube left of the
/// ball", "to the left of the ball, place the cube" is "place the cube to the left of the ball",
/// and with a verb that is not known something is put where a place is said: "haul the ball over to
/// the right". The form is `partial`: it is only done if the speaker agrees.
///
/// Only words that say nothing of a thing or a place are left out, and parts that say why or from
/// where. Nothing for questions, negations, conditions and exceptions.
std::optional<PackedLogicalForm> request_gist(Parser& parser,
                                              const std::vector<std::string>& words);

} // namespace castor::communication
