#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace castor::cli {

/// Parses the value of a duration option; nothing for an empty text.
std::optional<std::chrono::milliseconds> duration(const std::string& text);

/// For CLI11's `check`: an error message, or empty if the text is a duration.
std::string check_duration(const std::string& text);

} // namespace castor::cli
