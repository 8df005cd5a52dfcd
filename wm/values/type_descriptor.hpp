#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

using Bytes = std::vector<std::uint8_t>;

/// Kinds of data on the wire.
enum class WireKind : std::uint8_t {
  boolean,
  int8,
  int16,
  int32,
  int64,
  uint8,
  uint16,
  uint32,
  uint64,
  float32,
  float64,
  string,
  bytes,
  list,
  array,
  optional,
  record,
  enumeration,
};

CASTOR_REFLECT_ENUM(WireKind, boolean, int8, int16, int32, int64, uint8, uint16, uint32, uint64,
                    float32, float64, string, bytes, list, array, optional, record, enumeration)

/// The type of one field.
struct WireType {
  WireKind kind = WireKind::boolean;
  /// Index into `TypeDescriptor::records` or `TypeDescriptor::enums`, for records and enumerations.
  std::uint32_t index = 0;
  /// The number of elements of an array.
  std::uint32_t extent = 0;
  /// Element type of a list, an array or an optional: exactly one for these, none otherwise.
  std::vector<WireType> element;

  friend bool operator==(const WireType&, const WireType&) = default;
};

struct FieldDescriptor {
  std::string name;
  WireType type;

  friend bool operator==(const FieldDescriptor&, const FieldDescriptor&) = default;
};

/// A struct: its fields in wire order, those of its bases first.
struct RecordDescriptor {
  std::string name;
  std::vector<FieldDescriptor> fields;

  friend bool operator==(const RecordDescriptor&, const RecordDescriptor&) = default;
};

struct EnumDescriptor {
  std::string name;
  WireKind underlying = WireKind::int32;
  std::vector<std::pair<std::string, std::int64_t>> enumerators;

  friend bool operator==(const EnumDescriptor&, const EnumDescriptor&) = default;
};

/// Description of an entry type, by which a process can print, compare and filter its values
/// without the C++ type. `records.front()` is the type itself, the others are the records in it.
struct TypeDescriptor {
  std::vector<RecordDescriptor> records;
  std::vector<EnumDescriptor> enums;
  /// Base types, the nearest first.
  std::vector<std::string> super_types;
  /// Equal for equal descriptors, in every process.
  std::uint64_t hash = 0;

  const std::string& name() const { return records.front().name; }

  /// Whether this is the type `name` or derives from it.
  bool is_a(std::string_view name) const;

  friend bool operator==(const TypeDescriptor&, const TypeDescriptor&) = default;
};

using TypeDescriptorPtr = std::shared_ptr<const TypeDescriptor>;

/// The name, the fields and the hash of a type as one line of text, for messages.
std::string to_string(const TypeDescriptor& x);

/// Description of a name that is used twice in a descriptor, or empty. With such a name, fields in
/// JSON and filters would be ambiguous.
std::string ambiguity(const TypeDescriptor& x);

} // namespace castor
