#pragma once

#include "castor/binding/binding_scorer.hpp"
#include "castor/binding/types.hpp"

#include <span>
#include <string>

namespace castor::binding {

/// What the binder does about a judgement.
struct BinderStep {
  enum class Kind {
    /// A union of its own.
    create,
    /// It was in none.
    join,
    /// First into the new one, then out of the old one.
    move,
    /// What it says has changed in the union where it is.
    renew,
  };

  Kind kind = Kind::create;
  /// Where it leaves; empty if it was in none.
  std::string from;
  /// Where it comes.
  std::string to;
  /// The union that it leaves has no one left.
  bool delete_from = false;

  friend bool operator==(const BinderStep&, const BinderStep&) = default;
};

/// \param current the union that the proxy is in; nullptr if it is in none.
/// \param best empty for a union of its own.
BinderStep next_step(const ProxyRef& proxy, const std::string& current_id,
                     const BindingUnion* current, const std::string& best);

/// The union of these proxies, by binding order whatever order they are given in. Ports of the
/// members' relations are in `surroundings`.
/// \pre there is at least one.
BindingUnion make_union(std::span<const ProxyRef> members, const Surroundings& surroundings);

/// The proxy with what its union makes of it.
BindingProxy bound(BindingProxy proxy, const std::string& union_id, const BindingUnion& in);

} // namespace castor::binding
