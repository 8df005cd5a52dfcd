#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/filters/predicate_builder.hpp"
#include "castor/wm/values/descriptor_of.hpp"
#include "castor/wm/values/field_mask.hpp"
#include "castor/wm/values/value.hpp"

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

/// Selects the change events that a component wants: those that match every field set here.
///
/// Filters are data, so they can be sent to the working memories where events occur. They are best
/// written with the functions below:
///
///     overwritten<SceneChanged>()                 in the component's own subarchitecture
///     added<SceneObject>().in("vision")           in another one
///     changed<ROI>().anywhere().from("tracker")   in all of them
///     changed(&SceneObject::pose)                 overwrites that changed the pose
///     added<SceneObject>().where(&SceneObject::label, "box")
///     changed<SceneObject>().where("confidence > 0.8 && label == \"box\"")
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
  /// Only overwrites that changed one of these fields, sorted by name; empty for any change.
  std::vector<std::string> changing;
  /// Condition on the entry's content: the new one, or the last one before a deletion. Entries of a
  /// type without the fields do not match.
  Predicate predicate;

  ChangeFilter anywhere() const;
  ChangeFilter in(std::string name) const;
  ChangeFilter from(std::string component) const;
  ChangeFilter at(const Address& address) const;

  /// Adds a condition. Throws PredicateError if the text is not a predicate.
  ChangeFilter where(std::string_view text) const { return where(Predicate::parse(text)); }
  ChangeFilter where(const Predicate& condition) const;

  /// Adds fields of which at least one must have changed.
  ChangeFilter changing_any(std::vector<std::string> names) const;

  friend auto operator<=>(const ChangeFilter&, const ChangeFilter&) = default;
};

/// A filter for entries of type T (or of a derived type), with conditions on its fields.
template <ReflectedRecord T>
class ChangeFilterOf : public ChangeFilter {
public:
  explicit ChangeFilterOf(ChangeFilter x) : ChangeFilter(std::move(x)) { type = type_name<T>(); }

  ChangeFilterOf anywhere() const { return ChangeFilterOf{ChangeFilter::anywhere()}; }
  ChangeFilterOf in(std::string name) const {
    return ChangeFilterOf{ChangeFilter::in(std::move(name))};
  }
  ChangeFilterOf from(std::string component) const {
    return ChangeFilterOf{ChangeFilter::from(std::move(component))};
  }
  ChangeFilterOf at(const Address& address) const {
    return ChangeFilterOf{ChangeFilter::at(address)};
  }

  /// Adds a condition on the fields of T, those of its bases included.
  template <detail::PredicateExpression X>
  requires FieldOwner<typename X::Root, T> ChangeFilterOf where(const X& condition)
  const { return with(detail::as_predicate(condition)); }

  /// The field equals the value.
  template <ReflectedRecord Owner, class Member, class V>
  requires FieldOwner<Owner, T> ChangeFilterOf where(Member Owner::*member, const V& value)
  const requires requires { field(member) == value; }
  { return with(field(member) == value); }

  /// Throws PredicateError, and FieldError if the condition does not fit T.
  ChangeFilterOf where(std::string_view text) const { return with(PredicateOf<T>::parse(text)); }

  /// Only overwrites that changed one of these members.
  template <ReflectedRecord... Owner, class... Member>
  requires(sizeof...(Member) > 0 && (FieldOwner<Owner, T> && ...)) ChangeFilterOf
    changing(Member Owner::*... members)
  const { return ChangeFilterOf{changing_any({std::string{field_name(members)}...})}; }

private:
  ChangeFilterOf with(const Predicate& condition) const {
    return ChangeFilterOf{ChangeFilter::where(condition)};
  }
};

/// Every change.
inline ChangeFilter any_change() {
  return {};
}

/// Every change of one entry, in any subarchitecture.
inline ChangeFilter changes_of(const Address& address) {
  return ChangeFilter{}.at(address);
}

/// Every change by one kind of operation.
ChangeFilter changes_by(Operation operation);

/// Any change of entries of type T, or of a derived type.
template <ReflectedRecord T>
ChangeFilterOf<T> changed() {
  return ChangeFilterOf<T>{any_change()};
}

template <ReflectedRecord T>
ChangeFilterOf<T> added() {
  return ChangeFilterOf<T>{changes_by(Operation::add)};
}

template <ReflectedRecord T>
ChangeFilterOf<T> overwritten() {
  return ChangeFilterOf<T>{changes_by(Operation::overwrite)};
}

template <ReflectedRecord T>
ChangeFilterOf<T> deleted() {
  return ChangeFilterOf<T>{changes_by(Operation::remove)};
}

/// Overwrites that changed one of these members, of entries of the type that declares the first (or
/// of a derived type). For a member of a base see `ChangeFilterOf::changing`.
template <ReflectedRecord T, class First, ReflectedRecord... Owner, class... Member>
requires(FieldOwner<Owner, T>&&...) ChangeFilterOf<T> changed(First T::*first,
                                                              Member Owner::*... others) {
  return overwritten<T>().changing(first, others...);
}

/// Whether the filter matches the event of an entry with that content: the new one, or the last one
/// before a deletion. Without content, a filter with a predicate does not match. The filter's
/// subarchitecture must have been resolved: an unset one matches nothing.
bool matches(const ChangeFilter& filter, const ChangeEvent& event, const Value& content);

/// Whether the filter matches the event's operation, address, source and type.
bool matches_envelope(const ChangeFilter& filter, const ChangeEvent& event);

/// Whether the filter matches the event's changed fields.
bool matches_changes(const ChangeFilter& filter, const ChangeEvent& event);

/// "OVERWRITE of ROI in vision by tracker, changing area, where colour == \"red\"", for messages.
std::string to_string(const ChangeFilter& x);

} // namespace castor
