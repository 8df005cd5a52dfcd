#pragma once

#include "castor/actors/link/received_content.hpp"
#include "castor/actors/link/wire_members.hpp"
#include "castor/base/caf.hpp"
#include "castor/base/small_vector.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Writing and reading of messages between actors of different processes. Entry values are not
/// decoded: they have their wire form already.
namespace castor {

/// Look-ups for writer and reader: names of actors, and type descriptors by hash.
class WireNames {
public:
  virtual ~WireNames() = default;

  /// 0 for none.
  virtual std::uint64_t name_of(const caf::strong_actor_ptr& x) = 0;
  virtual caf::strong_actor_ptr actor_of(std::uint64_t name) = 0;
  /// Null if the type was not introduced.
  virtual TypeDescriptorPtr type_of(std::uint64_t hash) = 0;
};

/// A message would exceed the largest size.
class MessageTooLarge : public std::length_error {
public:
  explicit MessageTooLarge(std::size_t size)
    : length_error("a message of " + std::to_string(size) + " bytes"), size_(size) {}

  /// Lower bound of the size, in bytes.
  std::size_t size() const { return size_; }

private:
  std::size_t size_;
};

class WireWriter {
public:
  static constexpr bool writes = true;
  /// Initial capacity in bytes, enough for most messages.
  static constexpr std::size_t usual_head = 128;

  /// Takes messages of up to `largest` bytes. Contents of at least `shared_content` bytes are
  /// shared with the message rather than copied into it.
  explicit WireWriter(WireNames& names,
                      std::size_t largest = std::numeric_limits<std::size_t>::max(),
                      std::size_t shared_content = 4096)
    : names_(names), largest_(largest), shared_content_(shared_content) {
    head_.reserve(usual_head);
  }

  /// Throws MessageTooLarge if the message written so far exceeds the largest size.
  void check_size() const {
    if (auto size = head_.size() + content_bytes_; size > largest_)
      throw MessageTooLarge{size};
  }

  template <class... Ts>
  void operator()(const Ts&... xs) {
    (put(xs), ...);
  }

  Bytes take_head() { return std::move(head_); }
  std::vector<Value> take_contents() { return std::move(contents_); }

  /// The types that values and events in the message are of.
  std::vector<TypeDescriptorPtr> take_types() { return std::move(types_); }

  template <class T>
  void put(const T& x);
  void put(const std::string& x) { encoder_.put(x); }
  /// Throws MessageTooLarge before its bytes are made.
  void put(const Value& x);
  void put(const TypeDescriptorPtr& x);
  void put(const caf::strong_actor_ptr& x) { put(names_.name_of(x)); }

  template <class T>
  void put(const std::shared_ptr<const T>& x) {
    put(*x);
  }

  template <class T>
  void put(const std::optional<T>& x) {
    put(x.has_value());
    if (x)
      put(*x);
  }

  template <class T>
  void put(const std::vector<T>& x) {
    put_all(x);
  }

  template <class T, std::size_t N>
  void put(const SmallVector<T, N>& x) {
    put_all(x);
  }

  template <class T>
  void put(const std::set<T>& x) {
    put_all(x);
  }

  template <class K, class T>
  void put(const std::map<K, T>& x) {
    put_all(x);
  }

  template <class A, class B>
  void put(const std::pair<A, B>& x) {
    (*this)(x.first, x.second);
  }

  template <class T>
  void put(const Outcome<T>& x) {
    put(x.ok());
    if (x)
      put(*x);
    else
      put(x.failure());
  }

private:
  template <class T, auto... Members>
  void put_members(const T& x, WireMembers<T, Members...>) {
    (put_member<Members>(x), ...);
  }

  template <auto Member, class T>
  void put_member(const T& x) {
    if constexpr (is_nullable_member<Member>) {
      put(x.*Member != nullptr);
      if (!(x.*Member))
        return;
    }
    put(x.*Member);
  }

  template <class T>
  void put_all(const T& xs) {
    put(static_cast<std::uint32_t>(xs.size()));
    for (auto& x : xs)
      put(x);
  }

  WireNames& names_;
  const std::size_t largest_;
  const std::size_t shared_content_;
  Bytes head_;
  Encoder encoder_{head_};
  std::vector<Value> contents_;
  std::size_t content_bytes_ = 0;
  std::vector<TypeDescriptorPtr> types_;
};

/// Throws DecodeError for invalid input.
class WireReader {
public:
  bool at_end() const { return decoder_.remaining() == 0; }
  static constexpr bool writes = false;

  WireReader(WireNames& names, std::span<const std::uint8_t> head,
             std::vector<ReceivedContentPtr> contents)
    : names_(names), decoder_(head), contents_(std::move(contents)) {}

  template <class... Ts>
  void operator()(Ts&&... xs) {
    (get(xs), ...);
  }

  template <class T>
  T take() {
    T x{};
    get(x);
    return x;
  }

  Bytes take_bytes() {
    Bytes x;
    decoder_.get(x);
    return x;
  }

  /// Throws DecodeError if there is more to the message than was read.
  void expect_end() const;

  template <class T>
  void get(T& x);
  void get(std::string& x) { decoder_.get(x); }
  void get(Value& x);
  void get(TypeDescriptorPtr& x);
  void get(caf::strong_actor_ptr& x) { x = names_.actor_of(take<std::uint64_t>()); }

  template <class T>
  void get(std::shared_ptr<const T>& x) {
    x = std::make_shared<const T>(take<T>());
  }

  template <class T>
  void get(std::optional<T>& x) {
    if (take<bool>())
      x = take<T>();
    else
      x.reset();
  }

  template <class T>
  void get(std::vector<T>& x) {
    x.clear();
    for (auto n = take_count(); n > 0; --n)
      x.push_back(take<T>());
  }

  template <class T, std::size_t N>
  void get(SmallVector<T, N>& x) {
    x.clear();
    for (auto n = take_count(); n > 0; --n)
      x.push_back(take<T>());
  }

  template <class T>
  void get(std::set<T>& x) {
    x.clear();
    for (auto n = take_count(); n > 0; --n)
      x.insert(take<T>());
  }

  template <class K, class T>
  void get(std::map<K, T>& x) {
    x.clear();
    for (auto n = take_count(); n > 0; --n) {
      auto key = take<K>();
      x.insert_or_assign(std::move(key), take<T>());
    }
  }

  template <class A, class B>
  void get(std::pair<A, B>& x) {
    (*this)(x.first, x.second);
  }

  template <class T>
  void get(Outcome<T>& x) {
    if (take<bool>())
      x = take<T>();
    else
      x = take<Failure>();
  }

private:
  template <class T, auto... Members>
  void get_members(T& x, WireMembers<T, Members...>) {
    (get_member<Members>(x), ...);
  }

  template <auto Member, class T>
  void get_member(T& x) {
    if constexpr (is_nullable_member<Member>)
      if (!take<bool>()) {
        x.*Member = nullptr;
        return;
      }
    get(x.*Member);
  }

  /// Every element takes a byte at least, so a huge count is refused at once.
  std::uint32_t take_count();

  WireNames& names_;
  Decoder decoder_;
  std::vector<ReceivedContentPtr> contents_;
  std::size_t next_content_ = 0;
};

/// What is not a plain struct is written and read by a function beside it, which asks `A::writes`
/// for the direction:
///
///     template <class A>
///     void wire(A& a, WirePart<A, SourceLocation>& x);
template <class A, class T>
using WirePart = std::conditional_t<A::writes, const T, T>;

namespace detail {

template <class T>
inline constexpr bool is_duration = false;

template <class R, class P>
inline constexpr bool is_duration<std::chrono::duration<R, P>> = true;

} // namespace detail

template <class T>
void WireWriter::put(const T& x) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
    encoder_.put(x);
  else if constexpr (detail::is_duration<T>)
    encoder_.put(x.count());
  else if constexpr (WireRecord<T>)
    put_members(x, castor_wire_members(TypeTag<T>{}));
  else
    wire(*this, x);
}

template <class T>
void WireReader::get(T& x) {
  if constexpr (std::is_enum_v<T>) {
    decoder_.get(x);
    if (x < T{} || x > last_enumerator<T>())
      throw DecodeError("an invalid enumerator");
  } else if constexpr (std::is_arithmetic_v<T>)
    decoder_.get(x);
  else if constexpr (detail::is_duration<T>)
    x = T{take<typename T::rep>()};
  else if constexpr (WireRecord<T>) {
    get_members(x, castor_wire_members(TypeTag<T>{}));
    if constexpr (requires { check_read(x); })
      check_read(x);
  } else
    wire(*this, x);
}

} // namespace castor
