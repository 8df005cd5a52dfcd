#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstdint>
#include <span>

namespace castor {

/// The wire form of a descriptor.
Bytes encode_descriptor(const TypeDescriptor& x);

/// Decodes a descriptor and makes its type known (known_types.hpp). Throws DecodeError
/// (encoding.hpp) if `bytes` is not exactly one well-formed descriptor.
TypeDescriptorPtr decode_descriptor(std::span<const std::uint8_t> bytes);

/// The hash of a descriptor, from its wire form.
std::uint64_t descriptor_hash(std::span<const std::uint8_t> bytes);

} // namespace castor
