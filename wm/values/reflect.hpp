#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

/// The declaration of an entry type: written once beside the struct, it yields the type's
/// descriptor, its encoding, its JSON form and its field names.
///
///     struct Box { double width = 0; std::string label; };
///     CASTOR_REFLECT(Box, width, label)
///
///     struct PaintedBox : Box { std::string colour; };
///     CASTOR_REFLECT_DERIVED(PaintedBox, Box, colour)
///
///     enum class Side { left, right };
///     CASTOR_REFLECT_ENUM(Side, left, right)
///
/// The macros stand in the namespace of the type, after it. A type is identified by its unqualified
/// name; a value of another type of that name with different fields is refused.
namespace castor {

template <class T>
struct TypeTag {};

template <class Owner, class Member>
struct ReflectedField {
  std::string_view name;
  Member Owner::*member;
};

template <class Owner, class Member>
constexpr ReflectedField<Owner, Member> reflected_field(std::string_view name,
                                                        Member Owner::*member) {
  return {name, member};
}

/// The declaration of a struct; `Base` is void for a type without one.
template <class T, class Base, class... Members>
struct RecordReflection {
  using BaseType = Base;
  std::string_view name;
  std::tuple<ReflectedField<T, Members>...> fields;
};

template <class T, class Base, class... Members>
constexpr RecordReflection<T, Base, Members...>
record_reflection(std::string_view name, ReflectedField<T, Members>... fields) {
  return {name, {fields...}};
}

template <class T, std::size_t N>
struct EnumReflection {
  std::string_view name;
  std::pair<std::string_view, T> enumerators[N];
};

template <class T, class... Pairs>
constexpr EnumReflection<T, sizeof...(Pairs)> enum_reflection(std::string_view name,
                                                              Pairs... pairs) {
  return {name, {pairs...}};
}

/// A struct that was declared with CASTOR_REFLECT or CASTOR_REFLECT_DERIVED.
template <class T>
concept ReflectedRecord = std::is_class_v<T> && requires {
  castor_reflection(TypeTag<T>{});
};

/// An enumeration that was declared with CASTOR_REFLECT_ENUM.
template <class T>
concept ReflectedEnum = std::is_enum_v<T> && requires {
  castor_reflection(TypeTag<T>{});
};

template <class T>
constexpr auto reflection_of() {
  return castor_reflection(TypeTag<T>{});
}

/// Calls `f(name, member reference)` for every field, those of the bases first.
template <ReflectedRecord T, class Object, class F>
void for_each_field(Object& object, F&& f) {
  static constexpr auto reflection = reflection_of<T>();
  using Base = typename decltype(reflection_of<T>())::BaseType;
  if constexpr (!std::is_void_v<Base>)
    for_each_field<Base>(object, f);
  std::apply([&](const auto&... field) { (f(field.name, object.*field.member), ...); },
             reflection.fields);
}

} // namespace castor

// The preprocessor rescans the list 4 * 4 * 4 times: enough for 64 fields.
#define CASTOR_PP_EXPAND(...) \
  CASTOR_PP_EXPAND3(CASTOR_PP_EXPAND3(CASTOR_PP_EXPAND3(CASTOR_PP_EXPAND3(__VA_ARGS__))))
#define CASTOR_PP_EXPAND3(...) \
  CASTOR_PP_EXPAND2(CASTOR_PP_EXPAND2(CASTOR_PP_EXPAND2(CASTOR_PP_EXPAND2(__VA_ARGS__))))
#define CASTOR_PP_EXPAND2(...) \
  CASTOR_PP_EXPAND1(CASTOR_PP_EXPAND1(CASTOR_PP_EXPAND1(CASTOR_PP_EXPAND1(__VA_ARGS__))))
#define CASTOR_PP_EXPAND1(...) __VA_ARGS__
#define CASTOR_PP_PARENS ()
#define CASTOR_PP_EACH_AGAIN() CASTOR_PP_EACH
#define CASTOR_PP_EACH(macro, type, x, ...) \
  , macro(type, x) __VA_OPT__(CASTOR_PP_EACH_AGAIN CASTOR_PP_PARENS(macro, type, __VA_ARGS__))
#define CASTOR_PP_FOR_EACH(macro, type, ...) \
  __VA_OPT__(CASTOR_PP_EXPAND(CASTOR_PP_EACH(macro, type, __VA_ARGS__)))

#define CASTOR_PP_FIELD(type, field) ::castor::reflected_field<type>(#field, &type::field)
#define CASTOR_PP_ENUMERATOR(type, name)  \
  ::std::pair<::std::string_view, type> { \
#name, type::name                     \
  }

#define CASTOR_REFLECT_DERIVED(Type, Base, ...)                      \
  constexpr auto castor_reflection(::castor::TypeTag<Type>) {        \
    return ::castor::record_reflection<Type, Base>(                  \
      #Type CASTOR_PP_FOR_EACH(CASTOR_PP_FIELD, Type, __VA_ARGS__)); \
  }

#define CASTOR_REFLECT(Type, ...) CASTOR_REFLECT_DERIVED(Type, void __VA_OPT__(, ) __VA_ARGS__)

#define CASTOR_REFLECT_ENUM(Type, ...)                                    \
  constexpr auto castor_reflection(::castor::TypeTag<Type>) {             \
    return ::castor::enum_reflection<Type>(                               \
      #Type CASTOR_PP_FOR_EACH(CASTOR_PP_ENUMERATOR, Type, __VA_ARGS__)); \
  }
