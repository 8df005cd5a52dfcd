#pragma once

#include "castor/wm/values/reflect.hpp"

#include <compare>
#include <cstddef>
#include <functional>
#include <string>

namespace castor {

/// Address of an entry: the subarchitecture whose working memory holds it, and its id there.
struct Address {
  std::string subarchitecture;
  std::string id;

  friend auto operator<=>(const Address&, const Address&) = default;
};

CASTOR_REFLECT(Address, subarchitecture, id)

/// "vision/0:3", as users read and write it; "vision" for a whole working memory.
inline std::string to_string(const Address& x) {
  return x.id.empty() ? x.subarchitecture : x.subarchitecture + '/' + x.id;
}

} // namespace castor

template <>
struct std::hash<castor::Address> {
  std::size_t operator()(const castor::Address& x) const noexcept {
    auto h = std::hash<std::string>{};
    return h(x.id) * 31 + h(x.subarchitecture);
  }
};
