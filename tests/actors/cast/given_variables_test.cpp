#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace castor::cast {

namespace {

using test::reports;
using test::World;

ParseResult parse_with(const std::string& variable, const std::string& text, World world = {}) {
  auto options = test::options_for(std::move(world));
  options.variables[variable] = "x";
  return parse_string(text + test::system_with(""), "main.cast", options);
}

TEST(GivenVariables, ThatTheFileDoesNotHaveAreRefusedWithTheNearestAndAll) {
  auto result = parse_with("sorce", "VARDEFAULT source=scene\nVARDEFAULT tracker=no\n");
  EXPECT_FALSE(result.ok());
  EXPECT_TRUE(reports(result, Severity::error, 0, "the file has no variable 'sorce'",
                      "did you mean 'source'? the file's variables are: source, tracker",
                      "command line"));
}

TEST(GivenVariables, MayBeThoseOfBlocksThatConditionsDisable) {
  for (auto* text : {"IFTRUE(no)\nSETVAR a=1\nENDIF\n", "IFTRUE(no)\n#EXPAND %(a)\nENDIF\n",
                     "IFTRUE(%(a))\nENDIF\n", "IFTRUE(no)\nIFEQ(%(a), 1)\nENDIF\nENDIF\n"})
    EXPECT_FALSE(
      reports(parse_with("a", text), Severity::error, 0, "no variable 'a'", {}, "command line"))
      << text;
}

TEST(GivenVariables, MayBeThoseOfIncludedFiles) {
  const World world{{{"part.cast", "VARDEFAULT a=1\n"}}, {}};
  EXPECT_TRUE(parse_with("a", "INCLUDE part.cast\n", world).ok());
  EXPECT_FALSE(parse_with("b", "INCLUDE part.cast\n", world).ok());
}

TEST(GivenVariables, OfCommentsAreNone) {
  EXPECT_FALSE(parse_with("a", "# %(a)\n").ok());
}

TEST(GivenVariables, AreNotMissedWhereAFileCouldNotBeRead) {
  auto result = parse_with("a", "INCLUDE nowhere.cast\n");
  EXPECT_TRUE(reports(result, Severity::error, 1, "cannot read"));
  EXPECT_FALSE(reports(result, Severity::error, 0, "the file has no variable", {}, "command line"));
}

TEST(GivenVariables, ThatOnlyTheParserSetsAreRefused) {
  EXPECT_TRUE(reports(parse_with("CONFIG_DIR", ""), Severity::error, 0,
                      "'CONFIG_DIR' is set by the parser alone", {}, "command line"));
}

TEST(OfferedVariables, NeedNotBeInTheFile) {
  auto options = test::options_for({});
  options.offered_variables = {{"output", "here"}, {"both", "offered"}};
  options.variables["both"] = "given";
  auto result =
    parse_string("#EXPAND %(output) %(both)\n" + test::system_with(""), "main.cast", options);
  EXPECT_TRUE(result.ok());
  EXPECT_EQ(result.expansions, std::vector<std::string>{"#EXPAND here given"});
  options.variables.clear();
  EXPECT_TRUE(parse_string(test::system_with(""), "main.cast", options).ok());
}

} // namespace

} // namespace castor::cast
