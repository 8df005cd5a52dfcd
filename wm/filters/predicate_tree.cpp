#include "castor/wm/filters/predicate_tree.hpp"

#include "castor/wm/filters/predicate_error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

namespace castor::predicate {

namespace {

bool is_literal(const Operand& x) {
  return std::holds_alternative<FieldValue>(x);
}

/// The comparison with its sides exchanged.
Comparison mirrored(Comparison op) {
  switch (op) {
    case Comparison::less:
      return Comparison::greater;
    case Comparison::less_equal:
      return Comparison::greater_equal;
    case Comparison::greater:
      return Comparison::less;
    case Comparison::greater_equal:
      return Comparison::less_equal;
    default:
      return op;
  }
}

std::string text_of(double x) {
  // No number is written as infinity; this one is read as it.
  if (std::isinf(x))
    return x > 0 ? "1e999" : "-1e999";
  char buffer[32];
  return {buffer, std::to_chars(buffer, std::end(buffer), x).ptr};
}

std::string text_of(const FieldValue& x) {
  return std::visit(
    [](const auto& v) -> std::string {
      using T = std::decay_t<decltype(v)>;
      if constexpr (std::is_same_v<T, bool>)
        return v ? "true" : "false";
      else if constexpr (std::is_same_v<T, std::string>)
        return quoted(v);
      else if constexpr (std::is_same_v<T, double>)
        return text_of(v);
      else if constexpr (std::is_same_v<T, std::monostate>)
        return {};
      else
        return std::to_string(v);
    },
    x);
}

std::string text_of(const std::variant<Path, Point>& x) {
  if (auto* path = std::get_if<Path>(&x))
    return path->text;
  std::string result;
  for (auto coordinate : std::get<Point>(x))
    result += (result.empty() ? "[" : ", ") + text_of(normalised(coordinate));
  return result + ']';
}

std::string text_of(const Operand& x) {
  if (auto* literal = std::get_if<FieldValue>(&x))
    return text_of(*literal);
  if (auto* path = std::get_if<Path>(&x))
    return path->text;
  auto& d = std::get<Distance>(x);
  return "distance(" + text_of(d.from) + ", " + text_of(d.to) + ')';
}

std::string text_of(const Condition& x) {
  auto* literal = std::get_if<FieldValue>(&x.right);
  if (std::holds_alternative<Path>(x.left) && x.op == Comparison::equal && literal &&
      *literal == FieldValue{true})
    return text_of(x.left);
  return text_of(x.left) + ' ' + std::string{to_string(x.op)} + ' ' + text_of(x.right);
}

std::string text_of(const Presence& x) {
  return "has(" + x.path.text + ')';
}

std::string text_of(const Junction& x) {
  std::string result;
  for (auto& part : x.parts) {
    result += result.empty() ? "" : x.all ? " && " : " || ";
    // A junction inside is of the other kind; only `||` inside `&&` needs the parentheses.
    bool binds_less = x.all && std::holds_alternative<Junction>(part.content);
    result += binds_less ? '(' + to_string(part) + ')' : to_string(part);
  }
  return result;
}

std::string text_of(const Negation& x) {
  auto inner = to_string(x.part.front());
  auto* c = std::get_if<Condition>(&x.part.front().content);
  bool is_bare =
    std::holds_alternative<Presence>(x.part.front().content) || (c && inner == text_of(c->left));
  return is_bare ? '!' + inner : "!(" + inner + ')';
}

bool has_nan(const Point& x) {
  return std::any_of(x.begin(), x.end(), [](double c) { return std::isnan(c); });
}

} // namespace

Node condition(Operand left, Comparison op, Operand right) {
  if (is_literal(left) && is_literal(right))
    throw PredicateError("a comparison needs a field on one side at least");
  if (is_literal(left)) {
    std::swap(left, right);
    op = mirrored(op);
  }
  if (auto* literal = std::get_if<FieldValue>(&right)) {
    if (auto* real = std::get_if<double>(literal); real && std::isnan(*real))
      throw PredicateError("a field is compared with NaN, which nothing equals: compare it with a "
                           "number");
    right = normalised(std::move(*literal));
  }
  return {Condition{std::move(left), op, std::move(right)}};
}

Distance distance(std::variant<Path, Point> from, std::variant<Path, Point> to) {
  auto* a = std::get_if<Point>(&from);
  auto* b = std::get_if<Point>(&to);
  if (a && b)
    throw PredicateError("a distance needs a field on one side at least");
  if ((a && has_nan(*a)) || (b && has_nan(*b)))
    throw PredicateError("a distance is measured from a point with a coordinate NaN");
  return {std::move(from), std::move(to)};
}

Node junction(bool all, std::vector<Node> parts) {
  Junction result{all, {}};
  for (auto& part : parts) {
    auto* inner = std::get_if<Junction>(&part.content);
    if (inner && inner->all == all)
      std::move(inner->parts.begin(), inner->parts.end(), std::back_inserter(result.parts));
    else
      result.parts.push_back(std::move(part));
  }
  if (result.parts.size() == 1)
    return std::move(result.parts.front());
  return {std::move(result)};
}

Node negation(Node x) {
  if (auto* twice = std::get_if<Negation>(&x.content)) {
    auto inner = std::move(twice->part.front());
    return inner;
  }
  Negation result;
  result.part.push_back(std::move(x));
  return {std::move(result)};
}

std::string to_string(const Node& x) {
  return std::visit([](const auto& content) { return text_of(content); }, x.content);
}

std::string_view to_string(Comparison x) {
  switch (x) {
    case Comparison::equal:
      return "==";
    case Comparison::not_equal:
      return "!=";
    case Comparison::less:
      return "<";
    case Comparison::less_equal:
      return "<=";
    case Comparison::greater:
      return ">";
    case Comparison::greater_equal:
      return ">=";
  }
  return "?";
}

std::string quoted(std::string_view x) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string result = "\"";
  for (char c : x) {
    auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (code < 0x20 || code == 0x7f)
      result += {'\\', 'x', digits[code >> 4], digits[code & 15]};
    else
      result += c;
  }
  return result + '"';
}

int depth(const Node& x) {
  int below = 0;
  auto look_into = [&](const std::vector<Node>& parts) {
    for (auto& part : parts)
      below = std::max(below, depth(part));
  };
  if (auto* junction = std::get_if<Junction>(&x.content))
    look_into(junction->parts);
  else if (auto* negation = std::get_if<Negation>(&x.content))
    look_into(negation->part);
  return below + 1;
}

} // namespace castor::predicate
