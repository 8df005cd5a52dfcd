#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// A set of an entry type's top-level fields: a bit for each in wire order, those of the bases
/// first. The fields from the 64th on share the last bit.
using FieldMask = std::uint64_t;

constexpr FieldMask field_bit(std::size_t index) {
  return FieldMask{1} << (index < 63 ? index : 63);
}

/// The bit of the field of that name; 0 if the type has none.
FieldMask field_bit(const TypeDescriptor& type, std::string_view name);

/// Every field of the type.
FieldMask all_fields(const TypeDescriptor& type);

/// The names of the fields in a set; with the last bit, all that share it.
std::vector<std::string> field_names(const TypeDescriptor& type, FieldMask fields);

} // namespace castor
