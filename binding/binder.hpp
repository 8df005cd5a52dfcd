#pragma once

#include "castor/binding/binding_scorer.hpp"
#include "castor/binding/binding_view.hpp"
#include "castor/binding/types.hpp"

#include <map>
#include <set>
#include <span>
#include <string>

namespace castor::binding {

/// The union of these proxies, by binding order whatever order they are given in. Ports of the
/// members' relations are in `context`.
/// \pre there is at least one.
BindingUnion make_union(std::span<const ProxyRef> members, const RelationContext& context);

/// The proxy with what its union makes of it.
BindingProxy bound(BindingProxy proxy, const std::string& union_id, const BindingUnion& in);

/// What the binder is to write, all at once.
struct BindingPlan {
  /// New ones, and those with other members or other content.
  std::map<std::string, BindingUnion> unions;
  /// They have no one left.
  std::set<std::string> deleted_unions;
  /// Proxies whose union is another one, or has other members.
  std::map<std::string, BindingProxy> proxies;

  bool empty() const { return unions.empty() && deleted_unions.empty() && proxies.empty(); }
};

/// Puts each proxy where it is wanted. Who is not judged stays where it is, and so does who is
/// wanted in a union that does not exist: another judgement will come.
///
/// \param best the best union of each proxy that has been judged; empty for one of its own.
/// \param leaving proxies that are to be deleted.
BindingPlan plan_binding(const BindingView& view, const std::map<std::string, std::string>& best,
                         const std::set<std::string>& leaving = {});

} // namespace castor::binding
