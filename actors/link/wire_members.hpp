#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstddef>
#include <string_view>
#include <type_traits>

/// The declaration of what messages consist of, from which both their writing and their reading
/// follow:
///
///     struct Lease { LeaseToken token = 0; LockLevel level = LockLevel::o; };
///     CASTOR_WIRE(Lease, token, level)
///
///     enum class LockLevel { o, od, odr };
///     CASTOR_WIRE_ENUM(LockLevel, odr)
///
/// The order of the members is the format. Each member has to be named, or it does not compile. Of
/// an enumeration, whose enumerators are numbered from 0 on, the last one is named, behind which
/// there must be none. The macros stand in the namespace of the type, CASTOR_WIRE_NULLABLE in
/// `castor`.
///
/// Members that are not sent are named separately:
///
///     struct Subscription { FilterId id = 0; bool is_active = false; };
///     CASTOR_WIRE_EXCEPT(Subscription, (is_active), id)
///
/// What a pointer points to is written in its place, so none may be null, unless that is declared:
///
///     struct LockStatus { ClientPtr holder; std::uint64_t waiting = 0; };
///     CASTOR_WIRE(LockStatus, holder, waiting)
///     CASTOR_WIRE_NULLABLE(LockStatus, holder)
///
/// Further conditions are checked, after such a struct was read, by a function
/// `void check_read(const Lease& x)` beside it, which throws DecodeError.
namespace castor {

template <class T, auto... Members>
struct WireMembers {};

/// A struct that was declared with CASTOR_WIRE.
template <class T>
concept WireRecord = std::is_class_v<T> && requires {
  castor_wire_members(TypeTag<T>{});
};

/// Whether this member, a pointer, may be null.
template <auto Member>
inline constexpr bool is_nullable_member = false;

/// The last enumerator of an enumeration that was declared with CASTOR_WIRE_ENUM.
template <class E>
constexpr E last_enumerator() {
  return castor_last_enumerator(TypeTag<E>{});
}

namespace detail {

/// Whether an enumerator has this value: the compiler writes its name then, and "(Type)3" else.
template <auto X>
constexpr bool is_enumerator() {
  std::string_view text = __PRETTY_FUNCTION__;
  auto end = text.find_last_not_of("0123456789]");
  return text[end] != ')';
}

template <auto X>
inline constexpr bool is_last_enumerator =
  is_enumerator<X>() &&
  !is_enumerator<static_cast<decltype(X)>(static_cast<std::underlying_type_t<decltype(X)>>(X) +
                                          1)>();

template <class T, auto... Members>
constexpr std::size_t count_members(WireMembers<T, Members...>) {
  return sizeof...(Members);
}

} // namespace detail

} // namespace castor

#define CASTOR_WIRE(Type, ...) CASTOR_WIRE_DECLARE(Type, (__VA_ARGS__), __VA_ARGS__)

#define CASTOR_WIRE_EXCEPT(Type, kept, ...) \
  CASTOR_WIRE_DECLARE(Type, (CASTOR_WIRE_UNWRAP kept, __VA_ARGS__), __VA_ARGS__)

#define CASTOR_WIRE_UNWRAP(...) __VA_ARGS__
#define CASTOR_WIRE_MEMBER(Type, member) &Type::member

// A structured binding has as many names as the struct has members, or does not compile.
#define CASTOR_WIRE_DECLARE(Type, all, ...)                                                    \
  constexpr auto castor_wire_members(::castor::TypeTag<Type>) {                                \
    __VA_OPT__([[maybe_unused]] auto names_all = [](const Type& castor_wire_object) {          \
      [[maybe_unused]] const auto& [CASTOR_WIRE_UNWRAP all] = castor_wire_object;              \
    };)                                                                                        \
    using Result =                                                                             \
      ::castor::WireMembers<Type CASTOR_PP_FOR_EACH(CASTOR_WIRE_MEMBER, Type, __VA_ARGS__)>;   \
    static_assert(::std::is_empty_v<Type> == (::castor::detail::count_members(Result{}) == 0), \
                  "CASTOR_WIRE has to name all members of " #Type);                            \
    return Result{};                                                                           \
  }

#define CASTOR_WIRE_NULLABLE(Type, member) \
  template <>                              \
  inline constexpr bool is_nullable_member<&Type::member> = true;

#define CASTOR_WIRE_ENUM(Type, last)                               \
  static_assert(::castor::detail::is_last_enumerator<Type::last>,  \
                #last " is not the last enumerator of " #Type);    \
  constexpr Type castor_last_enumerator(::castor::TypeTag<Type>) { \
    return Type::last;                                             \
  }
