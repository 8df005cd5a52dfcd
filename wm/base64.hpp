#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace castor {

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> in);

} // namespace castor
