#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace castor {

/// Incremental CRC-32 of IEEE 802.3, as in zlib and MCAP.
class Crc32 {
public:
  void add(const void* data, std::size_t size);
  void add(std::span<const std::uint8_t> bytes) { add(bytes.data(), bytes.size()); }

  std::uint32_t value() const { return value_; }

private:
  std::uint32_t value_ = 0;
};

} // namespace castor
