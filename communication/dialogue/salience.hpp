#pragma once

#include "castor/communication/types.hpp"

#include <span>
#include <string>

namespace castor::communication {

/// The proxy of a pronoun's referent: the most salient referent in the history that the pronoun can
/// stand for ("they" only for several). The most recent move is the most salient; within a move,
/// its first referent. Empty if there is none.
///
/// \param history in any order
std::string antecedent_of(const Nominal& pronoun, std::span<const MoveReferents> history);

} // namespace castor::communication
