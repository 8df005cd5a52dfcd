#include "castor/actors/cast/conditions.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::cast {

namespace {

using test::parse;
using test::reports;
using test::values;
using Values = std::vector<std::string>;

/// Whether the block behind the line is enabled.
bool holds(const std::string& condition, const std::string& before = {}) {
  auto result = values(before + "\nSETVAR result=no\n" + condition +
                       "\nSETVAR result=yes\nENDIF\n#EXPAND %(result)");
  return result.at(0) == "yes";
}

/// The one error or warning of the line, between others that are correct.
testing::AssertionResult complains(Severity severity, const std::string& line,
                                   std::string_view message, std::string_view remedy = {}) {
  return reports(parse(line + "\nENDIF"), severity, 1, message, remedy);
}

TEST(Truth, HasExactWords) {
  for (auto word : {"true", "YES", "On", "1", "2", "9", " yes "}) {
    EXPECT_EQ(evaluate_truth(word).value, true) << word;
    EXPECT_TRUE(evaluate_truth(word).problem.empty()) << word;
  }
  for (auto word : {"false", "No", "OFF", "0", "", "  "}) {
    EXPECT_EQ(evaluate_truth(word).value, false) << word;
    EXPECT_TRUE(evaluate_truth(word).problem.empty()) << word;
  }
}

TEST(Truth, HasNoOtherWords) {
  for (auto word : {"10", "maybe", "tru", "\"yes\"", "y", "-1", "."}) {
    EXPECT_FALSE(evaluate_truth(word).value) << word;
    EXPECT_NE(evaluate_truth(word).problem.find("neither true nor false"), std::string::npos);
    EXPECT_NE(evaluate_truth(word).remedy.find("write true"), std::string::npos);
  }
}

TEST(Truth, RemarksOnPiecesOfTheListOfWords) {
  for (auto word : {"1.2", "yes.on", "8.9"}) {
    EXPECT_EQ(evaluate_truth(word).value, true) << word;
    EXPECT_NE(evaluate_truth(word).problem.find("taken for true"), std::string::npos) << word;
  }
  EXPECT_EQ(evaluate_truth("no.off").value, false);
  EXPECT_NE(evaluate_truth("0.").problem.find("taken for false"), std::string::npos);
}

TEST(Conditions, CompareTexts) {
  EXPECT_TRUE(holds("IFEQ(a, a)"));
  EXPECT_FALSE(holds("IFEQ(a, b)"));
  EXPECT_FALSE(holds("IFNEQ(a, a)"));
  EXPECT_TRUE(holds("IFNEQ( a ,b)"));
  EXPECT_TRUE(holds("IFEQ(,)"));
  EXPECT_FALSE(holds("IFEQ(\"a\", a)")) << "quotes are part of the text";
}

TEST(Conditions, ExpandBothSidesAfterTrimming) {
  EXPECT_TRUE(holds("IFEQ(%(a), %(b))", "SETVAR a=x\nSETVAR b=x"));
  EXPECT_TRUE(holds("IFEQ(%(a), x)", "SETVAR a=x"));
  EXPECT_FALSE(holds("IFEQ(%(a), x)", "SETVAR a=\nSETOPT a=x")) << "merged options end in a blank";
}

TEST(Conditions, SplitAtTheFirstCommaBeforeExpansion) {
  EXPECT_TRUE(holds("IFEQ(%(a), 1,2)", "SETVAR a=1,2"));
  EXPECT_TRUE(holds("IFEQ(x, %(a))", "SETVAR a=x"));
  EXPECT_FALSE(holds("IFEQ(1,2, 1,2)"));
}

TEST(Conditions, ReachFromTheFirstToTheLastParenthesis) {
  EXPECT_TRUE(holds("IFEQ((a), (a))"));
  EXPECT_TRUE(holds("IFEQ (a, a) # comment"));
  EXPECT_FALSE(holds("IFEQ(a, a) # comment (really)"));
  EXPECT_TRUE(complains(Severity::warning, "IFEQ(a, a) # comment (really)", "comments included"));
}

TEST(Conditions, RemarkOnTextAroundTheParameters) {
  EXPECT_TRUE(complains(Severity::warning, "IFEQx(a, a)", "'x' before the parameters is ignored"));
  EXPECT_TRUE(complains(Severity::warning, "IFTRUE(1) x", "'x' behind the parameters is ignored"));
}

TEST(Conditions, TestTruth) {
  EXPECT_TRUE(holds("IFTRUE(yes)"));
  EXPECT_FALSE(holds("IFTRUE(%(a))", "SETVAR a=off"));
  EXPECT_TRUE(holds("IFFALSE(%(a))", "SETVAR a=off"));
  EXPECT_FALSE(holds("IFFALSE(1)"));
  EXPECT_TRUE(holds("IFFALSE()"));
  EXPECT_TRUE(holds("IFFALSE(%(nothing))")) << "undefined counts as empty";
  EXPECT_TRUE(complains(Severity::warning, "IFFALSE(%(nothing))", "'nothing' is not defined"));
}

TEST(Conditions, TestOptions) {
  EXPECT_TRUE(holds("IFOPTANY(%(o), x b)", "SETVAR o=a b"));
  EXPECT_FALSE(holds("IFOPTANY(%(o), x !b)", "SETVAR o=a b"));
  EXPECT_TRUE(holds("IFOPTALL(%(o), a !x)", "SETVAR o=a b"));
  EXPECT_FALSE(holds("IFOPTALL(%(o), a x)", "SETVAR o=a b"));
  EXPECT_TRUE(holds("IFOPTALL(%(o), %(f))", "SETVAR o=a b\nSETVAR f=b a"));
}

TEST(Conditions, NeedParameters) {
  EXPECT_TRUE(complains(Severity::error, "IFTRUE", "IFTRUE needs parameters", "write IFTRUE("));
  EXPECT_TRUE(complains(Severity::error, "IFEQ(a, b", "needs parameters", "write IFEQ(%(name)"));
  EXPECT_TRUE(complains(Severity::error, "IFEQ)a, b(", "needs parameters"));
  EXPECT_TRUE(complains(Severity::error, "IFNEQ(a)", "two parameters", "write IFNEQ(%(name), v"));
  EXPECT_TRUE(complains(Severity::error, "IFOPTANY(a)", "two parameters", "flag !other"));
  EXPECT_TRUE(complains(Severity::error, "IFOPTALL(a)", "two parameters"));
}

TEST(Conditions, NeedTruthValues) {
  EXPECT_TRUE(complains(Severity::error, "IFTRUE(perhaps)", "'perhaps' is neither true nor false",
                        "write true, yes"));
  EXPECT_TRUE(complains(Severity::warning, "IFTRUE(1.2)", "'1.2' is taken for true"));
}

TEST(Conditions, ThatDoNotExistAreErrors) {
  auto result = parse("IFDEF(x)\nENDIF\n" + test::system_with(""));
  EXPECT_TRUE(reports(result, Severity::error, 1, "no conditional 'IFDEF'", "IFEQ"));
  EXPECT_EQ(test::count(result, Severity::error), 1U) << "its ENDIF is not an error as well";
}

TEST(Blocks, HaveAnAlternative) {
  EXPECT_EQ(values("IFTRUE(1)\nSETVAR a=1\nELSE\nSETVAR a=2\nENDIF\n#EXPAND %(a)"), Values{"1"});
  EXPECT_EQ(values("IFTRUE(0)\nSETVAR a=1\nELSE\nSETVAR a=2\nENDIF\n#EXPAND %(a)"), Values{"2"});
}

TEST(Blocks, Nest) {
  for (std::string outer : {"0", "1"})
    for (std::string inner : {"0", "1"}) {
      auto text = "SETVAR r=none\nIFTRUE(" + outer + ")\nIFTRUE(" + inner +
                  ")\nSETVAR r=11\nELSE\nSETVAR r=10\nENDIF\nELSE\nIFTRUE(" + inner +
                  ")\nSETVAR r=01\nELSE\nSETVAR r=00\nENDIF\nENDIF\n#EXPAND %(r)";
      EXPECT_EQ(values(text), Values{outer + inner});
    }
}

TEST(Blocks, MatchTheirKeywordsByPrefix) {
  auto text = "IFTRUE(0)\nELSE of it\nSETVAR a=1\nENDIFF\n#EXPAND %(a)";
  EXPECT_EQ(values(text), Values{"1"});
  EXPECT_TRUE(reports(parse(text), Severity::warning, 2, "'of it' behind ELSE is ignored"));
  EXPECT_TRUE(reports(parse(text), Severity::warning, 4, "'F' behind ENDIF is ignored", "#"));
  EXPECT_EQ(test::count(parse("IFTRUE(0)\nELSE # a\nENDIF # b"), Severity::warning), 0U);
}

TEST(Blocks, EvaluateConditionsInDisabledBlocksToo) {
  auto result = parse("IFTRUE(no)\nIFTRUE(perhaps)\nENDIF\nENDIF\n" + test::system_with(""));
  EXPECT_TRUE(reports(result, Severity::error, 2, "neither true nor false"));
}

TEST(Blocks, DoNotWarnOfUndefinedVariablesInDisabledBlocks) {
  EXPECT_TRUE(test::is_clean(
    parse("IFTRUE(no)\nIFEQ(%(a), b)\nENDIF\n%(c)\nENDIF\n" + test::system_with(""))));
}

TEST(Blocks, IgnoreEverythingElseInDisabledBlocks) {
  EXPECT_TRUE(test::is_clean(parse("IFTRUE(no)\nnonsense\nSETVAR nonsense\nHOSTNAME\nIFDEF\n"
                                   "SUBARCHITECTURE\nENDIF\n" +
                                   test::system_with(""))));
}

TEST(Blocks, HaveOneAlternativeOnly) {
  auto result = parse("IFTRUE(1)\nELSE\nELSE\nENDIF");
  EXPECT_TRUE(reports(result, Severity::error, 3,
                      "second ELSE of the block that begins at "
                      "main.cast:1"));
}

TEST(Blocks, HaveNoAlternativeWithACondition) {
  for (std::string line : {"ELSEIF(x)", "ELSE IFEQ(a, b)", "ELSEIFTRUE(1)"}) {
    auto result = parse("IFTRUE(1)\n" + line + "\nELSE\nENDIF");
    EXPECT_TRUE(
      reports(result, Severity::error, 2, "no ELSE with a condition", "with its own ENDIF"))
      << line;
    EXPECT_EQ(test::count(result, Severity::error), 1U);
  }
}

TEST(Blocks, NeedABeginning) {
  EXPECT_TRUE(reports(parse("ELSE"), Severity::error, 1, "ELSE without an IF..."));
  EXPECT_TRUE(reports(parse("IFTRUE(1)\nENDIF\nENDIF"), Severity::error, 3,
                      "ENDIF without an IF...", "too many"));
}

TEST(Blocks, NeedAnEnd) {
  EXPECT_TRUE(reports(parse("\nIFTRUE(1)\n"), Severity::error, 2, "has no ENDIF", "write one"));
  auto nested = parse("IFEQ(a, a)\nIFTRUE(1)\nENDIF\nIFFALSE(0)\n");
  EXPECT_TRUE(reports(nested, Severity::error, 4,
                      "2 blocks have no ENDIF: 'IFEQ(a, a)' at main.cast:1, 'IFFALSE(0)' at "
                      "main.cast:4"));
}

TEST(Blocks, ReportAllErrorsAtOnce) {
  auto result = parse("ELSE\nIFTRUE(x)\nENDIF\nIFEQ(a)\nENDIF\nENDIF\nIFTRUE(1)");
  EXPECT_EQ(test::count(result, Severity::error), 5U) << render(result.diagnostics);
}

} // namespace

} // namespace castor::cast
