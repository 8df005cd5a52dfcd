#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/descriptor_of.hpp"
#include "castor/wm/values/reflect.hpp"

#include <compare>
#include <string>
#include <utility>

namespace castor {

/// A field of an entry that leads to another entry, in whatever working memory (the paper's pointer
/// entries). `follow(pointer)` reads it and checks the type.
template <class T>
struct EntryPointer {
  Address address;

  /// Whether the pointer is set.
  explicit operator bool() const { return !address.id.empty(); }

  friend auto operator<=>(const EntryPointer&, const EntryPointer&) = default;
};

template <class T>
constexpr auto castor_reflection(TypeTag<EntryPointer<T>>) {
  return record_reflection<EntryPointer<T>, void>(
    "EntryPointer", reflected_field<EntryPointer<T>>("address", &EntryPointer<T>::address));
}

/// A pointer to an entry whose type is only known when it is followed.
struct AnyEntryPointer {
  Address address;
  /// The type of the entry, as working memories know it.
  std::string type;

  AnyEntryPointer() = default;
  AnyEntryPointer(Address where, std::string what)
    : address(std::move(where)), type(std::move(what)) {}

  template <ReflectedRecord T>
  AnyEntryPointer(const EntryPointer<T>& x) : address(x.address), type(type_name<T>()) {}

  explicit operator bool() const { return !address.id.empty(); }

  /// Whether it was made for entries of type T.
  template <ReflectedRecord T>
  bool points_to() const {
    return type == type_name<T>();
  }

  template <ReflectedRecord T>
  EntryPointer<T> as() const {
    return {address};
  }

  friend auto operator<=>(const AnyEntryPointer&, const AnyEntryPointer&) = default;
};
CASTOR_REFLECT(AnyEntryPointer, address, type)

} // namespace castor
