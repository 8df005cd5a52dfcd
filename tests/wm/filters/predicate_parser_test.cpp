#include "castor/wm/filters/predicate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace castor::test {

namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string canonical(std::string_view text) {
  return Predicate::parse(text).text();
}

/// The complaint about a text, which must be refused.
std::string complaint(std::string_view text) {
  try {
    Predicate::parse(text);
  } catch (const PredicateError& e) {
    return e.what();
  }
  return "no complaint";
}

std::size_t position(std::string_view text) {
  try {
    Predicate::parse(text);
  } catch (const PredicateError& e) {
    return e.position();
  }
  return text.size() + 1;
}

std::string repeated(const std::string& x, int n) {
  std::string result;
  for (int i = 0; i < n; ++i)
    result += x;
  return result;
}

} // namespace

TEST(PredicateParser, ReadsNothingAsTheEmptyPredicate) {
  EXPECT_TRUE(Predicate::parse("").empty());
  EXPECT_TRUE(Predicate::parse(" \n\t").empty());
  EXPECT_EQ(canonical(""), "");
}

TEST(PredicateParser, ReadsEveryComparison) {
  for (auto op : {"==", "!=", "<", "<=", ">", ">="}) {
    auto text = std::string{"a.b "} + op + " 1";
    EXPECT_EQ(canonical(text), text);
  }
  EXPECT_EQ(canonical("a<=b"), "a <= b");
}

TEST(PredicateParser, PutsLiteralsOnTheRight) {
  EXPECT_EQ(canonical("1 < a"), "a > 1");
  EXPECT_EQ(canonical("1 <= a"), "a >= 1");
  EXPECT_EQ(canonical("1 > a"), "a < 1");
  EXPECT_EQ(canonical("1 >= a"), "a <= 1");
  EXPECT_EQ(canonical("\"x\" == a"), "a == \"x\"");
  EXPECT_EQ(canonical("1 != distance(a, b)"), "distance(a, b) != 1");
}

TEST(PredicateParser, ReadsNumbers) {
  EXPECT_EQ(canonical("a == 1.0"), "a == 1");
  EXPECT_EQ(canonical("a == +1"), "a == 1");
  EXPECT_EQ(canonical("a == -0.0"), "a == 0");
  EXPECT_EQ(canonical("a == 0.80"), "a == 0.8");
  EXPECT_EQ(canonical("a == .5"), "a == 0.5");
  EXPECT_EQ(canonical("a == 1e3"), "a == 1000");
  EXPECT_EQ(canonical("a == 18446744073709551615"), "a == 18446744073709551615");
  EXPECT_EQ(canonical("a == -9223372036854775808"), "a == -9223372036854775808");
  EXPECT_EQ(canonical("a == 9223372036854775808.0"), "a == 9223372036854775808");
  EXPECT_EQ(canonical("a == 1e300"), "a == 1e+300");
  EXPECT_EQ(canonical("a < 1e4000"), "a < 1e999");
  EXPECT_EQ(canonical("a < -1e999"), "a < -1e999");
  EXPECT_EQ(canonical("a < 1e-4000"), "a < 0");
}

TEST(PredicateParser, ReadsTexts) {
  EXPECT_EQ(canonical(R"(a == "x\"y\\z")"), R"(a == "x\"y\\z")");
  EXPECT_EQ(canonical(R"(a == "\n\t\r\x41\xff")"), "a == \"\\n\\t\\x0dA\xff\"");
  EXPECT_EQ(canonical("a == \"\xc3\xa9 && !\""), "a == \"\xc3\xa9 && !\"");
  EXPECT_EQ(canonical(std::string{"a == \"\0\"", 8}), "a == \"\\x00\"");
}

TEST(PredicateParser, ReadsTruthValues) {
  EXPECT_EQ(canonical("a"), "a");
  EXPECT_EQ(canonical("a == true"), "a");
  EXPECT_EQ(canonical("true == a"), "a");
  EXPECT_EQ(canonical("a == false"), "a == false");
  EXPECT_EQ(canonical("a != true"), "a != true");
  EXPECT_EQ(canonical("!a"), "!a");
  EXPECT_EQ(canonical("truth"), "truth");
}

TEST(PredicateParser, LetsAndBindMoreThanOr) {
  EXPECT_EQ(canonical("a && b || c && d"), "a && b || c && d");
  EXPECT_EQ(canonical("a && (b || c) && d"), "a && (b || c) && d");
  EXPECT_EQ(canonical("(a && b) || (c && d)"), "a && b || c && d");
  EXPECT_EQ(canonical("(a && (b && (c)))"), "a && b && c");
  EXPECT_EQ(canonical("a || (b || c)"), "a || b || c");
}

TEST(PredicateParser, LetsNotBindMost) {
  EXPECT_EQ(canonical("!a && b"), "!a && b");
  EXPECT_EQ(canonical("!(a && b)"), "!(a && b)");
  EXPECT_EQ(canonical("!(a == 1)"), "!(a == 1)");
  EXPECT_EQ(canonical("!!a"), "a");
  EXPECT_EQ(canonical("!!!has(a)"), "!has(a)");
}

TEST(PredicateParser, ReadsFunctions) {
  EXPECT_EQ(canonical("has ( a.b )"), "has(a.b)");
  EXPECT_EQ(canonical("distance( a , [ 1 , 2.0 ] )<0.5"), "distance(a, [1, 2]) < 0.5");
  EXPECT_EQ(canonical("distance([1,2,-3e-1],a)<b"), "distance([1, 2, -0.3], a) < b");
  EXPECT_EQ(canonical("distance(a,b)>distance(c,d)"), "distance(a, b) > distance(c, d)");
}

TEST(PredicateParser, KnowsFieldsThatAreNamedLikeFunctions) {
  EXPECT_EQ(canonical("has > distance"), "has > distance");
  EXPECT_EQ(canonical("has && distance.has == 1"), "has && distance.has == 1");
}

TEST(PredicateParser, SaysWhatWasExpectedAndWhere) {
  EXPECT_EQ(complaint("a > && label == \"b\""),
            "expected a field, a number, a \"text\", true, false, has(...), distance(...), ! or ( "
            "at character 5 of the predicate:\n"
            "  a > && label == \"b\"\n"
            "      ^");
  EXPECT_EQ(position("a > && label"), 4u);
  EXPECT_THAT(complaint("a = 1"), StartsWith("expected =="));
  EXPECT_THAT(complaint("a 1"), StartsWith("expected &&, || or the end"));
  EXPECT_THAT(complaint("a & b"), StartsWith("expected &&, || or the end"));
  EXPECT_THAT(complaint("(a"), StartsWith("expected )"));
  EXPECT_THAT(complaint("a)"), StartsWith("expected &&, || or the end"));
  EXPECT_THAT(complaint("a. == 1"), StartsWith("expected the name of a field"));
  EXPECT_THAT(complaint("a =="), StartsWith("expected a field or a literal"));
  EXPECT_THAT(complaint("1"), StartsWith("expected a comparison"));
  EXPECT_THAT(complaint("true"), StartsWith("expected a comparison"));
  EXPECT_THAT(complaint("1 == 2"), StartsWith("expected a field on one side"));
  EXPECT_THAT(complaint("size(a) == 2"), StartsWith("expected has(...) or distance(...)"));
  EXPECT_THAT(complaint("distance([1, 2], [3, 4]) < 1"), StartsWith("expected a field as one"));
  EXPECT_THAT(complaint("distance(a, [1]) < 1"), StartsWith("expected a second coordinate"));
  EXPECT_THAT(complaint("distance(a, [1, 2, 3, 4]) < 1"), StartsWith("expected ]"));
  EXPECT_THAT(complaint("distance(a, [x, 2]) < 1"), StartsWith("expected a number"));
  EXPECT_THAT(complaint("distance(a) < 1"), StartsWith("expected ,"));
  EXPECT_THAT(complaint("distance(a, b)"), StartsWith("expected a comparison"));
  EXPECT_THAT(complaint("a == 1x"), StartsWith("expected a number"));
  EXPECT_THAT(complaint("a == -inf"), StartsWith("expected a number"));
  EXPECT_THAT(complaint("a == 1.2.3"), StartsWith("expected a number"));
  EXPECT_THAT(complaint("a == \"b"), StartsWith("expected a closing \""));
  EXPECT_THAT(complaint("a == \"\\q\""), StartsWith("expected one of the escapes"));
  EXPECT_THAT(complaint("a == \"\\x4\""), StartsWith("expected one of the escapes"));
  EXPECT_THAT(complaint("a == \"\\"), StartsWith("expected one of the escapes"));
}

TEST(PredicateParser, ShowsThePartOfALongTextThatIsWrong) {
  auto text = repeated("abc == 1 && ", 100) + "?" + repeated(" && abc == 1", 100);
  auto message = complaint(text);
  EXPECT_LT(message.size(), 300u);
  EXPECT_THAT(message, HasSubstr("at character 1201"));
  auto last_line = message.substr(message.rfind('\n'));
  auto shown = message.substr(message.rfind('\n', message.rfind('\n') - 1));
  EXPECT_EQ(shown[last_line.find('^')], '?');
}

TEST(PredicateParser, KeepsTheMessageOnItsLines) {
  EXPECT_THAT(complaint("a\n>\n&&"), HasSubstr("\n  a > &&\n"));
}

TEST(PredicateParser, RefusesWhatIsTooLong) {
  EXPECT_THAT(complaint(repeated("a && ", 20'000)), HasSubstr("too long; the limit is 65536"));
  EXPECT_EQ(complaint(repeated("a && ", 10'000) + "a"), "no complaint");
}

TEST(PredicateParser, RefusesWhatIsTooDeep) {
  EXPECT_EQ(canonical(repeated("(", 100) + "a" + repeated(")", 100)), "a");
  EXPECT_THAT(complaint(repeated("(", 30'000)), HasSubstr("nested deeper than"));
  EXPECT_THAT(complaint(repeated("!", 60'000)), HasSubstr("nested deeper than"));
  auto deep = [](int n) { return repeated("a && (b || ", n) + "c" + repeated(")", n); };
  EXPECT_EQ(complaint(deep(49)), "no complaint");
  EXPECT_EQ(canonical(canonical(deep(49))), canonical(deep(49)));
  EXPECT_THAT(complaint(deep(51)), HasSubstr("no deeper than 100"));
}

} // namespace castor::test
