#include "castor/wm/values/base64.hpp"

namespace castor {

namespace {

constexpr std::string_view digits =
  "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

} // namespace

std::string base64(std::span<const std::uint8_t> in) {
  std::string out;
  out.reserve((in.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < in.size(); i += 3) {
    std::uint32_t group = static_cast<std::uint32_t>(in[i]) << 16;
    if (i + 1 < in.size())
      group |= static_cast<std::uint32_t>(in[i + 1]) << 8;
    if (i + 2 < in.size())
      group |= in[i + 2];
    out += digits[group >> 18 & 63];
    out += digits[group >> 12 & 63];
    out += i + 1 < in.size() ? digits[group >> 6 & 63] : '=';
    out += i + 2 < in.size() ? digits[group & 63] : '=';
  }
  return out;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  std::vector<std::uint8_t> out;
  if (text.size() % 4 != 0)
    return std::nullopt;
  std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
  text.remove_suffix(padding);
  std::uint32_t bits = 0;
  unsigned count = 0;
  for (char c : text) {
    auto digit = digits.find(c);
    if (digit == digits.npos)
      return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out.push_back(static_cast<std::uint8_t>(bits >> count));
    }
  }
  // Bits of the last digit that stand for nothing have to be zero.
  if ((bits & ((1U << count) - 1)) != 0)
    return std::nullopt;
  return out;
}

} // namespace castor
