#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace castor::cli {

/// What a user wrote behind an option; nothing for an empty text.
std::optional<std::chrono::milliseconds> duration(const std::string& text);

/// For CLI11's `check`: what is wrong with it, if anything is.
std::string check_duration(const std::string& text);

} // namespace castor::cli
