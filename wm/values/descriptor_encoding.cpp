#include "castor/wm/values/descriptor_encoding.hpp"

#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/known_types.hpp"

#include <utility>

namespace castor {

// The descriptor travels in the same wire form as the values it describes.
CASTOR_REFLECT(WireType, kind, index, extent, element)
CASTOR_REFLECT(FieldDescriptor, name, type)
CASTOR_REFLECT(RecordDescriptor, name, fields)

namespace {

struct WireEnumerator {
  std::string name;
  std::int64_t value = 0;
};
CASTOR_REFLECT(WireEnumerator, name, value)

struct WireEnum {
  std::string name;
  WireKind underlying = WireKind::int32;
  std::vector<WireEnumerator> enumerators;
};
CASTOR_REFLECT(WireEnum, name, underlying, enumerators)

struct WireDescriptor {
  std::vector<RecordDescriptor> records;
  std::vector<WireEnum> enums;
  std::vector<std::string> super_types;
};
CASTOR_REFLECT(WireDescriptor, records, enums, super_types)

bool is_integer(WireKind kind) {
  return kind >= WireKind::int8 && kind <= WireKind::uint64;
}

bool has_element(WireKind kind) {
  return kind == WireKind::list || kind == WireKind::array || kind == WireKind::optional;
}

/// Descriptors come from other processes: nothing in them is believed unchecked.
void check(const TypeDescriptor& descriptor, const WireType& type, int depth = 0) {
  if (depth > 16)
    throw DecodeError("type descriptor is nested too deeply");
  if (type.kind > WireKind::enumeration)
    throw DecodeError("type descriptor has an unknown wire kind");
  if (type.kind == WireKind::record && type.index >= descriptor.records.size())
    throw DecodeError("type descriptor refers to a record that it lacks");
  if (type.kind == WireKind::enumeration && type.index >= descriptor.enums.size())
    throw DecodeError("type descriptor refers to an enumeration that it lacks");
  if (type.element.size() != (has_element(type.kind) ? 1u : 0u))
    throw DecodeError("type descriptor has a container without exactly one element type");
  // An element takes a byte at least, so stepping over an array never costs more than its bytes.
  if (type.kind == WireKind::array && type.extent == 0)
    throw DecodeError("type descriptor has an array without elements");
  for (auto& element : type.element)
    check(descriptor, element, depth + 1);
}

} // namespace

Bytes encode_descriptor(const TypeDescriptor& x) {
  WireDescriptor wire{x.records, {}, x.super_types};
  for (auto& e : x.enums) {
    auto& out = wire.enums.emplace_back(WireEnum{e.name, e.underlying, {}});
    for (auto& [name, value] : e.enumerators)
      out.enumerators.push_back({name, value});
  }
  return encode(wire);
}

TypeDescriptorPtr decode_descriptor(std::span<const std::uint8_t> bytes) {
  Decoder in{bytes};
  WireDescriptor wire;
  in.get_fields(wire);
  in.expect_end();
  auto result = std::make_shared<TypeDescriptor>();
  result->records = std::move(wire.records);
  result->super_types = std::move(wire.super_types);
  for (auto& e : wire.enums) {
    if (!is_integer(e.underlying))
      throw DecodeError("type descriptor has an enumeration that is no integer");
    auto& out = result->enums.emplace_back(EnumDescriptor{e.name, e.underlying, {}});
    for (auto& enumerator : e.enumerators)
      out.enumerators.emplace_back(std::move(enumerator.name), enumerator.value);
  }
  if (result->records.empty())
    throw DecodeError("type descriptor without a record");
  for (auto& record : result->records)
    for (auto& field : record.fields)
      check(*result, field.type);
  if (auto complaint = ambiguity(*result); !complaint.empty())
    throw DecodeError("type descriptor has " + complaint);
  result->hash = descriptor_hash(bytes);
  make_foreign_type_known(result);
  return result;
}

/// FNV-1a, 64 bits: the same in every process and on every machine.
std::uint64_t descriptor_hash(std::span<const std::uint8_t> bytes) {
  std::uint64_t h = 14695981039346656037ull;
  for (auto b : bytes)
    h = (h ^ b) * 1099511628211ull;
  return h;
}

} // namespace castor
