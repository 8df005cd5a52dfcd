#pragma once

#include "castor/wm/values/field_access.hpp"
#include "castor/wm/values/reflect.hpp"

#include <string>
#include <string_view>

namespace castor {

/// Name of a declared member. Throws FieldError if it was left out of the declaration: such a
/// member is not part of the entry.
template <ReflectedRecord T, class Member>
std::string_view field_name(Member T::*member) {
  static constexpr auto reflection = reflection_of<T>();
  std::string_view result;
  auto look_at = [&]<class Other>(const ReflectedField<T, Other>& field) {
    if constexpr (std::is_same_v<Member, Other>)
      if (field.member == member)
        result = field.name;
  };
  std::apply([&](const auto&... field) { (look_at(field), ...); }, reflection.fields);
  if (result.empty())
    throw FieldError("this member of " + std::string{reflection.name} +
                     " is no field: add it to the type's CASTOR_REFLECT");
  return result;
}

/// Whether entries of type `T` have the fields of `Owner`.
template <class Owner, class T>
concept FieldOwner = ReflectedRecord<Owner> && ReflectedRecord<T> && std::is_base_of_v<Owner, T>;

} // namespace castor
