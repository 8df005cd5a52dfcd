#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// Base64 by RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> in);

/// Decodes the result of `base64`; nothing for any other text.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

} // namespace castor
