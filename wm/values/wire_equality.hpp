#pragma once

#include "castor/wm/values/field_mask.hpp"
#include "castor/wm/values/wire_traits.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <tuple>

namespace castor {

/// Calls `f(member of a, member of b)` for every field, those of the bases first.
template <ReflectedRecord T, class F>
void for_each_field_pair(const T& a, const T& b, F&& f) {
  static constexpr auto reflection = reflection_of<T>();
  using Base = typename decltype(reflection_of<T>())::BaseType;
  if constexpr (!std::is_void_v<Base>)
    for_each_field_pair<Base>(a, b, f);
  std::apply([&](const auto&... field) { (f(a.*field.member, b.*field.member), ...); },
             reflection.fields);
}

/// Whether two objects have the same wire form, without encoding: like `==` of all fields, but NaN
/// equals itself and zero differs from negative zero.
template <class T>
bool same_on_wire(const T& a, const T& b) {
  if constexpr (std::is_floating_point_v<T>) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
  } else if constexpr (detail::Container<T> && !detail::is_bytes<T>) {
    using Element = typename detail::ElementOf<T>::Type;
    [[maybe_unused]] auto same = [](const Element& x, const Element& y) {
      return same_on_wire(x, y);
    };
    if constexpr (detail::ElementOf<T>::kind == WireKind::optional)
      return a.has_value() == b.has_value() && (!a || same(*a, *b));
    else if constexpr (std::is_arithmetic_v<Element> && !std::is_same_v<Element, bool>)
      return a.size() == b.size() &&
             (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Element)) == 0);
    else
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
  } else if constexpr (ReflectedRecord<T>) {
    bool result = true;
    for_each_field_pair(
      a, b, [&](const auto& x, const auto& y) { result = result && same_on_wire(x, y); });
    return result;
  } else {
    return a == b;
  }
}

/// The fields in which two objects differ.
template <ReflectedRecord T>
FieldMask fields_that_differ(const T& a, const T& b) {
  FieldMask result = 0;
  std::size_t index = 0;
  for_each_field_pair(a, b, [&](const auto& x, const auto& y) {
    auto bit = field_bit(index++);
    if (!same_on_wire(x, y))
      result |= bit;
  });
  return result;
}

} // namespace castor
