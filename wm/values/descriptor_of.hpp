#pragma once

#include "castor/wm/values/known_types.hpp"
#include "castor/wm/values/reflect.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/wire_traits.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace castor {

namespace detail {

/// Collects the records and enumerations that a type contains, each once: recursion ends at known
/// ones.
class DescriptorBuilder {
public:
  /// The index of the record known by `key`, and whether the caller must now describe it.
  std::pair<std::uint32_t, bool> begin_record(const void* key, std::string_view name);
  void set_fields(std::uint32_t record, std::vector<FieldDescriptor> fields);
  std::uint32_t add_enum(const void* key, EnumDescriptor x);
  /// Throws std::logic_error if two contained types, or two fields of one of them, have the same
  /// name, or the type has the name of one of its bases.
  TypeDescriptorPtr finish(std::vector<std::string> super_types);

private:
  TypeDescriptor result_;
  std::vector<const void*> record_keys_;
  std::vector<const void*> enum_keys_;
};

template <class T>
inline constexpr char type_key = 0;

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

} // namespace detail

template <ReflectedRecord T>
const TypeDescriptorPtr& descriptor_of();

namespace detail {

/// Initialised when a library whose code uses the type's descriptor is loaded.
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

/// Name of the type in working memories.
template <ReflectedRecord T>
const std::string& type_name() {
  return descriptor_of<T>()->name();
}

} // namespace castor
