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
/// cheap to copy. The text is its identity, and how it travels: `parse(x.text()) == x`.
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
/// of two or three numbers. A comparison with an absent optional or with NaN is false, but for
/// `!=`, which is true; beyond that there are only true and false: `!(x > 1)` is true of an entry
/// without x. `has(x)` asks for presence alone.
class Predicate {
public:
  /// True of every entry.
  Predicate() = default;

  /// Throws PredicateError if the tree is too deep or its text too long.
  explicit Predicate(predicate::Node tree);

  /// Throws PredicateError, which marks the place in the text. The empty text is true of every
  /// entry.
  static Predicate parse(std::string_view text);

  /// Whether it is true of every entry by construction.
  bool empty() const { return rep_ == nullptr; }

  /// In the form that is the same for the same predicate.
  const std::string& text() const;

  /// Null if empty.
  const predicate::Node* tree() const;

  /// Throws FieldError unless every field that is named can be compared as it is here.
  void check(const TypeDescriptor& type) const;

  /// False of an entry that lacks the fields. For many entries of a type see BoundPredicate.
  bool matches(const Value& x) const;

  /// Throw PredicateError if the result would be too large. The negation of the empty predicate,
  /// which would be true of nothing, is refused too.
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
