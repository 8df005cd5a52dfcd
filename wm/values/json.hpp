#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace castor {

class Value;

struct JsonOptions {
  /// Spaces per level; negative for everything on one line.
  int indent = -1;
  /// Byte fields longer than this are shown as {"bytes": SIZE}, shorter ones as base64 text.
  std::size_t max_bytes = std::numeric_limits<std::size_t>::max();
};

/// The value as JSON, made from its bytes and its descriptor. Numbers that JSON lacks (NaN,
/// infinity) become null. Throws DecodeError if the bytes do not fit the descriptor.
std::string to_json(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
                    const JsonOptions& options = {});

std::string to_json(const Value& x, const JsonOptions& options = {});

} // namespace castor
