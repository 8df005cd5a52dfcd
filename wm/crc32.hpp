#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace castor {

/// The CRC-32 of IEEE 802.3, as zlib and MCAP have it, of bytes that come piece by piece.
class Crc32 {
public:
  void add(std::span<const std::uint8_t> bytes);
  void add(const void* data, std::size_t size) {
    add({static_cast<const std::uint8_t*>(data), size});
  }

  std::uint32_t value() const { return ~state_; }

private:
  std::uint32_t state_ = 0xFFFFFFFF;
};

} // namespace castor
