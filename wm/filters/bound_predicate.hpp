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

/// A predicate whose fields were looked up in one type: for the values of that type, it evaluates
/// without looking at a name again.
class BoundPredicate {
public:
  /// Of the predicate's tree, null for the empty one. Throws FieldError if the type lacks a field,
  /// or has one that cannot be compared as wanted.
  BoundPredicate(const predicate::Node* tree, const TypeDescriptor& type);

  /// Nothing where the constructor throws.
  static std::optional<BoundPredicate> try_bind(const predicate::Node* tree,
                                                const TypeDescriptor& type);

  /// Of a value of that type: nothing is encoded or decoded as a whole. A value that came as bytes
  /// that are not what its type says matches nothing.
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
    /// The path stands for its presence.
    std::variant<Condition, FieldPath, Junction, Negation> content;
  };

private:
  /// Nothing, or the one root.
  std::vector<Node> root_;
};

} // namespace castor
