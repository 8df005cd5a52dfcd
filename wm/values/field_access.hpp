#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace castor {

class Decoder;

/// Value of a single field, for comparisons. An enumeration is the name of its enumerator (or its
/// number as text, if it has none), an absent optional is std::monostate.
using FieldValue =
  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string>;

enum class Comparison { equal, not_equal, less, less_equal, greater, greater_equal };

/// There is no such field, or it cannot be compared with the given operand.
class FieldError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// Takes one scalar, enumeration or string from `in`. Throws FieldError for other kinds of field.
FieldValue take_field(Decoder& in, const TypeDescriptor& descriptor, const WireType& type);

/// Place of a field in its type: the index in each record or array on the way. Optionals have no
/// index.
using FieldPath = std::vector<std::uint32_t>;

struct FieldPlace {
  FieldPath path;
  /// Type of the field without optionals; points into the descriptor.
  const WireType* type = nullptr;
};

/// Place of the field at `path` ("pose.position.x"). Needs no value: a wrong path is found even if
/// an optional on the way is empty. Throws FieldError if there is no such field.
FieldPlace find_field(const TypeDescriptor& descriptor, std::string_view path);

/// Whether a field is a single value that can be read and compared: not a list, bytes, an array or
/// a record.
bool is_single(WireKind kind);

/// The field at a place of `descriptor`, without decoding the rest of the encoded value. Throws as
/// below.
FieldValue read_field(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
                      const FieldPath& path);

/// Whether no optional on the way to a place, nor the field itself, is empty. Throws DecodeError.
bool has_field(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
               const FieldPath& path);

/// The field at `path` ("pose.position.x") of an encoded value, without decoding the rest of it.
/// Throws FieldError if there is no such field or it is not a single value, DecodeError if the
/// bytes are not what the descriptor says.
FieldValue read_field(const TypeDescriptor& descriptor, std::span<const std::uint8_t> bytes,
                      std::string_view path);

/// Numbers compare by value whatever their types, text by code units, false before true. A
/// comparison with NaN or with an absent optional is false, but for not_equal. Throws FieldError if
/// a number, a truth value or a text is compared with another of these.
bool compare(const FieldValue& a, Comparison op, const FieldValue& b);

/// Normal form of a value: of all numbers that compare equal, the integer if there is one; other
/// values unchanged. Values that `compare` equal have `==` normal forms (except NaN and the absent
/// optional, which `compare` unequal to themselves).
FieldValue normalised(FieldValue x);

} // namespace castor
