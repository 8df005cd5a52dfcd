#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace castor {

/// Pseudo-subarchitecture of users and programs outside the system.
inline constexpr std::string_view operators = "operator";

/// The component that requests an operation. A restarted component is another client: it does not
/// hold the leases of its predecessor.
struct Client {
  std::string component;
  /// Empty for a component outside the subarchitectures, `operators` for a client outside the
  /// system.
  std::string subarchitecture;
  /// Number of the component's start.
  std::uint64_t incarnation = 0;

  friend bool operator==(const Client& a, const Client& b) {
    return a.component == b.component && a.incarnation == b.incarnation;
  }
};

/// Shared, because every operation names its client.
using ClientPtr = std::shared_ptr<const Client>;

/// Number that a client gives to an operation that may have to wait; never used twice.
using WaitNumber = std::uint64_t;

/// "segmentor of vision", or the name alone outside the subarchitectures; for messages.
inline std::string to_string(const Client& x) {
  bool is_outside = x.subarchitecture.empty() || x.subarchitecture == operators;
  return is_outside ? x.component : x.component + " of " + x.subarchitecture;
}

} // namespace castor
