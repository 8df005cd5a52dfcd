#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace castor {

/// Stands for people and programs outside of the system, where others have a subarchitecture.
inline constexpr std::string_view operators = "operator";

/// The component behind an operation. A component that is started again is another client: what its
/// predecessor held is not its own.
struct Client {
  std::string component;
  /// Empty for one outside the subarchitectures, `operators` for one outside the system.
  std::string subarchitecture;
  /// Which of the component's lives this is.
  std::uint64_t incarnation = 0;

  friend bool operator==(const Client& a, const Client& b) {
    return a.component == b.component && a.incarnation == b.incarnation;
  }
};

/// Every operation names its client, so they share one object.
using ClientPtr = std::shared_ptr<const Client>;

/// A client's own number for one of its operations that may have to wait; never used twice.
using WaitNumber = std::uint64_t;

/// "segmentor of vision", or the name alone outside the subarchitectures; for messages.
inline std::string to_string(const Client& x) {
  bool is_outside = x.subarchitecture.empty() || x.subarchitecture == operators;
  return is_outside ? x.component : x.component + " of " + x.subarchitecture;
}

} // namespace castor
