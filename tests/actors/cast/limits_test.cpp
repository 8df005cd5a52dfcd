#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <ostream>
#include <string>

namespace castor::cast {

namespace {

using test::options_for;
using test::reports;

std::string repeat(const std::string& text, std::size_t times) {
  std::string result;
  result.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i)
    result += text;
  return result;
}

TEST(Limits, RefuseLongLinesOnly) {
  auto options = options_for({});
  options.limits.line_bytes = 100;
  auto result =
    parse_string(std::string(101, 'x') + "\n" + test::system_with(""), "main.cast", options);
  EXPECT_TRUE(reports(result, Severity::error, 1, "longer than 100 bytes"));
  EXPECT_EQ(result.diagnostics.size(), 1U);
}

TEST(Limits, RefuseLargeFiles) {
  auto options = options_for({});
  options.limits.total_bytes = 100;
  auto result = parse_string(std::string(101, '\n'), "main.cast", options);
  EXPECT_TRUE(reports(result, Severity::error, 0, "longer than 100 bytes together"));
  EXPECT_EQ(result.diagnostics.size(), 1U);
}

TEST(Limits, CountFilesEachTimeTheyAreIncluded) {
  auto options = options_for({{{"a.cast", std::string(40, '\n')}}, {}});
  options.limits.total_bytes = 150;
  auto text = repeat("INCLUDE a.cast\n", 4);
  auto result = parse_string(text, "main.cast", options);
  EXPECT_TRUE(reports(result, Severity::error, 0, "150 bytes together", "over and over", "a.cast"));
}

TEST(Limits, RefuseManyLines) {
  auto options = options_for({});
  options.limits.lines = 10;
  auto result = parse_string(repeat("#\n", 20), "main.cast", options);
  EXPECT_TRUE(reports(result, Severity::error, 10, "more than 10 lines"));
  EXPECT_EQ(result.diagnostics.size(), 1U);
}

TEST(Limits, BoundTheDepthOfIncludes) {
  auto options = options_for({});
  options.limits.include_depth = 5;
  options.load = [](const std::string& path, std::size_t) -> FileContent {
    return {"INCLUDE x" + path, {}};
  };
  auto result = parse_file("main.cast", options);
  EXPECT_TRUE(
    reports(result, Severity::error, 1, "more than 5 levels deep", "cycle", "xxxxxmain.cast"));
}

TEST(Limits, BoundIncludesThatDouble) {
  test::World world;
  for (int i = 0; i < 40; ++i) {
    auto next = "INCLUDE f" + std::to_string(i + 1) + "\n";
    world.files["f" + std::to_string(i)] = next + next;
  }
  world.files["f40"] = "";
  auto options = options_for(world);
  options.limits.lines = 10'000;
  auto result = parse_file("f0", options);
  EXPECT_EQ(result.diagnostics.size(), 1U) << render(result.diagnostics);
  EXPECT_FALSE(result.ok());
}

TEST(Limits, RefuseLongPaths) {
  auto result = test::parse("INCLUDE " + std::string(5000, 'x'));
  EXPECT_TRUE(reports(result, Severity::error, 1, "path is longer than 4096 bytes"));
}

TEST(Limits, BoundVariablesThatDouble) {
  std::string text = "SETVAR a=0123456789\n" + repeat("SETVAR a=%(a)%(a)\n", 100);
  auto result = test::parse(text);
  EXPECT_TRUE(reports(result, Severity::error, 18, "longer than 1048576 bytes",
                      "contain others several times"));
  EXPECT_FALSE(result.ok());
}

TEST(Limits, BoundEveryUseOfVariables) {
  auto options = options_for({});
  options.limits.line_bytes = 100;
  std::string begin = "SETVAR a=" + std::string(60, 'x') + "\n";
  for (std::string line : {"SETVAR b=%(a)%(a)", "SETOPT a=y%(a)", "IFTRUE(%(a)%(a))\nENDIF",
                           "IFEQ(%(a)%(a), b)\nENDIF", "IFOPTALL(b, %(a)%(a))\nENDIF",
                           "HOSTNAME A %(a)%(a)", "HOST %(a)%(a)", "#EXPAND %(a)%(a)"}) {
    auto result = parse_string(begin + line, "main.cast", options);
    EXPECT_TRUE(reports(result, Severity::error, 2, "longer than 100 bytes")) << line;
    EXPECT_EQ(result.diagnostics.size(), 1U) << line << "\n" << render(result.diagnostics);
  }
}

TEST(Limits, BoundAllExpansionsTogether) {
  auto options = options_for({});
  options.limits.expanded_bytes = 1000;
  auto text = "SETVAR a=" + std::string(100, 'x') + "\n" + repeat("#EXPAND %(a)\n", 100);
  auto result = parse_string(text, "main.cast", options);
  EXPECT_TRUE(reports(result, Severity::error, 10, "produced more than 1000 bytes"));
  EXPECT_EQ(result.diagnostics.size(), 1U);
}

TEST(Limits, BoundMultilineValues) {
  auto options = options_for({});
  options.limits.line_bytes = 100;
  auto text = "SETVAR a=<multiline>\n" + repeat("0123456789\n", 20) + "</multiline>\n" +
              test::system_with("");
  auto result = parse_string(text, "main.cast", options);
  EXPECT_TRUE(reports(result, Severity::error, 1, "longer than 100 bytes"));
  EXPECT_EQ(result.diagnostics.size(), 1U);
}

TEST(Limits, BoundTheNumberOfDiagnostics) {
  auto result = test::parse(repeat("nonsense\n", 10'000));
  EXPECT_EQ(result.diagnostics.size(), 201U);
  EXPECT_EQ(result.diagnostics.back().severity, Severity::note);
  EXPECT_EQ(result.diagnostics.back().message, "9800 more finding(s) are not listed");
}

TEST(Limits, DoNotLetWarningsHideErrors) {
  auto result = test::parse(test::system_with(repeat("CPP TM T\n", 1000)) + "nonsense");
  EXPECT_FALSE(result.ok());
  EXPECT_TRUE(reports(result, Severity::error, 1005, "incomplete"));
  EXPECT_EQ(result.diagnostics.size(), 201U);
}

/// Processor time for a parse of `text`, in seconds.
double seconds(const std::string& text) {
  auto begin = std::clock();
  auto result = test::parse(text);
  auto end = std::clock();
  EXPECT_LE(result.diagnostics.size(), 201U);
  return static_cast<double>(end - begin) / CLOCKS_PER_SEC;
}

/// Inputs on which a careless parser takes quadratic time. Each would need minutes or hours then,
/// so a generous bound tells even on a slow machine under sanitizers.
struct Hostile {
  const char* name;
  /// Made when it is needed: these texts are long, and every test's process registers them all.
  std::string (*make)();

  friend void PrintTo(const Hostile& x, std::ostream* out) { *out << x.name; }
};

class HostileInput : public testing::TestWithParam<Hostile> {};

TEST_P(HostileInput, IsParsedInLinearTime) {
  EXPECT_LT(seconds(GetParam().make()), 20.0);
}

INSTANTIATE_TEST_SUITE_P(
  Limits, HostileInput,
  testing::Values(
    Hostile{"NestedConditions", [] { return repeat("IFTRUE(0)\n", 100'000); }},
    Hostile{"Alternatives", [] { return repeat("IFTRUE(0)\nELSE\n", 100'000); }},
    Hostile{"UnclosedParentheses", [] { return "SETVAR a=" + repeat("%(", 400'000); }},
    Hostile{"UndefinedVariables", [] { return "SETVAR a=" + repeat("%(x)", 200'000); }},
    Hostile{"ParenthesesInConditions", [] { return "IFTRUE(" + repeat(")  ", 300'000) + ")"; }},
    Hostile{"UnendedMultilineValues", [] { return repeat("SETVAR a=<multiline>\n", 100'000); }},
    Hostile{"GrowingOptions", [] { return repeat("SETOPT a=some-flag !%(a)\n", 20'000); }},
    Hostile{"ManyFlags",
            [] {
              return "SETVAR a=" + repeat("f ", 400'000) + "\nSETOPT a=" + repeat("f ", 400'000) +
                     "\nIFOPTALL(%(a), " + repeat("f ", 400'000) + ")";
            }},
    Hostile{"ManyOptions",
            [] { return test::system_with("CPP MG a A " + repeat("-x 1 ", 100'000)); }},
    Hostile{"StrayValues",
            [] {
              return test::system_with("CPP MG a A -x " + std::string(400'000, 'y') +
                                       repeat(" z", 200'000));
            }},
    Hostile{"OpenQuotes", [] { return test::system_with(repeat("CPP MG a A -x \" y\n", 50'000)); }},
    Hostile{"LongQuote",
            [] { return test::system_with("CPP MG a A -x \"" + repeat(" y", 400'000) + "\""); }},
    Hostile{"ManySubarchitectures", [] { return repeat("SUBARCHITECTURE s\n", 50'000); }},
    Hostile{"Misspellings", [] { return repeat("SUBARCHITECURE s\n", 50'000); }},
    Hostile{"MissingFiles", [] { return repeat("INCLUDE missing\n", 100'000); }}),
  [](const auto& test) { return test.param.name; });

TEST(HostileInputs, WithManyDifferentNamesAreParsedInLinearTime) {
  std::string text = "HOST h\n";
  for (int i = 0; i < 20'000; ++i) {
    auto n = std::to_string(i);
    text += "SETVAR v" + n + "=%(w" + n + ")\nSUBARCHITECTURE s" + n + "\nCPP WM W\nCPP TM T\n" +
            "CPP MG c" + n + " C\nACCESS s" + n + " WRITES t" + n + "\n";
  }
  EXPECT_LT(seconds(text), 20.0);
}

} // namespace

} // namespace castor::cast
