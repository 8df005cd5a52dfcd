#pragma once

#include "castor/binding/types.hpp"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>

/// Access to features and their kinds.
namespace castor::binding {

/// The first feature of that kind, if there is one.
const Feature* find_feature(std::span<const Feature> features, FeatureKind kind);

inline constexpr std::size_t feature_kinds = std::size(reflection_of<FeatureKind>().enumerators);

/// Kinds as a set, one bit for each.
using KindSet = std::uint32_t;

constexpr KindSet bit(FeatureKind kind) {
  return KindSet{1} << static_cast<unsigned>(kind);
}

KindSet kinds_of(std::span<const Feature> features);

/// "colour red", "not other_source_id vision", "location (0.1, 0.2, 0)".
std::string to_string(const Feature& x);

std::string to_string(FeatureKind kind);

} // namespace castor::binding
