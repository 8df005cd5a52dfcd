#pragma once

#include "castor/binding/types.hpp"

#include <compare>
#include <cstdint>
#include <string>
#include <tuple>

namespace castor::binding {

/// The order in which proxies are bound, whatever the order in which they came: relations after
/// what they relate, then by precedence, then by id. Each proxy looks only at those before it. So
/// what becomes of it follows from what became of them, and of all of them together from who they
/// are.
struct BindingRank {
  bool relation = false;
  std::int32_t precedence = 0;
  std::string id;

  friend auto operator<=>(const BindingRank&, const BindingRank&) = default;
};

inline BindingRank rank_of(const std::string& id, const BindingProxy& proxy) {
  return {proxy.type == ProxyType::relation, proxy.precedence, id};
}

/// The same order, of proxies where they are.
inline bool precedes(const std::string& id, const BindingProxy& proxy, const std::string& other_id,
                     const BindingProxy& other) {
  const bool relates = proxy.type == ProxyType::relation;
  const bool other_relates = other.type == ProxyType::relation;
  return std::tie(relates, proxy.precedence, id) <
         std::tie(other_relates, other.precedence, other_id);
}

/// The id of the union whose first member this is.
inline std::string union_id_of(const std::string& first_member) {
  return "union of " + first_member;
}

} // namespace castor::binding
