#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstdint>
#include <span>

namespace castor {

/// The descriptor's own wire form, by which it travels.
Bytes encode_descriptor(const TypeDescriptor& x);

/// The type is known (known_types.hpp) from then on. Throws DecodeError (encoding.hpp) if `bytes`
/// is not exactly one well-formed descriptor.
TypeDescriptorPtr decode_descriptor(std::span<const std::uint8_t> bytes);

/// The hash of a descriptor, from its wire form.
std::uint64_t descriptor_hash(std::span<const std::uint8_t> bytes);

} // namespace castor
