#pragma once

#include "castor/wm/values/field_access.hpp"
#include "castor/wm/values/type_descriptor.hpp"

#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// Types that no C++ declaration stands behind, values of them, and damage to their bytes. All of
/// it follows from a seed, so a property that fails with a seed fails with it again.
namespace castor::test {

using Random = std::mt19937_64;

/// A number from `low` to `high`, both included.
template <class T>
T between(Random& random, T low, T high) {
  return std::uniform_int_distribution<T>{low, high}(random);
}

/// A well-formed descriptor with up to three records, which may contain one another and themselves.
/// Its hash is not set.
TypeDescriptor random_descriptor(Random& random);

/// A value, and what must be found out about it from its bytes.
struct RandomValue {
  Bytes bytes;
  /// Where each field of the value ends in `bytes`.
  std::vector<std::size_t> ends;
  nlohmann::ordered_json json;
  /// The single values by their path, those inside absent optionals included.
  std::map<std::string, FieldValue> fields;
};

/// Written by the rules in encoding.hpp, not by the encoder.
RandomValue random_value(const TypeDescriptor& descriptor, Random& random);

/// Changes, cuts, repeats or inserts some bytes, with a liking for lengths that are far too large.
void damage(Bytes& bytes, Random& random);

Bytes random_bytes(std::size_t max_size, Random& random);

} // namespace castor::test
