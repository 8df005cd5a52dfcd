#include "castor/tools/chaos/rounded.hpp"

#include <fmt/core.h>

#include <cmath>

namespace castor::faults {

std::string rounded(Timestamp x) {
  auto us = static_cast<double>(x.count());
  auto size = std::abs(us);
  if (size < 999.5)
    return fmt::format("{:.3g} us", us);
  if (size < 999.5e3)
    return fmt::format("{:.3g} ms", us / 1e3);
  if (size < 999.5e6)
    return fmt::format("{:.3g} s", us / 1e6);
  return fmt::format("{:.0f} s", us / 1e6);
}

std::string counted(std::size_t n, std::string_view one, std::string_view several) {
  return fmt::format("{} {}", n, n == 1 ? one : several);
}

} // namespace castor::faults
