#pragma once

#include "castor/communication/types.hpp"

#include <span>

namespace castor::communication {

/// How what a human does is connected with what was said before: who is asked which ball is meant
/// clarifies what was asked before, and who says "yes" or "no" accepts or rejects what was said.
///
/// \returns the turn with `relation` and `to`
DialogueTurn connected(DialogueTurn turn, std::span<const DialogueTurn> before);

} // namespace castor::communication
