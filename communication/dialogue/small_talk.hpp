#pragma once

#include "castor/communication/parsing/word_meanings.hpp"
#include "castor/communication/types.hpp"

#include <string>

namespace castor::communication {

/// The reply to what is about the robot itself rather than about the scene: thanks, who it is, how
/// it is, what it can do. The form's root is of sort "small-talk".
std::string small_talk(const LogicalForm& form, const WordMeanings& meanings);

} // namespace castor::communication
