#include "castor/actors/cast/variables.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::cast {

namespace {

using test::parse;
using test::reports;
using test::values;
using test::World;
using Values = std::vector<std::string>;

TEST(Assignments, SeparateNameAndValueAtTheFirstEqualsSign) {
  auto assignment = parse_assignment(" name \t= a = b ");
  ASSERT_TRUE(assignment);
  EXPECT_EQ(assignment->name, "name");
  EXPECT_EQ(assignment->value, "a = b");
}

TEST(Assignments, AllowAnEmptyValue) {
  ASSERT_TRUE(parse_assignment("a="));
  EXPECT_EQ(parse_assignment("a=")->value, "");
}

TEST(Assignments, NeedAProperName) {
  EXPECT_TRUE(parse_assignment("aB_9=x"));
  for (auto text : {"1a=x", "_a=x", "a-b=x", "a.b=x", "a b=x", "=x", "a", ""})
    EXPECT_FALSE(parse_assignment(text)) << text;
}

TEST(Expansion, ReplacesEveryOccurrence) {
  VariableTable variables;
  variables.define("a", "1");
  variables.define("b", "2");
  auto result = expand("<%(a)%(b)|%(a)>", variables, {}, Undefined::keep, 100);
  EXPECT_EQ(result.text, "<12|1>");
  EXPECT_TRUE(result.undefined_variables.empty());
}

TEST(Expansion, DoesNotLookAtTheResultAgain) {
  VariableTable variables;
  variables.define("a", "%(b)");
  variables.define("b", "2");
  EXPECT_EQ(expand("%(a)", variables, {}, Undefined::keep, 100).text, "%(b)");
}

TEST(Expansion, TakesTheNameLiterally) {
  VariableTable variables;
  variables.define("a", "1");
  auto result = expand("%( a )%(%(a)", variables, {}, Undefined::keep, 100);
  EXPECT_EQ(result.text, "%( a )%(%(a)");
  EXPECT_EQ(result.undefined_variables, (std::vector<std::string_view>{" a ", "%(a"}));
}

TEST(Expansion, LeavesAnUnclosedParenthesisAlone) {
  VariableTable variables;
  variables.define("a", "1");
  EXPECT_EQ(expand("%(a) %(a", variables, {}, Undefined::drop, 100).text, "1 %(a");
}

TEST(Expansion, KeepsOrDropsUndefinedVariables) {
  EXPECT_EQ(expand("x%(a)y", {}, {}, Undefined::keep, 100).text, "x%(a)y");
  EXPECT_EQ(expand("x%(a)y", {}, {}, Undefined::drop, 100).text, "xy");
}

TEST(Expansion, KnowsHosts) {
  HostTable hosts;
  hosts.define("Main", "10.0.0.1");
  auto result = expand("%(host:Main) %(host:Other)", {}, hosts, Undefined::keep, 100);
  EXPECT_EQ(result.text, "10.0.0.1 localhost");
  EXPECT_EQ(result.undefined_hosts, std::vector<std::string_view>{"Other"});
  EXPECT_TRUE(result.uses_localhost);
}

TEST(Expansion, StopsAtTheLimit) {
  VariableTable variables;
  variables.define("a", "12345678");
  EXPECT_FALSE(expand("%(a)%(a)", variables, {}, Undefined::keep, 16).too_long);
  auto result = expand("%(a)%(a)x", variables, {}, Undefined::keep, 16);
  EXPECT_TRUE(result.too_long);
  EXPECT_EQ(result.text.size(), 16U);
}

TEST(Variables, HaveTheRestOfTheLineAsTheirValue) {
  EXPECT_EQ(values("SETVAR a = \"x\"  y # z\n#EXPAND %(a)"), Values{"\"x\"  y # z"});
}

TEST(Variables, WithAHashInTheirValueGetANote) {
  auto result = parse("SETVAR a=x # not a comment");
  EXPECT_TRUE(reports(result, Severity::note, 1, "part of the value", "line of its own"));
}

TEST(Variables, AreExpandedWhenTheyAreAssigned) {
  EXPECT_EQ(values("SETVAR a=1\nSETVAR b=%(a)\nSETVAR a=2\n#EXPAND %(b)"), Values{"1"});
}

TEST(Variables, ThatAreUndefinedMakeAValueEmpty) {
  auto text = "SETVAR b=<%(aa)>\n#EXPAND %(b)";
  EXPECT_EQ(values(text), Values{"<>"});
  EXPECT_TRUE(reports(parse(text), Severity::warning, 1,
                      "variable 'aa' is not defined; it counts as empty", "VARDEFAULT aa=value"));
}

TEST(Variables, ThatAreUndefinedStayInComponentLines) {
  auto result = parse(test::system_with("CPP MG a A --x %(nothing)\n"));
  EXPECT_TRUE(reports(result, Severity::warning, 5, "the text stays as it is"));
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->component("a")->option("x")->value, "%(nothing)");
}

TEST(Variables, ThatAreMisspeltAreRecognised) {
  auto result = parse("SETVAR camera=front\nSETVAR x=%(camrea)");
  EXPECT_TRUE(reports(result, Severity::warning, 2, "'camrea'", "did you mean 'camera'?"));
}

TEST(Variables, KeepTheirValueUnderVardefault) {
  EXPECT_EQ(values("VARDEFAULT a=1\nVARDEFAULT a=2\n#EXPAND %(a)"), Values{"1"});
  EXPECT_EQ(values("SETVAR a=\nVARDEFAULT a=2\n#EXPAND <%(a)>"), Values{"<>"});
}

TEST(Variables, MatchTheirCommandsByPrefix) {
  auto text = "SETVARS a=1\nVARDEFAULTS a=2\n#EXPAND %(a)";
  EXPECT_EQ(values(text), Values{"1"});
  EXPECT_TRUE(reports(parse(text), Severity::warning, 1, "read as SETVAR"));
}

TEST(Variables, WithInvalidAssignmentsAreErrors) {
  for (auto line : {"SETVAR", "SETVAR a", "SETVAR 1=2", "SETVAR a.b=1", "SETVARa=1", "SETVARS"})
    EXPECT_TRUE(
      reports(parse(line), Severity::error, 1, "no assignment", "write SETVAR name=value"))
      << line;
  auto result = parse("SETVAR a.b=1\nVARDEFAULT =1\nSETVAR c=1\n#EXPAND %(c)");
  EXPECT_TRUE(reports(result, Severity::error, 2, "no assignment", "write VARDEFAULT name=value"));
  EXPECT_EQ(result.expansions, Values{"#EXPAND 1"});
}

TEST(Variables, AreNotAssignedInDisabledBlocks) {
  EXPECT_EQ(values("SETVAR a=1\nIFTRUE(no)\nSETVAR a=2\nSETVAR nonsense\nENDIF\n#EXPAND %(a)"),
            Values{"1"});
}

TEST(Variables, DoNotSurviveAParse) {
  EXPECT_EQ(values("SETVAR a=1\n#EXPAND %(a)"), Values{"1"});
  EXPECT_EQ(values("#EXPAND <%(a)>"), Values{"<>"});
}

TEST(MultilineValues, AreJoinedByBlanks) {
  EXPECT_EQ(values("SETVAR a=<multiline> one \n  two  \n#dropped\n\nthree\n</multiline>\n"
                   "#EXPAND <%(a)>"),
            Values{"<one two  three>"});
}

TEST(MultilineValues, MayBeginBehindTheTag) {
  EXPECT_EQ(values("SETVAR a=<multiline>\none\ntwo\n  </multiline>  \n#EXPAND <%(a)>"),
            Values{"<one two>"});
  EXPECT_EQ(values("SETVAR a=<multiline>\n</multiline>\n#EXPAND <%(a)>"), Values{"<>"});
}

TEST(MultilineValues, HoldCommandsAsText) {
  EXPECT_EQ(values("SETVAR b=1\nSETVAR a=<multiline>\nSETVAR b=2\nENDIF\n</multiline>\n"
                   "#EXPAND <%(a)> %(b)"),
            Values{"<SETVAR b=2 ENDIF> 1"});
}

TEST(MultilineValues, AreExpandedAfterJoining) {
  EXPECT_EQ(values("SETVAR b=1\nSETVAR a=<multiline>\n%(b\n)%(b)\n</multiline>\n#EXPAND <%(a)>"),
            Values{"<1>"});
}

TEST(MultilineValues, IncludeFiles) {
  World world{{{"part.incl", "two"}}, {}};
  EXPECT_EQ(
    values("SETVAR a=<multiline>\none\nINCLUDE part.incl\n</multiline>\n#EXPAND %(a)", world),
    Values{"one two"});
}

TEST(MultilineValues, WorkWithEveryCommand) {
  EXPECT_EQ(values("VARDEFAULT a=<multiline>\nx\n</multiline>\n#EXPAND %(a)"), Values{"x"});
  EXPECT_EQ(values("SETVAR a=1\nVARDEFAULT a=<multiline>\nx\n</multiline>\n#EXPAND %(a)"),
            Values{"1"});
  EXPECT_EQ(values("SETVAR a=x\nSETOPT a=<multiline>\n!x\ny\n</multiline>\n#EXPAND %(a)"),
            Values{"!x y "});
}

TEST(MultilineValues, WithoutAnEndAreErrors) {
  auto result = parse("SETVAR a=<multiline>\nSETVAR b=1\n#EXPAND %(b)");
  EXPECT_TRUE(reports(result, Severity::error, 1, "has no end", "write </multiline>"));
  EXPECT_EQ(result.expansions, Values{"#EXPAND 1"}) << "the rest of the file is still read";
}

TEST(MultilineValues, ThatSwallowAnotherGetAWarning) {
  auto result = parse("SETVAR a=<multiline>\nx\nSETVAR b=<multiline>\ny\n</multiline>");
  EXPECT_TRUE(
    reports(result, Severity::warning, 3, "begins at main.cast:1", "is </multiline> missing"));
}

TEST(MultilineValues, InDisabledBlocksAreTextToo) {
  auto text = "SETVAR a=0\nIFTRUE(no)\nSETVAR a=<multiline>\nELSE\n</multiline>\n"
              "SETVAR a=1\nENDIF\n#EXPAND %(a)";
  EXPECT_EQ(values(text), Values{"0"});
}

TEST(MultilineValues, WithoutAnEndInDisabledBlocksAreOnlyRemarkedOn) {
  auto result = parse("IFTRUE(no)\nSETVAR a=<multiline>\nENDIF\n" + test::system_with(""));
  EXPECT_TRUE(reports(result, Severity::warning, 2, "has no end"));
  EXPECT_TRUE(result.ok());
}

TEST(PresetVariables, AreSeenByVardefault) {
  auto options = test::options_for({});
  options.variables["a"] = "preset";
  auto result = parse_string("VARDEFAULT a=file\n#EXPAND %(a)", "main.cast", options);
  EXPECT_EQ(result.expansions, Values{"#EXPAND preset"});
  EXPECT_EQ(test::count(result, Severity::warning), 0U);
}

TEST(PresetVariables, AreOverwrittenBySetvarWithAWarning) {
  auto options = test::options_for({});
  options.variables["a"] = "preset";
  auto result = parse_string("SETVAR a=file\n#EXPAND %(a)", "main.cast", options);
  EXPECT_EQ(result.expansions, Values{"#EXPAND file"});
  EXPECT_TRUE(reports(result, Severity::warning, 1, "overwrites the value of 'a'", "VARDEFAULT"));
}

TEST(PresetVariables, AreMergedBySetopt) {
  auto options = test::options_for({});
  options.variables["a"] = "x !y";
  auto result = parse_string("SETOPT a=y\n#EXPAND %(a)", "main.cast", options);
  EXPECT_EQ(result.expansions, Values{"#EXPAND x y "});
  EXPECT_EQ(test::count(result, Severity::warning), 0U);
}

TEST(PresetVariables, NeedProperNames) {
  auto options = test::options_for({});
  options.variables["a b"] = "x";
  auto result = parse_string(test::system_with(""), "main.cast", options);
  EXPECT_TRUE(
    reports(result, Severity::error, 0, "'a b' cannot be the name", "a letter", "command line"));
}

TEST(FileVariables, HoldTheDirectoryOfTheFile) {
  const std::string line = "#EXPAND %(CURRENT_DIR) %(CONFIG_DIR) %(CURRENT_FILE) %(MAIN_DIR)\n";
  World world{{{"config/main.cast", line + "INCLUDE parts/a.cast\n" + line},
               {"config/parts/a.cast", line + "INCLUDE /elsewhere/b.cast\n" + line},
               {"/elsewhere/b.cast", line}},
              {}};
  auto result = parse_file("config/main.cast", test::options_for(world));
  EXPECT_EQ(result.expansions,
            (Values{"#EXPAND config config config/main.cast config",
                    "#EXPAND config/parts config/parts config/parts/a.cast config",
                    "#EXPAND /elsewhere /elsewhere /elsewhere/b.cast config",
                    "#EXPAND config/parts config/parts config/parts/a.cast config",
                    "#EXPAND config config config/main.cast config"}));
}

TEST(FileVariables, OfTheMainFileAreHandedToIncludedOnesInVariables) {
  World world{{{"config/main.cast", "SETVAR pictures=%(CONFIG_DIR)/pictures\n"
                                    "INCLUDE /elsewhere/b.cast\n"},
               {"/elsewhere/b.cast", "#EXPAND %(pictures)"}},
              {}};
  auto result = parse_file("config/main.cast", test::options_for(world));
  EXPECT_EQ(result.expansions, Values{"#EXPAND config/pictures"});
}

TEST(FileVariables, AreADotInTheWorkingDirectory) {
  EXPECT_EQ(values("#EXPAND %(CURRENT_DIR) %(CONFIG_DIR) %(CURRENT_FILE)"),
            Values{". . main.cast"});
}

TEST(FileVariables, AreAbsoluteOutsideOfTheWorkingDirectory) {
  World world{{{"/etc/main.cast", "#EXPAND %(CURRENT_DIR) %(CURRENT_FILE)"}}, {}};
  auto result = parse_file("/etc/main.cast", test::options_for(world));
  EXPECT_EQ(result.expansions, Values{"#EXPAND /etc /etc/main.cast"});
}

TEST(FileVariables, AreRightInFilesThatADisabledBlockIncludes) {
  World world{{{"parts/a.incl", "ENDIF\n#EXPAND %(CURRENT_DIR)"}}, {}};
  EXPECT_EQ(values("IFTRUE(no)\nINCLUDE parts/a.incl", world), Values{"parts"});
}

TEST(FileVariables, AreNotMeantToBeAssigned) {
  World world{{{"a.cast", ""}}, {}};
  auto text = "SETVAR CURRENT_DIR=x\n#EXPAND %(CURRENT_DIR)\nINCLUDE a.cast\n"
              "#EXPAND %(CURRENT_DIR)";
  EXPECT_EQ(values(text, world), (Values{"x", "."}));
  EXPECT_TRUE(reports(parse(text, world), Severity::warning, 1, "is set anew"));
  EXPECT_TRUE(reports(parse("SETVAR CONFIG_DIR=x\n", world), Severity::warning, 1, "is set anew"));
}

TEST(ExpandComments, AreExpandedInDisabledBlocksAndWithoutWarnings) {
  auto result = parse("SETVAR a=1\nIFTRUE(no)\n#EXPAND %(a)%(b)%(host:C)\nENDIF\n# EXPAND %(a)\n" +
                      test::system_with(""));
  EXPECT_EQ(result.expansions, Values{"#EXPAND 1localhost"});
  EXPECT_TRUE(test::is_clean(result));
}

} // namespace

} // namespace castor::cast
