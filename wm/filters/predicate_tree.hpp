#pragma once

#include "castor/wm/values/field_access.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What a predicate consists of. Users write predicates as text or with `field(...)`; this is for
/// those who take them apart.
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

/// At least one side is no literal, and `left` is not.
struct Condition {
  Operand left;
  Comparison op = Comparison::equal;
  Operand right;
};

/// Whether a field is there: it, and the optionals on the way to it.
struct Presence {
  Path path;
};

struct Node;

/// All of several nodes, or any of them: two at least, none of which is a junction of the same
/// kind.
struct Junction {
  bool all = true;
  std::vector<Node> parts;
};

/// Of one node, which is no negation.
struct Negation {
  std::vector<Node> part;
};

struct Node {
  std::variant<Condition, Presence, Junction, Negation> content;
};

/// Puts a literal on the right and normalises it. Throws PredicateError if both sides are literals
/// or one is not a number (NaN), with which nothing could be compared.
Node condition(Operand left, Comparison op, Operand right);

/// Throws PredicateError if neither side is a field, or if a literal has a coordinate that is not a
/// number.
Distance distance(std::variant<Path, Point> from, std::variant<Path, Point> to);

Node junction(bool all, std::vector<Node> parts);

Node negation(Node x);

/// The one text of a node: what has the same text is the same.
std::string to_string(const Node& x);

std::string_view to_string(Comparison x);

/// In double quotes, with escapes for what would not stand on one line.
std::string quoted(std::string_view x);

/// How many nodes lie below one another.
int depth(const Node& x);

} // namespace castor::predicate
