#pragma once

#include "castor/wm/values/wire_traits.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace castor {

template <ReflectedRecord T>
std::size_t encoded_size(const T& x);

namespace detail {

template <class T>
std::size_t size_on_wire(const T& x) {
  constexpr auto length = sizeof(std::uint32_t);
  if constexpr (std::is_same_v<T, std::string> || is_bytes<T>) {
    return length + x.size();
  } else if constexpr (Container<T>) {
    using Element = typename ElementOf<T>::Type;
    constexpr auto kind = ElementOf<T>::kind;
    if constexpr (kind == WireKind::optional) {
      return 1 + (x ? size_on_wire(*x) : 0);
    } else {
      auto result = kind == WireKind::list ? 2 * length : 0;
      if constexpr (std::is_arithmetic_v<Element> || std::is_enum_v<Element>) {
        result += x.size() * sizeof(Element);
      } else {
        for (auto& element : x)
          result += size_on_wire(element);
      }
      return result;
    }
  } else if constexpr (ReflectedRecord<T>) {
    return length + encoded_size(x);
  } else {
    return sizeof(T);
  }
}

} // namespace detail

/// Size of `encode(x)` (encoding.hpp) in bytes, without encoding.
template <ReflectedRecord T>
std::size_t encoded_size(const T& x) {
  std::size_t result = 0;
  for_each_field<T>(
    x, [&](std::string_view, const auto& member) { result += detail::size_on_wire(member); });
  return result;
}

} // namespace castor
