#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace castor {

/// The CRC-32 of IEEE 802.3, as zlib and MCAP have it, of bytes that come piece by piece.
class Crc32 {
public:
  void add(const void* data, std::size_t size);
  void add(std::span<const std::uint8_t> bytes) { add(bytes.data(), bytes.size()); }

  std::uint32_t value() const { return value_; }

private:
  std::uint32_t value_ = 0;
};

} // namespace castor
