#pragma once

#include "castor/wm/values/field_access.hpp"
#include "castor/wm/values/wire_traits.hpp"

#include <cstddef>
#include <string>

/// Access to the fields of a C++ object of unknown type, by their place.
namespace castor {

struct ObjectOperations;

/// A part of an object: a field, an element of an array, or the content of an optional.
struct ObjectPart {
  /// Null for the content of an empty optional.
  const void* data = nullptr;
  const ObjectOperations* operations = nullptr;
};

/// Operations on a part, one set per type.
struct ObjectOperations {
  bool is_optional = false;
  /// Returns a part of a record, an array or an optional (which has one); null for types without
  /// parts.
  ObjectPart (*part)(const void* whole, std::size_t index) = nullptr;
  /// Reads the value of a single field; null for other types.
  FieldValue (*read)(const void* data) = nullptr;
};

/// The name of an enumerator, or its number if it has none.
template <ReflectedEnum T>
FieldValue enumerator_value(T x) {
  static constexpr auto reflection = reflection_of<T>();
  for (auto& [name, value] : reflection.enumerators)
    if (value == x)
      return std::string{name};
  return std::to_string(static_cast<std::underlying_type_t<T>>(x));
}

namespace detail {

template <class T>
constexpr ObjectOperations make_object_operations();

template <class T>
inline constexpr ObjectOperations object_operations = make_object_operations<T>();

template <class T>
FieldValue read_object(const void* data) {
  auto& x = *static_cast<const T*>(data);
  if constexpr (std::is_enum_v<T>)
    return enumerator_value(x);
  else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>)
    return x;
  else if constexpr (std::is_floating_point_v<T>)
    return static_cast<double>(x);
  else if constexpr (std::is_signed_v<T>)
    return static_cast<std::int64_t>(x);
  else
    return static_cast<std::uint64_t>(x);
}

template <class T>
ObjectPart part_of_object(const void* whole, std::size_t index) {
  auto& x = *static_cast<const T*>(whole);
  if constexpr (ReflectedRecord<T>) {
    ObjectPart result;
    std::size_t i = 0;
    for_each_field<T>(x, [&]<class Member>(std::string_view, const Member& member) {
      if (i++ == index)
        result = {&member, &object_operations<Member>};
    });
    return result;
  } else {
    using Element = typename ElementOf<T>::Type;
    if constexpr (ElementOf<T>::kind == WireKind::optional)
      return {x ? &*x : nullptr, &object_operations<Element>};
    else
      return {&x[index], &object_operations<Element>};
  }
}

template <class T>
constexpr ObjectOperations make_object_operations() {
  if constexpr (ReflectedRecord<T>) {
    return {false, &part_of_object<T>, nullptr};
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> ||
                       std::is_same_v<T, std::string>) {
    return {false, nullptr, &read_object<T>};
  } else if constexpr (ElementOf<T>::kind != WireKind::list) {
    return {ElementOf<T>::kind == WireKind::optional, &part_of_object<T>, nullptr};
  } else {
    return {};
  }
}

} // namespace detail

/// The part at `path`, which must have been found in the descriptor of the object's type; without
/// data if an optional on the way, or the field itself, is empty.
ObjectPart find_part(ObjectPart object, const FieldPath& path);

} // namespace castor
