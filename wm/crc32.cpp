#include "castor/wm/crc32.hpp"

#include <array>
#include <cstring>

namespace castor {

namespace {

using Table = std::array<std::array<std::uint32_t, 256>, 8>;

/// Of eight bytes at once, what each contributes.
constexpr Table make_table() {
  constexpr std::uint32_t polynomial = 0xEDB88320;
  Table result{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    auto x = i;
    for (int bit = 0; bit < 8; ++bit)
      x = (x >> 1) ^ ((x & 1) != 0 ? polynomial : 0);
    result[0][i] = x;
  }
  for (std::size_t i = 0; i < 256; ++i)
    for (std::size_t k = 1; k < 8; ++k)
      result[k][i] = (result[k - 1][i] >> 8) ^ result[0][result[k - 1][i] & 0xFF];
  return result;
}

constexpr Table table = make_table();

} // namespace

void Crc32::add(std::span<const std::uint8_t> bytes) {
  auto x = state_;
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::memcpy(&low, bytes.data(), 4);
    std::memcpy(&high, bytes.data() + 4, 4);
    low ^= x;
    x = table[7][low & 0xFF] ^ table[6][low >> 8 & 0xFF] ^ table[5][low >> 16 & 0xFF] ^
        table[4][low >> 24] ^ table[3][high & 0xFF] ^ table[2][high >> 8 & 0xFF] ^
        table[1][high >> 16 & 0xFF] ^ table[0][high >> 24];
  }
  for (auto byte : bytes)
    x = (x >> 8) ^ table[0][(x ^ byte) & 0xFF];
  state_ = x;
}

} // namespace castor
