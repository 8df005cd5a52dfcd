#include "castor/tests/wm/filters/random_predicates.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace castor::test {

namespace {

constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
constexpr auto infinity = std::numeric_limits<double>::infinity();

template <class T>
T pick(Random& random, const std::vector<T>& from) {
  return from[between<std::size_t>(random, 0, from.size() - 1)];
}

double random_number(Random& random) {
  return pick<double>(random, {-2, -1, -0.5, -0.0, 0, 0.5, 1, 1.5, 2, 3, nan, infinity, -infinity,
                               9007199254740993.0, 1e300});
}

Point random_point(Random& random) {
  auto x = [&] { return pick<double>(random, {-1, 0, 0.5, 1, 2, nan}); };
  return {x(), x(), static_cast<float>(pick<double>(random, {0, 0.5, 1}))};
}

struct NumberLiteral {
  std::string text;
  long double value;
};

NumberLiteral random_literal(Random& random) {
  return pick<NumberLiteral>(random, {{"-2", -2},
                                      {"-1.0", -1},
                                      {"-.5", -0.5L},
                                      {"0", 0},
                                      {"-0.0", 0},
                                      {"5e-1", 0.5L},
                                      {"1", 1},
                                      {"+1.5", 1.5L},
                                      {"2", 2},
                                      {"3", 3},
                                      {"18446744073709551615", 18446744073709551615.0L},
                                      {"9007199254740992", 9007199254740992.0L},
                                      {"1e999", infinity},
                                      {"-1e999", -infinity}});
}

/// The operators, and their meaning for operands of any type.
const std::vector<std::string> operators{"==", "!=", "<", "<=", ">", ">="};

template <class A, class B>
bool apply(const std::string& op, const A& a, const B& b) {
  if (op == "==")
    return a == b;
  if (op == "!=")
    return a != b;
  if (op == "<")
    return a < b;
  if (op == "<=")
    return a <= b;
  if (op == ">")
    return a > b;
  return a >= b;
}

/// A number of a thing; NaN if absent, which compares alike.
struct NumberField {
  std::string path;
  long double (*get)(const Thing&);
};

const std::vector<NumberField> number_fields{
  {"number", [](const Thing& x) -> long double { return x.number; }},
  {"narrow", [](const Thing& x) -> long double { return x.narrow; }},
  {"whole", [](const Thing& x) -> long double { return x.whole; }},
  {"large", [](const Thing& x) -> long double { return static_cast<long double>(x.large); }},
  {"place.x", [](const Thing& x) -> long double { return x.place.x; }},
  {"maybe", [](const Thing& x) -> long double { return x.maybe.value_or(nan); }},
  {"pose.heading", [](const Thing& x) -> long double { return x.pose ? x.pose->heading : nan; }},
};

RandomPredicate number_condition(Random& random) {
  auto field = pick(random, number_fields);
  auto literal = random_literal(random);
  auto op = pick(random, operators);
  if (random() % 4 == 0)
    return {literal.text + op + field.path,
            [=](const Thing& x) { return apply(op, literal.value, field.get(x)); }};
  return {field.path + ' ' + op + ' ' + literal.text,
          [=](const Thing& x) { return apply(op, field.get(x), literal.value); }};
}

RandomPredicate number_comparison(Random& random) {
  auto a = pick(random, number_fields);
  auto b = pick(random, number_fields);
  auto op = pick(random, operators);
  return {a.path + op + b.path, [=](const Thing& x) { return apply(op, a.get(x), b.get(x)); }};
}

RandomPredicate range(Random& random) {
  auto field = pick(random, number_fields);
  auto low = random_literal(random);
  auto high = random_literal(random);
  return {field.path + " > " + low.text + " && " + field.path + " <= " + high.text,
          [=](const Thing& x) { return field.get(x) > low.value && field.get(x) <= high.value; }};
}

RandomPredicate text_condition(Random& random) {
  auto literal = pick<std::string>(random, {"", "a", "b", "b\"\\\n"});
  auto text = pick<std::string>(random, {"\"" + literal + "\""});
  if (literal.size() > 1)
    text = R"("b\"\\\n")";
  auto op = pick(random, operators);
  return {"name " + op + text, [=](const Thing& x) { return apply(op, x.name, literal); }};
}

RandomPredicate side_condition(Random& random) {
  auto side = pick<std::pair<std::string, Side>>(
    random, {{"left", Side::left}, {"right", Side::right}, {"both", Side::both}});
  bool equal = random() % 2 == 0;
  return {(equal ? "side == \"" : "side != \"") + side.first + '"',
          [=](const Thing& x) { return (x.side == side.second) == equal; }};
}

RandomPredicate flag_condition(Random& random) {
  switch (random() % 3) {
    case 0:
      return {"flag", [](const Thing& x) { return x.flag; }};
    case 1:
      return {"flag == false", [](const Thing& x) { return !x.flag; }};
    default:
      return {"flag != true", [](const Thing& x) { return !x.flag; }};
  }
}

RandomPredicate presence(Random& random) {
  switch (random() % 3) {
    case 0:
      return {"has(maybe)", [](const Thing& x) { return x.maybe.has_value(); }};
    case 1:
      return {"has( pose.position )", [](const Thing& x) { return x.pose.has_value(); }};
    default:
      return {"has(name)", [](const Thing&) { return true; }};
  }
}

double measured(double x, double y, double z) {
  return std::isnan(x) || std::isnan(y) || std::isnan(z) ? nan : std::hypot(x, y, z);
}

RandomPredicate distance_condition(Random& random) {
  auto op = pick(random, operators);
  auto limit = random_literal(random);
  auto end = ") " + op + limit.text;
  auto from_place = [](const Thing& x, const Point& p) {
    return measured(x.place.x - p.x, x.place.y - p.y, double{x.place.z} - double{p.z});
  };
  switch (random() % 3) {
    case 0: {
      Point p{static_cast<double>(random() % 3), static_cast<double>(random() % 2), 0.5f};
      auto text = '[' + std::to_string(p.x) + ", " + std::to_string(p.y) + ",0.5]";
      return {"distance(place, " + text + end,
              [=](const Thing& x) { return apply(op, from_place(x, p), limit.value); }};
    }
    case 1:
      return {"distance(place, pose.position" + end, [=](const Thing& x) {
                return apply(op, x.pose ? from_place(x, x.pose->position) : nan, limit.value);
              }};
    default:
      return {"distance([1,0.5], spot" + end, [=](const Thing& x) {
                return apply(op, measured(1 - x.spot[0], 0.5 - x.spot[1], 0), limit.value);
              }};
  }
}

RandomPredicate condition(Random& random) {
  switch (random() % 10) {
    case 0:
    case 1:
      return number_condition(random);
    case 2:
      return number_comparison(random);
    case 3:
      return range(random);
    case 4:
    case 5:
      return text_condition(random);
    case 6:
      return side_condition(random);
    case 7:
      return flag_condition(random);
    case 8:
      return presence(random);
    default:
      return distance_condition(random);
  }
}

} // namespace

Thing random_thing(Random& random) {
  Thing x;
  x.name = pick<std::string>(random, {"", "a", "b", "b\"\\\n", "c"});
  x.number = random_number(random);
  x.narrow = static_cast<float>(pick<double>(random, {-1, 0, 0.5, 1, 1.5}));
  x.whole = between(random, -2, 3);
  x.large = pick<std::uint64_t>(random, {0, 1, 2, 9007199254740992ull, 18446744073709551615ull});
  x.flag = random() % 2 == 0;
  x.side = pick<Side>(random, {Side::left, Side::right, Side::both, static_cast<Side>(200)});
  x.place = random_point(random);
  if (random() % 2 == 0)
    x.maybe = random_number(random);
  if (random() % 2 == 0)
    x.pose = Pose{random_point(random), random_number(random)};
  x.spot = {static_cast<double>(random() % 3), 0.5};
  return x;
}

RandomPredicate random_predicate(Random& random, int depth) {
  if (depth == 0 || random() % 4 == 0) {
    // A range is two conditions: where it stands, it must bind like one.
    auto result = condition(random);
    result.text = '(' + result.text + ')';
    return result;
  }
  auto a = random_predicate(random, depth - 1);
  auto b = random_predicate(random, depth - 1);
  switch (random() % 4) {
    case 0:
      return {"!" + a.text, [=](const Thing& x) { return !a.is_true(x); }};
    case 1:
      return {'(' + a.text + " ||" + b.text + ')',
              [=](const Thing& x) { return a.is_true(x) || b.is_true(x); }};
    default:
      return {'(' + a.text + "&& " + b.text + ')',
              [=](const Thing& x) { return a.is_true(x) && b.is_true(x); }};
  }
}

} // namespace castor::test
