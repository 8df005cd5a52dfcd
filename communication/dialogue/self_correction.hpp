#pragma once

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// What is meant by a request that corrects itself at its end, by a thing of the same noun as one
/// that it has named before its last: "put the red cube behind the cylinder, no, I mean the green
/// cube" puts the green cube there. Nothing if it corrects nothing, or its last phrase.
std::optional<std::vector<std::string>> self_corrected(const std::vector<std::string>& words);

} // namespace castor::communication
