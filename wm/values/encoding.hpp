#pragma once

#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/wire_traits.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

/// The wire form of entry values. It is little-endian, and every field can be skipped without
/// decoding it:
///
///   numbers, bool, enumerations   as they are
///   string, bytes                 u32 length, then the bytes
///   list                          u32 length of the rest in bytes, u32 count, the elements
///   array                         its elements
///   optional                      u8 0 or 1, then the value if 1
///   record inside a record        u32 length in bytes, then its fields
///   the entry itself              its fields, those of the bases first
///
/// A value of a derived type therefore begins with a value of its base.
namespace castor {

static_assert(std::endian::native == std::endian::little,
              "scalars are copied as they are: a big-endian machine needs a swap here");

/// The bytes do not fit the descriptor or the C++ type.
class DecodeError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// Appends values to a byte sequence.
class Encoder {
public:
  explicit Encoder(Bytes& out) : out_(out) {}

  template <class T>
  void put(const T& x) {
    if constexpr (std::is_same_v<T, std::string> || detail::is_bytes<T>) {
      put_length(x.size());
      put_raw(x.data(), x.size());
    } else if constexpr (detail::Container<T>) {
      put_container(x);
    } else if constexpr (ReflectedRecord<T>) {
      auto at = begin_length();
      put_fields(x);
      end_length(at);
    } else {
      static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
      put_raw(&x, sizeof(x));
    }
  }

  template <ReflectedRecord T>
  void put_fields(const T& x) {
    for_each_field<T>(x, [this](std::string_view, const auto& member) { this->put(member); });
  }

private:
  template <class T>
  void put_container(const T& x) {
    using Element = typename detail::ElementOf<T>::Type;
    constexpr auto kind = detail::ElementOf<T>::kind;
    if constexpr (kind == WireKind::optional) {
      put(x.has_value());
      if (x)
        put(*x);
    } else {
      std::size_t at = 0;
      if constexpr (kind == WireKind::list) {
        at = begin_length();
        put_length(x.size());
      }
      if constexpr (std::is_arithmetic_v<Element> && !std::is_same_v<Element, bool>) {
        put_raw(x.data(), x.size() * sizeof(Element));
      } else {
        for (const Element& element : x)
          put(element);
      }
      if constexpr (kind == WireKind::list)
        end_length(at);
    }
  }

  void put_raw(const void* data, std::size_t size) {
    if (size == 0)
      return;
    auto at = out_.size();
    out_.resize(at + size);
    std::memcpy(out_.data() + at, data, size);
  }

  /// Throws std::length_error beyond 4 GiB.
  void put_length(std::size_t n);
  std::size_t begin_length();
  void end_length(std::size_t at);

  Bytes& out_;
};

/// Takes values from a byte sequence; every read is checked against the remaining bytes. Throws
/// DecodeError.
class Decoder {
public:
  explicit Decoder(std::span<const std::uint8_t> in) : in_(in) {}

  std::size_t remaining() const { return in_.size(); }

  template <class T>
  void get(T& x) {
    if constexpr (std::is_same_v<T, std::string> || detail::is_bytes<T>) {
      auto data = take(take_length());
      x.assign(data.begin(), data.end());
    } else if constexpr (detail::Container<T>) {
      get_container(x);
    } else if constexpr (ReflectedRecord<T>) {
      Decoder inner{take(take_length()), depth_ + 1};
      inner.get_fields(x);
      inner.expect_end();
    } else if constexpr (std::is_same_v<T, bool>) {
      x = take_scalar<std::uint8_t>() != 0;
    } else {
      static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
      x = take_scalar<T>();
    }
  }

  template <ReflectedRecord T>
  void get_fields(T& x) {
    for_each_field<T>(x, [this](std::string_view, auto& member) { this->get(member); });
  }

  template <class T>
  T take_scalar() {
    T x;
    auto data = take(sizeof(T));
    std::memcpy(&x, data.data(), sizeof(T));
    return x;
  }

  std::uint32_t take_length() { return take_scalar<std::uint32_t>(); }
  std::span<const std::uint8_t> take(std::size_t n);
  void expect_end() const;

  /// Skips one value of the given type.
  void skip(const TypeDescriptor& descriptor, const WireType& type);

private:
  /// Limit against hostile input; real entry types nest far less deeply.
  static constexpr int max_depth = 100;

  Decoder(std::span<const std::uint8_t> in, int depth) : in_(in), depth_(depth) {
    if (depth > max_depth)
      throw DecodeError("value is nested too deeply");
  }

  template <class T>
  void get_container(T& x) {
    using Element = typename detail::ElementOf<T>::Type;
    constexpr auto kind = detail::ElementOf<T>::kind;
    if constexpr (kind == WireKind::optional) {
      x.reset();
      if (take_scalar<std::uint8_t>() != 0)
        get(x.emplace());
    } else if constexpr (kind == WireKind::array) {
      for (Element& element : x)
        get(element);
    } else {
      Decoder inner{take(take_length()), depth_ + 1};
      std::size_t count = inner.take_length();
      // Every element has at least one byte: a huge count is refused before allocation.
      if (count > inner.remaining())
        throw DecodeError("list claims more elements than it has bytes");
      x.clear();
      if constexpr (std::is_arithmetic_v<Element> && !std::is_same_v<Element, bool>) {
        auto data = inner.take(count * sizeof(Element));
        x.resize(count);
        if (count > 0)
          std::memcpy(x.data(), data.data(), data.size());
      } else {
        // An element may be far larger in memory than on the wire, and the bytes may end early.
        x.reserve(std::min(count, inner.remaining() / sizeof(Element) + 1));
        for (std::size_t i = 0; i < count; ++i) {
          Element element{};
          inner.get(element);
          x.push_back(std::move(element));
        }
      }
      inner.expect_end();
    }
  }

  std::span<const std::uint8_t> in_;
  int depth_ = 0;
};

/// Size in bytes of a scalar, or a record field of fixed size; nothing for other kinds.
std::optional<std::size_t> fixed_size(WireKind kind);

/// The wire form of an entry value.
template <ReflectedRecord T>
Bytes encode(const T& x) {
  Bytes out;
  Encoder{out}.put_fields(x);
  return out;
}

/// Decodes a value from the beginning of `bytes`, so a base can be decoded from a derived value.
/// Throws DecodeError.
template <ReflectedRecord T>
T decode(std::span<const std::uint8_t> bytes) {
  T x{};
  Decoder in{bytes};
  in.get_fields(x);
  return x;
}

} // namespace castor
