#pragma once

#include "castor/communication/types.hpp"

namespace castor::communication {

/// The dialogue move of a logical form, by its mood and kind: "can you see the ball" is a question,
/// even if meant as a request. `none` for fragments such as "the red ball".
DialogueMoveType dialogue_move_type(const LogicalForm& form);

} // namespace castor::communication
