#pragma once

#include "castor/communication/types.hpp"

namespace castor::communication {

/// What is done by saying this, as its mood and its kind have it: "can you see the ball" asks, even
/// if it means to request. Nothing for what is no sentence, such as "the red ball".
DialogueMoveType dialogue_move_type(const LogicalForm& form);

} // namespace castor::communication
