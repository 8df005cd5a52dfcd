#include "castor/wm/values/type_descriptor.hpp"

#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/known_types.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

namespace castor {

// The descriptor travels in the same wire form as the values it describes.
CASTOR_REFLECT(WireType, kind, index, extent, element)
CASTOR_REFLECT(FieldDescriptor, name, type)
CASTOR_REFLECT(RecordDescriptor, name, fields)
CASTOR_REFLECT_ENUM(WireKind, boolean, int8, int16, int32, int64, uint8, uint16, uint32, uint64,
                    float32, float64, string, bytes, list, array, optional, record, enumeration)

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

/// FNV-1a, 64 bits: the same in every process and on every machine.
std::uint64_t fnv1a(std::span<const std::uint8_t> bytes) {
  std::uint64_t h = 14695981039346656037ull;
  for (auto b : bytes)
    h = (h ^ b) * 1099511628211ull;
  return h;
}

std::string to_string(const TypeDescriptor& descriptor, const WireType& type) {
  switch (type.kind) {
    case WireKind::record:
      return descriptor.records.at(type.index).name;
    case WireKind::enumeration:
      return descriptor.enums.at(type.index).name;
    case WireKind::list:
      return "list of " + to_string(descriptor, type.element.front());
    case WireKind::array:
      return std::to_string(type.extent) + " of " + to_string(descriptor, type.element.front());
    case WireKind::optional:
      return "optional " + to_string(descriptor, type.element.front());
    default:
      return std::string{
        reflection_of<WireKind>().enumerators[static_cast<std::size_t>(type.kind)].first};
  }
}

bool is_integer(WireKind kind) {
  return kind >= WireKind::int8 && kind <= WireKind::uint64;
}

bool has_element(WireKind kind) {
  return kind == WireKind::list || kind == WireKind::array || kind == WireKind::optional;
}

/// What is wrong with the names in a descriptor, or nothing. Where a name stood for two things,
/// JSON and filters could only mean one of them.
std::string ambiguity(const TypeDescriptor& descriptor) {
  std::unordered_set<std::string_view> types;
  for (auto& record : descriptor.records) {
    if (!types.insert(record.name).second)
      return "two different types named " + record.name + " inside " + descriptor.name();
    std::unordered_set<std::string_view> fields;
    for (auto& field : record.fields)
      if (!fields.insert(field.name).second)
        return "two fields named " + field.name + " in " + record.name + " or its bases";
  }
  for (auto& e : descriptor.enums)
    if (!types.insert(e.name).second)
      return "two different types named " + e.name + " inside " + descriptor.name();
  std::unordered_set<std::string_view> ancestry{descriptor.name()};
  for (auto& name : descriptor.super_types)
    if (!ancestry.insert(name).second)
      return "two types named " + name + " among " + descriptor.name() + " and its bases";
  return {};
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

bool TypeDescriptor::is_a(std::string_view other) const {
  return name() == other ||
         std::find(super_types.begin(), super_types.end(), other) != super_types.end();
}

std::string to_string(const TypeDescriptor& x) {
  std::string result = x.name() + " {";
  const char* separator = "";
  for (auto& field : x.records.front().fields) {
    result += separator + field.name + ": " + to_string(x, field.type);
    separator = ", ";
  }
  char hash[24];
  std::snprintf(hash, sizeof(hash), "} #%016llx", static_cast<unsigned long long>(x.hash));
  return result + hash;
}

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
  result->hash = fnv1a(bytes);
  make_foreign_type_known(result);
  return result;
}

namespace detail {

std::pair<std::uint32_t, bool> DescriptorBuilder::begin_record(const void* key,
                                                               std::string_view name) {
  auto i = std::find(record_keys_.begin(), record_keys_.end(), key);
  auto index = static_cast<std::uint32_t>(i - record_keys_.begin());
  if (i != record_keys_.end())
    return {index, false};
  record_keys_.push_back(key);
  result_.records.push_back({std::string{name}, {}});
  return {index, true};
}

void DescriptorBuilder::set_fields(std::uint32_t record, std::vector<FieldDescriptor> fields) {
  result_.records[record].fields = std::move(fields);
}

std::uint32_t DescriptorBuilder::add_enum(const void* key, EnumDescriptor x) {
  auto i = std::find(enum_keys_.begin(), enum_keys_.end(), key);
  auto index = static_cast<std::uint32_t>(i - enum_keys_.begin());
  if (i == enum_keys_.end()) {
    enum_keys_.push_back(key);
    result_.enums.push_back(std::move(x));
  }
  return index;
}

TypeDescriptorPtr DescriptorBuilder::finish(std::vector<std::string> super_types) {
  result_.super_types = std::move(super_types);
  if (auto complaint = ambiguity(result_); !complaint.empty())
    throw std::logic_error(complaint);
  result_.hash = fnv1a(encode_descriptor(result_));
  auto result = std::make_shared<const TypeDescriptor>(std::move(result_));
  make_own_type_known(result);
  return result;
}

} // namespace detail

} // namespace castor
