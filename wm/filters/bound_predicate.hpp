#pragma once

#include "castor/wm/values/field_access.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <optional>
#include <variant>
#include <vector>

namespace castor {

namespace predicate {
struct Node;
}

/// A predicate whose fields were resolved for one type: it is evaluated on values of that type
/// without looking up names.
class BoundPredicate {
public:
  /// `tree` is null for the empty predicate. Throws FieldError if the type lacks a field, or a
  /// field cannot be compared as required.
  BoundPredicate(const predicate::Node* tree, const TypeDescriptor& type);

  /// As the constructor; nothing instead of an exception.
  static std::optional<BoundPredicate> try_bind(const predicate::Node* tree,
                                                const TypeDescriptor& type);

  /// Whether a value of that type matches; reads single fields, without encoding or decoding the
  /// whole. False for a value that came as bytes that do not fit its type.
  bool matches(const Value& x) const;

  using Coordinate = std::variant<double, FieldPath>;

  struct Distance {
    std::vector<Coordinate> from;
    std::vector<Coordinate> to;
  };

  using Operand = std::variant<FieldValue, FieldPath, Distance>;

  struct Condition {
    Operand left;
    Comparison op = Comparison::equal;
    Operand right;
  };

  struct Node;

  struct Junction {
    bool all = true;
    std::vector<Node> parts;
  };

  struct Negation {
    std::vector<Node> part;
  };

  struct Node {
    /// A FieldPath alone tests for the field's presence.
    std::variant<Condition, FieldPath, Junction, Negation> content;
  };

private:
  /// Empty, or the root alone.
  std::vector<Node> root_;
};

} // namespace castor
