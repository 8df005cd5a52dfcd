#pragma once

#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace castor::binding {

/// What somebody says of a thing that is meant to be known already.
struct DescribedThing {
  std::vector<Feature> features;
};

/// Two described things, by their numbers: `from` is `label` of `to`.
struct DescribedRelation {
  std::string label;
  std::size_t from = 0;
  std::size_t to = 0;
};

/// "the red thing left of the ball": two things, one relation. The first thing is the one that is
/// asked for.
struct Description {
  std::vector<DescribedThing> things;
  std::vector<DescribedRelation> relations;
};

/// Which unions a description may be about.
struct Referents {
  /// One for each described thing, none twice.
  std::vector<std::string> unions;
  /// How many of the features described are neither confirmed nor denied; 0 if it is certain.
  std::uint32_t unknown = 0;

  friend bool operator==(const Referents&, const Referents&) = default;
};

/// A relation between two unions, as some relation proxy says.
struct UnionRelation {
  std::string label;
  std::string from;
  std::string to;

  friend auto operator<=>(const UnionRelation&, const UnionRelation&) = default;
};

/// The names of a relation's two ends.
inline constexpr const char* from_port = "from";
inline constexpr const char* to_port = "to";

/// All relations between unions whose proxies are bound; each once, ordered.
std::vector<UnionRelation> relations_between(const std::map<std::string, BindingUnion>& unions);

/// All ways to understand a description, the most certain first, then by the ids of the unions; at
/// most `limit`. Features that a union does not have may be true of it, those that it denies are
/// not. A relation holds only if a relation proxy says so: spatial relations are computed for all
/// that is seen.
///
/// \throws std::out_of_range if a relation is about a thing that is not described.
std::vector<Referents> find_referents(const Description& description,
                                      const std::map<std::string, BindingUnion>& unions,
                                      const FeatureComparator& comparator,
                                      std::size_t limit = 1000);

/// The unions that the first thing of a description may be, each with its most certain reading.
std::vector<Referents> distinct_referents(std::span<const Referents> all);

} // namespace castor::binding
