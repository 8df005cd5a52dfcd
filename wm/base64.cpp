#include "castor/wm/base64.hpp"

namespace castor {

std::string base64(std::span<const std::uint8_t> in) {
  static constexpr char digits[] =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
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

} // namespace castor
