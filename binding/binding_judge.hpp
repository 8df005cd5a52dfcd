#pragma once

#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"

#include <span>
#include <string>

namespace castor::binding {

/// The best scores of one proxy that strictly beat NIL; equal ones in the order of their salience,
/// then of the ids of the unions. The scores need not be ordered, nor contain NIL; unions that do
/// not match may be left out.
BestUnionsForProxy judge(const std::string& proxy, std::span<const ProxyUnionScore> scores);

/// Whether the first of the best unions is no better than the second, salience included.
bool is_ambiguous(const BestUnionsForProxy& best, std::span<const ProxyUnionScore> scores);

/// The kinds of features missing in the proxy or in the unions that would distinguish the unions.
Ambiguity describe_ambiguity(const BestUnionsForProxy& best, const BindingProxy& proxy,
                             std::span<const BindingUnion* const> unions,
                             const FeatureComparator& comparator);

} // namespace castor::binding
