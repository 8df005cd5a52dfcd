#pragma once

#include "castor/wm/values/descriptor_of.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <string>
#include <type_traits>

namespace castor::test {

/// Any object: all its parts are picked, so all of it shrinks.
template <class T>
T any(int depth = 0) {
  if constexpr (std::is_enum_v<T>) {
    return static_cast<T>(*rc::gen::arbitrary<std::underlying_type_t<T>>());
  } else if constexpr (std::is_same_v<T, std::string> || detail::is_bytes<T> ||
                       std::is_same_v<T, bool> || std::is_floating_point_v<T>) {
    return *rc::gen::arbitrary<T>();
  } else if constexpr (std::is_integral_v<T>) {
    return *rc::gen::oneOf(
      rc::gen::arbitrary<T>(),
      rc::gen::element(std::numeric_limits<T>::min(), T{0}, std::numeric_limits<T>::max()));
  } else if constexpr (detail::Container<T>) {
    using Element = typename detail::ElementOf<T>::Type;
    T result{};
    if constexpr (detail::ElementOf<T>::kind == WireKind::array) {
      for (auto& element : result)
        element = any<Element>(depth + 1);
    } else if constexpr (detail::ElementOf<T>::kind == WireKind::optional) {
      if (*rc::gen::arbitrary<bool>())
        result = any<Element>(depth + 1);
    } else {
      for (int i = depth < 4 ? *rc::gen::inRange(0, 4) : 0; i > 0; --i)
        result.push_back(any<Element>(depth + 1));
    }
    return result;
  } else {
    T result;
    for_each_field<T>(result, [&](std::string_view, auto& member) {
      member = any<std::remove_reference_t<decltype(member)>>(depth + 1);
    });
    return result;
  }
}

} // namespace castor::test
