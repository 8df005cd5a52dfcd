#pragma once

#include "castor/wm/values/reflect.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

using Bytes = std::vector<std::uint8_t>;

/// What stands on the wire, one code per shape of data.
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

/// The type of one field.
struct WireType {
  WireKind kind = WireKind::boolean;
  /// Into `TypeDescriptor::records` or `TypeDescriptor::enums`, for those two kinds.
  std::uint32_t index = 0;
  /// The number of elements of an array.
  std::uint32_t extent = 0;
  /// What a list, an array or an optional holds: exactly one for these, none otherwise.
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

/// All that a process needs to know of an entry type in order to print, compare and filter its
/// values without having its C++ type. `records.front()` is the type itself, the others are what it
/// contains.
struct TypeDescriptor {
  std::vector<RecordDescriptor> records;
  std::vector<EnumDescriptor> enums;
  /// The types this one derives from, the nearest first.
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

/// The descriptor's own wire form, by which it travels.
Bytes encode_descriptor(const TypeDescriptor& x);

/// Throws DecodeError (encoding.hpp) if `bytes` is not exactly one well-formed descriptor.
TypeDescriptorPtr decode_descriptor(std::span<const std::uint8_t> bytes);

namespace detail {

/// Collects the records and enumerations that a type is made of; recursive types end here.
class DescriptorBuilder {
public:
  /// The index of the record known by `key`, and whether the caller must now describe it.
  std::pair<std::uint32_t, bool> begin_record(const void* key, std::string_view name);
  void set_fields(std::uint32_t record, std::vector<FieldDescriptor> fields);
  std::uint32_t add_enum(const void* key, EnumDescriptor x);
  /// Throws std::logic_error if two types inside, or two fields of one of them, have the same name,
  /// or the type has the name of one of its bases.
  TypeDescriptorPtr finish(std::vector<std::string> super_types);

private:
  TypeDescriptor result_;
  std::vector<const void*> record_keys_;
  std::vector<const void*> enum_keys_;
};

template <class T>
inline constexpr char type_key = 0;

template <class T>
struct ElementOf;

template <class T, class A>
struct ElementOf<std::vector<T, A>> {
  using Type = T;
  static constexpr WireKind kind = WireKind::list;
};

template <class T, std::size_t N>
struct ElementOf<std::array<T, N>> {
  using Type = T;
  static constexpr WireKind kind = WireKind::array;
};

template <class T>
struct ElementOf<std::optional<T>> {
  using Type = T;
  static constexpr WireKind kind = WireKind::optional;
};

template <class T>
concept Container = requires {
  ElementOf<T>::kind;
};

/// A vector of bytes travels in one piece; so images and the like cost a memcpy.
template <class T>
inline constexpr bool is_bytes = std::is_same_v<T, Bytes> || std::is_same_v<T, std::vector<char>>;

template <class T>
constexpr WireKind scalar_kind() {
  if constexpr (std::is_same_v<T, bool>)
    return WireKind::boolean;
  else if constexpr (std::is_same_v<T, float>)
    return WireKind::float32;
  else if constexpr (std::is_same_v<T, double>)
    return WireKind::float64;
  else {
    static_assert(std::is_integral_v<T>, "this type cannot stand in an entry: use numbers, bool, "
                                         "std::string, std::vector, std::array, std::optional, or "
                                         "a type declared with CASTOR_REFLECT");
    constexpr auto base = std::is_signed_v<T> ? WireKind::int8 : WireKind::uint8;
    constexpr int step = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return static_cast<WireKind>(static_cast<int>(base) + step);
  }
}

template <ReflectedRecord T>
std::uint32_t describe_record(DescriptorBuilder& builder);

template <class T>
WireType describe(DescriptorBuilder& builder) {
  if constexpr (std::is_same_v<T, std::string>) {
    return {WireKind::string, 0, 0, {}};
  } else if constexpr (is_bytes<T>) {
    return {WireKind::bytes, 0, 0, {}};
  } else if constexpr (Container<T>) {
    std::uint32_t extent = 0;
    if constexpr (ElementOf<T>::kind == WireKind::array) {
      static_assert(std::tuple_size_v<T> > 0, "an array in an entry has at least one element");
      extent = static_cast<std::uint32_t>(std::tuple_size_v<T>);
    }
    return {ElementOf<T>::kind, 0, extent, {describe<typename ElementOf<T>::Type>(builder)}};
  } else if constexpr (ReflectedRecord<T>) {
    return {WireKind::record, describe_record<T>(builder), 0, {}};
  } else if constexpr (std::is_enum_v<T>) {
    static_assert(ReflectedEnum<T>, "declare this enumeration with CASTOR_REFLECT_ENUM");
    static_assert(!std::is_same_v<std::underlying_type_t<T>, bool>,
                  "an enumeration in an entry is an integer on the wire");
    constexpr auto reflection = reflection_of<T>();
    EnumDescriptor result{
      std::string{reflection.name}, scalar_kind<std::underlying_type_t<T>>(), {}};
    for (auto& [name, value] : reflection.enumerators)
      result.enumerators.emplace_back(name, static_cast<std::int64_t>(value));
    return {WireKind::enumeration, builder.add_enum(&type_key<T>, std::move(result)), 0, {}};
  } else {
    return {scalar_kind<T>(), 0, 0, {}};
  }
}

template <ReflectedRecord T>
void describe_fields(DescriptorBuilder& builder, std::vector<FieldDescriptor>& fields) {
  static constexpr auto reflection = reflection_of<T>();
  using Base = typename decltype(reflection_of<T>())::BaseType;
  if constexpr (!std::is_void_v<Base>)
    describe_fields<Base>(builder, fields);
  auto add = [&]<class Member>(const ReflectedField<T, Member>& field) {
    fields.push_back({std::string{field.name}, describe<Member>(builder)});
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, reflection.fields);
}

template <ReflectedRecord T>
std::uint32_t describe_record(DescriptorBuilder& builder) {
  auto [index, is_new] = builder.begin_record(&type_key<T>, reflection_of<T>().name);
  if (is_new) {
    std::vector<FieldDescriptor> fields;
    describe_fields<T>(builder, fields);
    builder.set_fields(index, std::move(fields));
  }
  return index;
}

template <ReflectedRecord T>
void collect_super_types(std::vector<std::string>& names) {
  using Base = typename decltype(reflection_of<T>())::BaseType;
  if constexpr (!std::is_void_v<Base>) {
    static_assert(std::is_base_of_v<Base, T>);
    names.emplace_back(reflection_of<Base>().name);
    collect_super_types<Base>(names);
  }
}

/// Makes a type known to `known_types` by what makes its descriptor.
bool announce_type(const TypeDescriptorPtr& (*descriptor)());

} // namespace detail

template <ReflectedRecord T>
const TypeDescriptorPtr& descriptor_of();

namespace detail {

/// Is initialised when a library is loaded whose code uses the type's descriptor anywhere.
template <ReflectedRecord T>
inline const bool is_announced = announce_type(&descriptor_of<T>);

} // namespace detail

/// The descriptor of a reflected type; built once per process. The type is known (known_types.hpp)
/// as soon as the library that calls this for it is loaded.
template <ReflectedRecord T>
const TypeDescriptorPtr& descriptor_of() {
  static_cast<void>(&detail::is_announced<T>);
  static const TypeDescriptorPtr result = [] {
    detail::DescriptorBuilder builder;
    detail::describe_record<T>(builder);
    std::vector<std::string> super_types;
    detail::collect_super_types<T>(super_types);
    return builder.finish(std::move(super_types));
  }();
  return result;
}

/// The name by which working memories know the type.
template <ReflectedRecord T>
const std::string& type_name() {
  return descriptor_of<T>()->name();
}

} // namespace castor
