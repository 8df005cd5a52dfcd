#include "castor/actors/cast/arguments.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace castor::cast {

namespace {

using test::reports;
using test::World;
using Options = std::vector<std::pair<std::string, std::string>>;

ParseResult parse_with(const std::string& arguments, World world = {}) {
  return test::parse(test::system_with("CPP MG a A " + arguments), std::move(world));
}

Options options_of(const std::string& arguments, World world = {}) {
  auto result = parse_with(arguments, std::move(world));
  Options options;
  if (!result.ok())
    return {{"error", render(result.diagnostics)}};
  for (const auto& option : result.architecture->component("a")->options)
    options.emplace_back(option.key, option.value);
  return options;
}

TEST(Arguments, AreKeysWithValues) {
  EXPECT_EQ(options_of("--min-area 40 -v x"), (Options{{"--min-area", "40"}, {"-v", "x"}}));
}

TEST(Arguments, MayBeAbsent) {
  EXPECT_EQ(options_of(""), Options{});
  EXPECT_EQ(options_of("# --log"), Options{});
}

TEST(Arguments, WithoutAValueAreTrue) {
  EXPECT_EQ(options_of("--log --debug false -x"),
            (Options{{"--log", "true"}, {"--debug", "false"}, {"-x", "true"}}));
}

TEST(Arguments, EndAtAWordThatBeginsWithAHash) {
  EXPECT_EQ(options_of("--log #--debug"), (Options{{"--log", "true"}}));
  EXPECT_EQ(options_of("--log # a \"b"), (Options{{"--log", "true"}}));
  EXPECT_EQ(options_of("--name a#b --other"), (Options{{"--name", "a#b"}, {"--other", "true"}}));
}

TEST(Arguments, MayBeQuoted) {
  EXPECT_EQ(options_of("-s \"what's   brown\" -x"),
            (Options{{"-s", "what's brown"}, {"-x", "true"}}));
  EXPECT_EQ(options_of("-s \"one\""), (Options{{"-s", "one"}}));
  EXPECT_EQ(options_of("-s \"\""), (Options{{"-s", ""}}));
  EXPECT_EQ(options_of("-s \" a \""), (Options{{"-s", " a "}}));
  EXPECT_EQ(options_of("-s \"a \""), (Options{{"-s", "a "}}));
}

TEST(Arguments, MayHoldAnythingInQuotes) {
  EXPECT_EQ(options_of("-s \"-5\" -t \"a # b -c\""), (Options{{"-s", "-5"}, {"-t", "a # b -c"}}));
}

TEST(Arguments, HaveNoEscapes) {
  EXPECT_EQ(options_of("-s \"a\\\" -t b"), (Options{{"-s", "a\\"}, {"-t", "b"}}));
  EXPECT_EQ(options_of("-s 'a'"), (Options{{"-s", "'a'"}}));
  EXPECT_EQ(options_of("-s a\"b"), (Options{{"-s", "a\"b"}}));
}

TEST(Arguments, EndQuotesAtAWordThatEndsWithOne) {
  EXPECT_EQ(options_of("-s \"a b\"c d\""), (Options{{"-s", "a b\"c d"}}));
}

TEST(Arguments, ThatAreRepeatedTakeTheLastValue) {
  auto result = parse_with("--x 1 --y 2 --x 3");
  EXPECT_TRUE(reports(result, Severity::warning, 5, "'--x' is given twice: '3' counts", "remove"));
  EXPECT_EQ(options_of("--x 1 --y 2 --x 3"), (Options{{"--x", "3"}, {"--y", "2"}}));
}

TEST(Arguments, TakeNegativeNumbersForKeys) {
  EXPECT_EQ(options_of("--min -5"), (Options{{"--min", "true"}, {"-5", "true"}}));
  for (std::string value : {"-5", "-.5", "-"})
    EXPECT_TRUE(reports(parse_with("--min " + value), Severity::warning, 5,
                        "'" + value + "' is an option, not the value of '--min'",
                        "write \"" + value + "\""));
}

TEST(Arguments, WithStrayValuesAreErrors) {
  EXPECT_TRUE(reports(parse_with("fast"), Severity::error, 5, "'fast' is a value without an option",
                      "write --name fast"));
  auto result = parse_with("--title very long title");
  EXPECT_TRUE(reports(result, Severity::error, 5, "'long' is a value without an option",
                      "write \"very long\" with the quotes"));
  EXPECT_EQ(test::count(result, Severity::error), 1U) << "once per line";
  EXPECT_TRUE(reports(parse_with("\"a b\""), Severity::error, 5, "'a b' is a value without"));
}

TEST(Arguments, WithUnterminatedQuotesAreErrors) {
  EXPECT_TRUE(reports(parse_with("--title \"very long"), Severity::error, 5,
                      "the quote that begins with '\"very' has no end", "behind the last word"));
  EXPECT_TRUE(reports(parse_with("--title \""), Severity::error, 5, "has no end"));
}

TEST(EnvironmentWords, AreReplacedAsAWhole) {
  World world{{}, {{"LOG", "true"}, {"TEXT", "a b"}}};
  EXPECT_EQ(options_of("--log $LOG --text $TEXT", world),
            (Options{{"--log", "true"}, {"--text", "a b"}}));
}

TEST(EnvironmentWords, MustBeginWithADollarSign) {
  World world{{}, {{"LOG", "true"}}};
  EXPECT_EQ(options_of("--log a$LOG --x \"$LOG y\" -z \"y $LOG z\"", world),
            (Options{{"--log", "a$LOG"}, {"--x", "$LOG y"}, {"-z", "y true z"}}));
}

TEST(EnvironmentWords, MayBringKeysAndComments) {
  World world{{}, {{"KEY", "--key"}, {"HASH", "#"}, {"EMPTY", ""}}};
  EXPECT_EQ(options_of("$KEY 1 --x $EMPTY $HASH --y", world),
            (Options{{"--key", "1"}, {"--x", ""}}));
}

TEST(EnvironmentWords, ThatAreNotSetAreErrors) {
  EXPECT_TRUE(reports(parse_with("--log $TEST_LOG_OUTPUT"), Severity::error, 5,
                      "environment variable '$TEST_LOG_OUTPUT' is not set",
                      "set TEST_LOG_OUTPUT in the environment"));
  EXPECT_TRUE(reports(parse_with("--log $"), Severity::error, 5, "'$' is not set"));
}

TEST(EnvironmentWords, InCommentsAreNotLookedAt) {
  EXPECT_TRUE(test::is_clean(parse_with("#--log $TEST_LOG_OUTPUT")));
}

TEST(EnvironmentWords, WorkInEveryStructureLine) {
  World world{{}, {{"H", "10.0.0.1"}, {"N", "name"}, {"C", "Class"}, {"L", "CPP"}}};
  auto result = test::parse("HOST $H\nSUBARCHITECTURE $N $H\nCPP WM $C\n$L TM $C\n$H CPP MG $C $C\n"
                            "COMPONENT $H $L x $C",
                            world);
  ASSERT_TRUE(test::is_clean(result));
  EXPECT_EQ(result.architecture->subarchitectures.at(0).name, "name");
  EXPECT_EQ(result.architecture->component("Class")->host, "10.0.0.1");
  EXPECT_EQ(result.architecture->component("x")->class_name, "Class");
}

TEST(EnvironmentWords, AreNotReplacedInCommands) {
  World world{{}, {{"A", "x"}}};
  EXPECT_EQ(test::values("SETVAR v=$A\n#EXPAND %(v)", world), std::vector<std::string>{"$A"});
}

TEST(EnvironmentWords, MayComeFromVariables) {
  World world{{}, {{"A", "x"}}};
  auto result = test::parse("SETVAR v=$A\n" + test::system_with("CPP MG a A --k %(v)"), world);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->component("a")->option("k")->value, "x");
}

} // namespace

} // namespace castor::cast
