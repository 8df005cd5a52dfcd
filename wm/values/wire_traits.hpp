#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

/// Traits of C++ types on the wire: containers, and byte sequences.
namespace castor::detail {

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

/// A vector of bytes is copied as a whole, so images and the like cost one memcpy.
template <class T>
inline constexpr bool is_bytes = std::is_same_v<T, Bytes> || std::is_same_v<T, std::vector<char>>;

} // namespace castor::detail
