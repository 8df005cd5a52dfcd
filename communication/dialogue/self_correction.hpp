#pragma once

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// What is meant by a request that corrects a thing or a side of itself: "take the cylinder, no,
/// sorry, the ball, and put it on the left" takes the ball. The thing that is named after the sign
/// takes the place of the only one of its noun that was named before it, "put the red cube behind
/// the disc, no, I mean the green cube", or else of the last one. Nothing if it corrects nothing.
std::optional<std::vector<std::string>> self_corrected(const std::vector<std::string>& words);

} // namespace castor::communication
