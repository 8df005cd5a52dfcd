#pragma once

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// A question about what the robot has done so far, however it is asked, in words of the lexicon:
/// "and how many of them were shifted up to now" is "which things have you moved"; nothing if the
/// words ask for something else.
std::optional<std::vector<std::string>> question_about_moves(const std::vector<std::string>& words);

} // namespace castor::communication
