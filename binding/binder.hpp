#pragma once

#include "castor/binding/binding_scorer.hpp"
#include "castor/binding/binding_view.hpp"
#include "castor/binding/types.hpp"

#include <map>
#include <set>
#include <span>
#include <string>

namespace castor::binding {

/// The union of these proxies, in binding order. Ports of the members' relations are in `context`.
/// \param members in any order
/// \pre there is at least one.
BindingUnion make_union(std::span<const ProxyRef> members, const RelationContext& context);

/// The proxy with the fields that the binder sets from its union.
BindingProxy bound(BindingProxy proxy, const std::string& union_id, const BindingUnion& in);

/// The binder's writes, to be made in one batch.
struct BindingPlan {
  /// New and changed unions.
  std::map<std::string, BindingUnion> unions;
  /// Unions without members.
  std::set<std::string> deleted_unions;
  /// Proxies whose union is another one, or has other members.
  std::map<std::string, BindingProxy> proxies;

  bool empty() const { return unions.empty() && deleted_unions.empty() && proxies.empty(); }
};

/// Moves each proxy into its best union. A proxy stays where it is if it has not been judged, or if
/// its best union does not exist: another judgement will follow.
///
/// \param best the best union of each proxy that has been judged; empty for one of its own.
/// \param leaving proxies that are to be deleted.
BindingPlan plan_binding(const BindingView& view, const std::map<std::string, std::string>& best,
                         const std::set<std::string>& leaving = {});

} // namespace castor::binding
