#include "castor/wm/filters/predicate_parser.hpp"

#include "castor/wm/filters/predicate_error.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>

namespace castor {

namespace {

using namespace predicate;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool continues_name(char c) {
  return begins_name(c) || is_digit(c);
}

int hex_digit(char c) {
  if (is_digit(c))
    return c - '0';
  if (c >= 'a' && c <= 'f')
    return c - 'a' + 10;
  if (c >= 'A' && c <= 'F')
    return c - 'A' + 10;
  return -1;
}

/// A recursive descent through the grammar that stands at `Predicate`.
class Parser {
public:
  explicit Parser(std::string_view text) : text_(text) {
    if (text.size() > max_text)
      throw PredicateError("a predicate of " + std::to_string(text.size()) +
                           " characters is too long; the limit is " + std::to_string(max_text));
  }

  std::optional<Node> parse() {
    skip_space();
    if (at_end())
      return std::nullopt;
    auto result = alternative();
    if (!at_end())
      fail("expected &&, || or the end");
    return result;
  }

private:
  /// A negation in parentheses takes two steps but is one node.
  static constexpr int max_nesting = 2 * max_depth;

  Node alternative() {
    std::vector<Node> parts;
    do
      parts.push_back(conjunction());
    while (accept("||"));
    return junction(false, std::move(parts));
  }

  Node conjunction() {
    std::vector<Node> parts;
    do
      parts.push_back(unary());
    while (accept("&&"));
    return junction(true, std::move(parts));
  }

  Node unary() {
    if (nesting_ == max_nesting)
      fail("nested deeper than " + std::to_string(max_nesting));
    ++nesting_;
    auto result = nested_unary();
    --nesting_;
    return result;
  }

  Node nested_unary() {
    if (!at("!=") && accept("!"))
      return negation(unary());
    if (accept("(")) {
      auto result = alternative();
      expect(")");
      return result;
    }
    if (at_call("has")) {
      expect("(");
      Presence result{path()};
      expect(")");
      return {std::move(result)};
    }
    return comparison();
  }

  Node comparison() {
    auto begin = at_;
    auto left = operand();
    auto op = comparison_operator();
    if (!op) {
      if (std::holds_alternative<Path>(left))
        return condition(std::move(left), Comparison::equal, FieldValue{true});
      fail("expected a comparison (== != < <= > >=)");
    }
    auto right = operand();
    if (std::holds_alternative<FieldValue>(left) && std::holds_alternative<FieldValue>(right))
      fail("expected a field on one side of the comparison", begin);
    return condition(std::move(left), *op, std::move(right));
  }

  std::optional<Comparison> comparison_operator() {
    // The longer ones first: one begins with another.
    for (auto op : {Comparison::equal, Comparison::not_equal, Comparison::less_equal,
                    Comparison::greater_equal, Comparison::less, Comparison::greater})
      if (accept(to_string(op)))
        return op;
    if (at("="))
      fail("expected ==");
    return std::nullopt;
  }

  Operand operand() {
    if (at_end())
      fail("expected a field or a literal");
    char c = text_[at_];
    if (c == '"')
      return FieldValue{quoted_text()};
    if (begins_number(c))
      return number();
    if (at_call("distance"))
      return distance_between();
    if (!begins_name(c))
      fail("expected a field, a number, a \"text\", true, false, has(...), distance(...), ! or (");
    auto begin = at_;
    auto name = path();
    if (name.text == "true" || name.text == "false")
      return FieldValue{name.text == "true"};
    if (at("("))
      fail("expected has(...) or distance(...), the only functions", begin);
    return name;
  }

  Distance distance_between() {
    auto begin = at_;
    expect("(");
    auto from = point();
    expect(",");
    auto to = point();
    expect(")");
    if (std::holds_alternative<Point>(from) && std::holds_alternative<Point>(to))
      fail("expected a field as one of the points", begin);
    return distance(std::move(from), std::move(to));
  }

  std::variant<Path, Point> point() {
    if (!accept("["))
      return path();
    Point result;
    do
      result.push_back(coordinate());
    while (result.size() < 3 && accept(","));
    if (result.size() < 2)
      fail("expected a second coordinate");
    expect("]");
    return result;
  }

  double coordinate() {
    if (at_end() || !begins_number(text_[at_]))
      fail("expected a number");
    return std::visit(
      [](const auto& x) -> double {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(x)>>)
          return static_cast<double>(x);
        else
          return 0;
      },
      number());
  }

  Path path() {
    auto begin = at_;
    for (;;) {
      if (at_end() || !begins_name(text_[at_]))
        fail("expected the name of a field");
      while (!at_end() && continues_name(text_[at_]))
        ++at_;
      if (at_end() || text_[at_] != '.')
        break;
      ++at_;
    }
    Path result{std::string{text_.substr(begin, at_ - begin)}};
    skip_space();
    return result;
  }

  static bool begins_number(char c) { return is_digit(c) || c == '-' || c == '+' || c == '.'; }

  FieldValue number() {
    auto begin = at_;
    if (text_[at_] == '-' || text_[at_] == '+')
      ++at_;
    if (at_end() || !(is_digit(text_[at_]) || text_[at_] == '.'))
      fail("expected a number", begin);
    ++at_;
    while (!at_end() && continues_number(text_[at_], text_[at_ - 1]))
      ++at_;
    auto digits = text_.substr(begin, at_ - begin);
    if (digits.front() == '+')
      digits.remove_prefix(1);
    FieldValue result;
    // What is too large or too small for a double is infinity or zero, as arithmetic has it.
    if (!(read<std::int64_t>(digits, result) || read<std::uint64_t>(digits, result) ||
          read<double>(digits, result) || read<long double, double>(digits, result)))
      fail("expected a number", begin);
    skip_space();
    return result;
  }

  static bool continues_number(char c, char before) {
    return continues_name(c) || c == '.' ||
           ((c == '-' || c == '+') && (before == 'e' || before == 'E'));
  }

  template <class T, class Stored = T>
  static bool read(std::string_view digits, FieldValue& out) {
    T x{};
    auto* end = digits.data() + digits.size();
    auto [stop, error] = std::from_chars(digits.data(), end, x);
    if (error != std::errc{} || stop != end)
      return false;
    out = static_cast<Stored>(x);
    return true;
  }

  std::string quoted_text() {
    auto begin = at_++;
    std::string result;
    for (;;) {
      if (at_end())
        fail("expected a closing \" to this one", begin);
      char c = text_[at_++];
      if (c == '"')
        break;
      result += c == '\\' ? escaped() : c;
    }
    skip_space();
    return result;
  }

  char escaped() {
    char c = at_end() ? '\0' : text_[at_++];
    switch (c) {
      case '"':
      case '\\':
        return c;
      case 'n':
        return '\n';
      case 't':
        return '\t';
      case 'r':
        return '\r';
      case 'x':
        if (text_.size() - at_ >= 2 && hex_digit(text_[at_]) >= 0 &&
            hex_digit(text_[at_ + 1]) >= 0) {
          auto code = hex_digit(text_[at_]) * 16 + hex_digit(text_[at_ + 1]);
          at_ += 2;
          return static_cast<char>(code);
        }
        [[fallthrough]];
      default:
        fail("expected one of the escapes \\\" \\\\ \\n \\t \\r \\xHH", at_ - 1);
    }
  }

  bool at_end() const { return at_ == text_.size(); }

  bool at(std::string_view token) const { return text_.substr(at_).starts_with(token); }

  bool accept(std::string_view token) {
    if (!at(token))
      return false;
    at_ += token.size();
    skip_space();
    return true;
  }

  void expect(std::string_view token) {
    if (!accept(token))
      fail("expected " + std::string{token});
  }

  /// Steps over the name of a function before its parenthesis; anywhere else it is a field.
  bool at_call(std::string_view function) {
    auto begin = at_;
    if (accept(function) && at("("))
      return true;
    at_ = begin;
    return false;
  }

  void skip_space() {
    while (!at_end() && std::string_view{" \t\r\n"}.find(text_[at_]) != std::string_view::npos)
      ++at_;
  }

  [[noreturn]] void fail(const std::string& what) const { fail(what, at_); }

  /// Shows the surroundings of the place on a line of their own, and marks it below.
  [[noreturn]] void fail(const std::string& what, std::size_t position) const {
    constexpr std::size_t reach = 40;
    auto begin = position > reach ? position - reach : 0;
    auto shown = std::string{text_.substr(begin, position - begin + reach)};
    std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
    throw PredicateError(what + " at character " + std::to_string(position + 1) +
                           " of the predicate:\n  " + shown + "\n  " +
                           std::string(position - begin, ' ') + '^',
                         position);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int nesting_ = 0;
};

} // namespace

std::optional<Node> parse_predicate(std::string_view text) {
  return Parser{text}.parse();
}

} // namespace castor
