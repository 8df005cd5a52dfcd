#pragma once

#include "castor/wm/values/field_access.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Syntax tree of a predicate, for code that analyses predicates. Users write predicates as text or
/// with `field(...)`.
namespace castor::predicate {

/// "pose.position.x"
struct Path {
  std::string text;
};

/// Two or three coordinates.
using Point = std::vector<double>;

/// The Euclidean distance between two points, at least one of which is a field.
struct Distance {
  std::variant<Path, Point> from;
  std::variant<Path, Point> to;
};

/// A literal (normalised, see `normalised`), a field, or a distance.
using Operand = std::variant<FieldValue, Path, Distance>;

/// A comparison. `left` is never a literal.
struct Condition {
  Operand left;
  Comparison op = Comparison::equal;
  Operand right;
};

/// Test that neither a field nor an optional on the way to it is empty.
struct Presence {
  Path path;
};

struct Node;

/// Conjunction (`all`) or disjunction of at least two nodes, none of which is a junction of the
/// same kind.
struct Junction {
  bool all = true;
  std::vector<Node> parts;
};

/// Negation of one node, which is not a negation itself.
struct Negation {
  std::vector<Node> part;
};

struct Node {
  std::variant<Condition, Presence, Junction, Negation> content;
};

/// Puts a literal on the right and normalises it. Throws PredicateError if both sides are literals
/// or one is NaN, which nothing equals.
Node condition(Operand left, Comparison op, Operand right);

/// Throws PredicateError if neither side is a field, or if a literal has a coordinate that is NaN.
Distance distance(std::variant<Path, Point> from, std::variant<Path, Point> to);

Node junction(bool all, std::vector<Node> parts);

Node negation(Node x);

/// Canonical text of a node: equal nodes have equal texts.
std::string to_string(const Node& x);

std::string_view to_string(Comparison x);

/// The text in double quotes, with escapes.
std::string quoted(std::string_view x);

/// Depth of the tree, in nodes.
int depth(const Node& x);

} // namespace castor::predicate
