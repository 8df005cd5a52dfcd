#pragma once

#include "castor/binding/types.hpp"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>

/// How features are made and taken apart.
namespace castor::binding {

/// A kind whose value is a word: concept, colour, ...
Feature feature(FeatureKind kind, std::string text);

/// The same, said not to hold.
Feature negated(Feature x);

/// Metres.
Feature location_at(double x, double y, double z);

/// Not to be bound to anything from that subarchitecture.
Feature not_from(const std::string& subarchitecture);

/// The tether to what the proxy stands for.
Feature tether_to(AnyEntryPointer data);

/// Microseconds since the system began.
Feature created_at(std::int64_t time);

/// Still salient if there is no end.
Feature salient_from(std::int64_t begin, std::optional<std::int64_t> end = std::nullopt);

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
