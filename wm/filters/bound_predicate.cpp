#include "castor/wm/filters/bound_predicate.hpp"

#include "castor/wm/filters/predicate_tree.hpp"
#include "castor/wm/values/point_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace castor {

namespace {

using Bound = BoundPredicate;

/// What can be compared with one another.
enum class Family { number, truth, text };

std::string name_of(Family x) {
  switch (x) {
    case Family::number:
      return "a number";
    case Family::truth:
      return "a truth value";
    case Family::text:
      return "a text";
  }
  return "unknown";
}

Family family_of(WireKind kind) {
  if (kind == WireKind::boolean)
    return Family::truth;
  return is_number(kind) ? Family::number : Family::text;
}

Family family_of(const FieldValue& literal) {
  if (std::holds_alternative<bool>(literal))
    return Family::truth;
  return std::holds_alternative<std::string>(literal) ? Family::text : Family::number;
}

/// An operand, and what is known of it.
struct Side {
  Bound::Operand operand;
  Family family = Family::number;
  /// For an enumeration.
  const EnumDescriptor* enumeration = nullptr;
  /// For messages.
  std::string name;
};

class Binder {
public:
  explicit Binder(const TypeDescriptor& type) : type_(type) {}

  Bound::Node bind(const predicate::Node& x) const {
    return std::visit([this](const auto& content) { return Bound::Node{bind(content)}; },
                      x.content);
  }

private:
  Bound::Condition bind(const predicate::Condition& x) const {
    auto left = side(x.left);
    auto right = side(x.right);
    if (left.family != right.family)
      throw FieldError(left.name + " is " + name_of(left.family) + " and cannot be compared with " +
                       right.name + ", " + name_of(right.family));
    check_enumeration(left, x.op, right);
    check_enumeration(right, x.op, left);
    return {std::move(left.operand), x.op, std::move(right.operand)};
  }

  FieldPath bind(const predicate::Presence& x) const { return find_field(type_, x.path.text).path; }

  Bound::Junction bind(const predicate::Junction& x) const {
    Bound::Junction result{x.all, {}};
    for (auto& part : x.parts)
      result.parts.push_back(bind(part));
    return result;
  }

  Bound::Negation bind(const predicate::Negation& x) const {
    Bound::Negation result;
    result.part.push_back(bind(x.part.front()));
    return result;
  }

  Side side(const predicate::Operand& x) const {
    if (auto* literal = std::get_if<FieldValue>(&x))
      return {*literal, family_of(*literal), nullptr, text_of(*literal)};
    if (auto* path = std::get_if<predicate::Path>(&x))
      return side(*path);
    auto& d = std::get<predicate::Distance>(x);
    Bound::Distance result{point(d.from), point(d.to)};
    if (result.from.size() != result.to.size())
      throw FieldError("a distance is measured between a point of " +
                       std::to_string(result.from.size()) + " coordinates and one of " +
                       std::to_string(result.to.size()));
    return {std::move(result), Family::number, nullptr, "a distance"};
  }

  Side side(const predicate::Path& path) const {
    auto place = find_field(type_, path.text);
    auto kind = place.type->kind;
    if (!is_single(kind))
      throw FieldError(path.text + " of " + type_.name() + " is " +
                       (kind == WireKind::record ? "a record" : "a list") +
                       " and cannot be compared as a whole: name one of its fields");
    auto* enumeration =
      kind == WireKind::enumeration ? &type_.enums.at(place.type->index) : nullptr;
    return {std::move(place.path), family_of(kind), enumeration, path.text + " of " + type_.name()};
  }

  static std::string text_of(const FieldValue& literal) {
    if (auto* text = std::get_if<std::string>(&literal))
      return predicate::quoted(*text);
    return std::holds_alternative<bool>(literal) ? "true or false" : "a literal";
  }

  /// A name that the enumeration lacks is a mistake, and so is an order among its names.
  static void check_enumeration(const Side& side, Comparison op, const Side& other) {
    if (!side.enumeration)
      return;
    if (op != Comparison::equal && op != Comparison::not_equal)
      throw FieldError(side.name + " is an enumeration, which has no order: use == or !=");
    auto* literal = std::get_if<FieldValue>(&other.operand);
    if (!literal)
      return;
    auto& name = std::get<std::string>(*literal);
    std::string known;
    for (auto& enumerator : side.enumeration->enumerators) {
      if (enumerator.first == name)
        return;
      known += (known.empty() ? "" : ", ") + enumerator.first;
    }
    // An enumerator without a name is known by its number.
    if (name.empty() || name.find_first_not_of("-0123456789") != name.npos)
      throw FieldError(side.enumeration->name + " has no enumerator " + predicate::quoted(name) +
                       "; it has " + known);
  }

  std::vector<Bound::Coordinate>
  point(const std::variant<predicate::Path, predicate::Point>& x) const {
    if (auto* literal = std::get_if<predicate::Point>(&x))
      return {literal->begin(), literal->end()};
    auto fields = find_point(type_, std::get<predicate::Path>(x).text);
    return {fields.begin(), fields.end()};
  }

  const TypeDescriptor& type_;
};

double coordinate(const Bound::Coordinate& x, const Value& value) {
  if (auto* literal = std::get_if<double>(&x))
    return *literal;
  return as_double(value.field(std::get<FieldPath>(x)));
}

/// NaN, which compares like an absent field, if one of the points is absent.
double distance(const Bound::Distance& x, const Value& value) {
  double d[3] = {0, 0, 0};
  for (std::size_t i = 0; i < x.from.size(); ++i)
    d[i] = coordinate(x.from[i], value) - coordinate(x.to[i], value);
  // The hypotenuse of infinity and NaN would be infinity.
  if (std::any_of(d, d + 3, [](double c) { return std::isnan(c); }))
    return std::numeric_limits<double>::quiet_NaN();
  return std::hypot(d[0], d[1], d[2]);
}

/// What the operand is of the value; `scratch` holds what had to be made.
const FieldValue& evaluate(const Bound::Operand& x, const Value& value, FieldValue& scratch) {
  if (auto* literal = std::get_if<FieldValue>(&x))
    return *literal;
  if (auto* path = std::get_if<FieldPath>(&x))
    scratch = value.field(*path);
  else
    scratch = distance(std::get<Bound::Distance>(x), value);
  return scratch;
}

bool holds(const Bound::Node& x, const Value& value);

bool holds(const Bound::Condition& x, const Value& value) {
  FieldValue a;
  FieldValue b;
  return compare(evaluate(x.left, value, a), x.op, evaluate(x.right, value, b));
}

bool holds(const FieldPath& x, const Value& value) {
  return value.has_field(x);
}

bool holds(const Bound::Junction& x, const Value& value) {
  auto part_holds = [&](const Bound::Node& part) { return holds(part, value); };
  return x.all ? std::all_of(x.parts.begin(), x.parts.end(), part_holds)
               : std::any_of(x.parts.begin(), x.parts.end(), part_holds);
}

bool holds(const Bound::Negation& x, const Value& value) {
  return !holds(x.part.front(), value);
}

bool holds(const Bound::Node& x, const Value& value) {
  return std::visit([&](const auto& content) { return holds(content, value); }, x.content);
}

} // namespace

BoundPredicate::BoundPredicate(const predicate::Node* tree, const TypeDescriptor& type) {
  if (tree)
    root_.push_back(Binder{type}.bind(*tree));
}

std::optional<BoundPredicate> BoundPredicate::try_bind(const predicate::Node* tree,
                                                       const TypeDescriptor& type) {
  try {
    return BoundPredicate{tree, type};
  } catch (const FieldError&) {
    return std::nullopt;
  }
}

bool BoundPredicate::matches(const Value& x) const {
  try {
    return root_.empty() || holds(root_.front(), x);
  } catch (const DecodeError&) {
    return false;
  }
}

} // namespace castor
