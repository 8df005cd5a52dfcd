#pragma once

#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace castor::binding {

/// All relations between unions, from their bound relation proxies; distinct and sorted.
std::vector<UnionRelation> relations_between(const std::map<std::string, BindingUnion>& unions);

/// All readings of a description, the most certain first, then by the ids of the unions; at most
/// `limit`. A feature that a union lacks may be true of it; one that it denies is not. A thing
/// described by a proxy (`existing_proxy_id`) is the union of that proxy. A relation holds only if
/// there is a relation proxy for it: spatial relations are computed for everything that is
/// perceived.
///
/// \throws std::out_of_range if a relation is about a thing that is not described.
std::vector<Referents> find_referents(const Description& description,
                                      const std::map<std::string, BindingUnion>& unions,
                                      const FeatureComparator& comparator,
                                      std::size_t limit = 1000);

/// The same with the relations that hold, sorted.
std::vector<Referents> find_referents(const Description& description,
                                      const std::map<std::string, BindingUnion>& unions,
                                      const FeatureComparator& comparator,
                                      const std::vector<UnionRelation>& relations,
                                      std::size_t limit);

/// The possible unions of the first thing of a description, each with its most certain reading.
std::vector<Referents> distinct_referents(std::span<const Referents> all);

} // namespace castor::binding
