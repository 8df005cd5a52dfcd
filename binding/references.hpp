#pragma once

#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace castor::binding {

/// All relations between unions whose proxies are bound; each once, ordered.
std::vector<UnionRelation> relations_between(const std::map<std::string, BindingUnion>& unions);

/// All ways to understand a description, the most certain first, then by the ids of the unions; at
/// most `limit`. Features that a union does not have may be true of it, those that it denies are
/// not. What is described by one of its proxies (`existing_proxy_id`) is that very union. A
/// relation holds only if a relation proxy says so: spatial relations are computed for all that is
/// seen.
///
/// \throws std::out_of_range if a relation is about a thing that is not described.
std::vector<Referents> find_referents(const Description& description,
                                      const std::map<std::string, BindingUnion>& unions,
                                      const FeatureComparator& comparator,
                                      std::size_t limit = 1000);

/// The unions that the first thing of a description may be, each with its most certain reading.
std::vector<Referents> distinct_referents(std::span<const Referents> all);

} // namespace castor::binding
