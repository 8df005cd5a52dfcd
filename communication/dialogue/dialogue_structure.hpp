#pragma once

#include "castor/communication/types.hpp"

#include <span>

namespace castor::communication {

/// Finds the earlier turn to which a human's turn is related, and the relation: a reply to "which
/// ball do you mean?" clarifies the earlier question, "yes" and "no" accept or reject the last
/// statement.
///
/// \returns the turn with `relation` and `to`
DialogueTurn connected(DialogueTurn turn, std::span<const DialogueTurn> before);

} // namespace castor::communication
