#pragma once

#include "castor/communication/types.hpp"

#include <span>
#include <string>

namespace castor::communication {

/// The proxy of what a pronoun stands for: of all that was spoken of, what is most salient and what
/// the pronoun may be about, "they" only about several. Salient is what was spoken of last; within
/// one move, what it was about first. Empty if there is nothing.
///
/// \param history in any order
std::string antecedent_of(const Nominal& pronoun, std::span<const MoveReferents> history);

} // namespace castor::communication
