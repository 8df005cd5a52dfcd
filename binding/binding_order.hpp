#pragma once

#include "castor/binding/types.hpp"

#include <compare>
#include <cstdint>
#include <string>
#include <tuple>

namespace castor::binding {

/// The order in which proxies are bound, independent of the order of their arrival: relations after
/// what they relate, then by precedence, then by id. A proxy is judged only by those before it, so
/// the result depends only on the set of proxies.
struct BindingRank {
  bool relation = false;
  std::int32_t precedence = 0;
  std::string id;

  friend auto operator<=>(const BindingRank&, const BindingRank&) = default;
};

inline BindingRank rank_of(const std::string& id, const BindingProxy& proxy) {
  return {proxy.type == ProxyType::relation, proxy.precedence, id};
}

/// The same order, without copies of the ids.
inline bool precedes(const std::string& id, const BindingProxy& proxy, const std::string& other_id,
                     const BindingProxy& other) {
  const bool relates = proxy.type == ProxyType::relation;
  const bool other_relates = other.type == ProxyType::relation;
  return std::tie(relates, proxy.precedence, id) <
         std::tie(other_relates, other.precedence, other_id);
}

/// Id of the union with this first member.
inline std::string union_id_of(const std::string& first_member) {
  return "union of " + first_member;
}

} // namespace castor::binding
