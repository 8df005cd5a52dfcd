#pragma once

#include "castor/wm/address.hpp"
#include "castor/wm/change_event.hpp"
#include "castor/wm/type_descriptor.hpp"

#include <compare>
#include <optional>
#include <string>

namespace castor {

/// Which change events a component wants: those that agree with every field that is set here.
///
/// Filters are data, so they can travel to the working memories where events arise. They are best
/// written with the functions below:
///
///     overwritten<SceneChanged>()                 in the component's own subarchitecture
///     added<SceneObject>().in("vision")           in another one
///     changed<ROI>().anywhere().from("tracker")   in all of them
struct ChangeFilter {
  std::optional<Operation> operation;
  /// A type or one of its super types; empty for any.
  std::string type;
  /// Empty for any.
  std::string id;
  /// The component that made the change; empty for any.
  std::string source;
  /// Nothing: the subarchitecture of the component that registers the filter. Empty: any.
  std::optional<std::string> subarchitecture;

  ChangeFilter anywhere() const {
    auto result = *this;
    result.subarchitecture = "";
    return result;
  }

  ChangeFilter in(std::string name) const {
    auto result = *this;
    result.subarchitecture = std::move(name);
    return result;
  }

  ChangeFilter from(std::string component) const {
    auto result = *this;
    result.source = std::move(component);
    return result;
  }

  ChangeFilter at(const Address& address) const {
    auto result = *this;
    result.subarchitecture = address.subarchitecture;
    result.id = address.id;
    return result;
  }

  friend auto operator<=>(const ChangeFilter&, const ChangeFilter&) = default;
};

/// Every change.
inline ChangeFilter any_change() {
  return {};
}

/// Every change of one entry, wherever it lies.
inline ChangeFilter changes_of(const Address& address) {
  return ChangeFilter{}.at(address);
}

/// Any change of entries of type T, or of a type that derives from it.
template <ReflectedRecord T>
ChangeFilter changed() {
  return {std::nullopt, type_name<T>(), {}, {}, {}};
}

template <ReflectedRecord T>
ChangeFilter added() {
  return {Operation::add, type_name<T>(), {}, {}, {}};
}

template <ReflectedRecord T>
ChangeFilter overwritten() {
  return {Operation::overwrite, type_name<T>(), {}, {}, {}};
}

template <ReflectedRecord T>
ChangeFilter deleted() {
  return {Operation::remove, type_name<T>(), {}, {}, {}};
}

/// Whether the filter wants the event. The filter's subarchitecture must have been resolved: one
/// that is not set matches nothing.
bool matches(const ChangeFilter& filter, const ChangeEvent& event);

/// "OVERWRITE of ROI in vision by tracker", for messages.
std::string to_string(const ChangeFilter& x);

} // namespace castor
