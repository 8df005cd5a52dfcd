#pragma once

#include "castor/wm/filters/predicate_error.hpp"
#include "castor/wm/values/type_descriptor.hpp"

#include <compare>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace castor {

class Value;

namespace predicate {
struct Node;
}

/// A condition over the fields of an entry:
///
///     confidence > 0.8 && label == "box"
///     distance(pose.position, [1, 2, 0]) < 0.5 || !has(pose)
///
/// Built from text here or from members with `field(...)` (predicate_builder.hpp). Immutable and
/// cheap to copy. Predicates are compared and sent as their texts: `parse(x.text()) == x`.
///
///     or          and || and ...
///     and         unary && unary ...
///     unary       !unary, (or), has(PATH), a comparison, or the PATH of a truth value
///     comparison  operand == operand, likewise != < <= > >=
///     operand     PATH, a number, "text" with the escapes \" \\ \n \t \r \xHH, true, false,
///                 distance(point, point)
///     point       PATH, [NUMBER, NUMBER] or [NUMBER, NUMBER, NUMBER]
///
/// Comparisons are those of `compare` (field_access.hpp): numbers by value whatever their types,
/// enumerators by name. A point is a record with the number fields x, y and perhaps z, or an array
/// of two or three numbers. A comparison with an absent optional or with NaN is false, except `!=`,
/// which is true. There is no third truth value: `!(x > 1)` is true of an entry without x. `has(x)`
/// tests for presence alone.
class Predicate {
public:
  /// True of every entry.
  Predicate() = default;

  /// Throws PredicateError if the tree is too deep or its text too long.
  explicit Predicate(predicate::Node tree);

  /// Throws PredicateError, whose message marks the place in the text. The empty text is true of
  /// every entry.
  static Predicate parse(std::string_view text);

  /// Whether it is the empty predicate, which is true of every entry.
  bool empty() const { return rep_ == nullptr; }

  /// Canonical text: equal predicates have equal texts.
  const std::string& text() const;

  /// Null if empty.
  const predicate::Node* tree() const;

  /// Throws FieldError unless the type has every field of the predicate, comparable as required.
  void check(const TypeDescriptor& type) const;

  /// Whether the predicate is true of a value; false if its type lacks the fields. For many values
  /// of a type see BoundPredicate.
  bool matches(const Value& x) const;

  /// Throw PredicateError if the result would be too large, and for the negation of the empty
  /// predicate, which would never be true.
  friend Predicate operator&&(const Predicate& a, const Predicate& b);
  friend Predicate operator||(const Predicate& a, const Predicate& b);
  Predicate operator!() const;

  friend bool operator==(const Predicate& a, const Predicate& b) { return a.text() == b.text(); }
  friend auto operator<=>(const Predicate& a, const Predicate& b) { return a.text() <=> b.text(); }

private:
  struct Rep;

  std::shared_ptr<const Rep> rep_;
};

} // namespace castor
