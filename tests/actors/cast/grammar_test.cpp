#include "castor/actors/cast/grammar.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::cast {

namespace {

using test::is_clean;
using test::parse;
using test::reports;
using test::system_with;

const std::string wm = "CPP WM SubarchitectureWorkingMemory\n";
const std::string tm = "CPP TM AlwaysPositiveTaskManager\n";

TEST(Subarchitectures, HaveAWorkingMemoryATaskManagerAndComponents) {
  auto result = parse(system_with("CPP MG a A --x 1\nCPP UM b B\n"));
  ASSERT_TRUE(is_clean(result));
  const auto& architecture = *result.architecture;
  EXPECT_EQ(architecture.file, "main.cast");
  EXPECT_EQ(architecture.config_dir, ".");
  ASSERT_EQ(architecture.subarchitectures.size(), 1U);
  const auto& sa = architecture.subarchitectures[0];
  EXPECT_EQ(sa.name, "sa");
  EXPECT_EQ(sa.host, "localhost");
  EXPECT_EQ(sa.where.line(), 2U);
  EXPECT_EQ(sa.working_memory.name, "sa_wm");
  EXPECT_EQ(sa.working_memory.kind, ComponentKind::working_memory);
  EXPECT_EQ(sa.working_memory.class_name, "SubarchitectureWorkingMemory");
  EXPECT_EQ(sa.task_manager.name, "sa_tm");
  EXPECT_EQ(sa.task_manager.kind, ComponentKind::task_manager);
  ASSERT_EQ(sa.components.size(), 2U);
  EXPECT_EQ(sa.components[0].name, "a");
  EXPECT_EQ(sa.components[0].kind, ComponentKind::managed);
  EXPECT_EQ(sa.components[0].class_name, "A");
  EXPECT_EQ(sa.components[0].language, Language::cpp);
  EXPECT_EQ(sa.components[0].subarchitecture, "sa");
  EXPECT_EQ(sa.components[0].where.line(), 5U);
  EXPECT_EQ(sa.components[0].options.at(0).where.line(), 5U);
  EXPECT_EQ(sa.components[1].kind, ComponentKind::unmanaged);
}

TEST(Subarchitectures, KnowTheOldKinds) {
  auto result = parse(system_with("CPP GD a A\nCPP DD b B\n"));
  ASSERT_TRUE(is_clean(result));
  EXPECT_EQ(result.architecture->component("a")->kind, ComponentKind::managed);
  EXPECT_EQ(result.architecture->component("b")->kind, ComponentKind::unmanaged);
}

TEST(Subarchitectures, NumberTheirLinesInFileOrder) {
  auto result = parse("HOST h\nCOMPONENT CPP x X\nSUBARCHITECTURE s\nCPP MG a A\n" + tm +
                      "CPP UM b B\n" + wm + "SUBARCHITECTURE t\n" + wm + tm + "CPP MG c C");
  ASSERT_TRUE(is_clean(result));
  auto number = [&](const char* name) { return result.architecture->component(name)->number; };
  EXPECT_EQ(number("a"), 0U);
  EXPECT_EQ(number("s_tm"), 1U);
  EXPECT_EQ(number("b"), 2U);
  EXPECT_EQ(number("s_wm"), 3U);
  EXPECT_EQ(number("t_wm"), 4U);
  EXPECT_EQ(number("t_tm"), 5U);
  EXPECT_EQ(number("c"), 6U);
  EXPECT_EQ(number("x"), 7U);
}

TEST(Subarchitectures, TakeTheHostOfTheLastHostLineAbove) {
  auto result = parse("HOST a\nSUBARCHITECTURE s\n" + wm + tm + "HOST b\nSUBARCHITECTURE t\n" + wm +
                      tm + "SUBARCHITECTURE u c\n" + wm + "d " + tm);
  ASSERT_TRUE(is_clean(result));
  EXPECT_EQ(result.architecture->subarchitecture("s")->host, "a");
  EXPECT_EQ(result.architecture->subarchitecture("t")->working_memory.host, "b");
  EXPECT_EQ(result.architecture->subarchitecture("u")->working_memory.host, "c");
  EXPECT_EQ(result.architecture->subarchitecture("u")->task_manager.host, "d");
}

TEST(Subarchitectures, MayHaveCommentsBehindTheirNameAndHost) {
  EXPECT_TRUE(is_clean(parse("HOST h # x\nSUBARCHITECTURE s # y\n" + wm + tm +
                             "SUBARCHITECTURE t g # z\n" + wm + tm)));
}

TEST(Subarchitectures, RemarkOnExtraWords) {
  auto result = parse("HOST h extra\nSUBARCHITECTURE s g more words\n" + wm + tm);
  EXPECT_TRUE(reports(result, Severity::warning, 1, "'extra' is ignored", "#"));
  EXPECT_TRUE(reports(result, Severity::warning, 2, "'more words' is ignored"));
  EXPECT_TRUE(result.ok());
}

TEST(Subarchitectures, NeedAName) {
  for (std::string line : {"SUBARCHITECTURE", "SUBARCHITECTURE # s"}) {
    auto result = parse("HOST h\n" + line + "\nCPP MG a A x\n");
    EXPECT_TRUE(reports(result, Severity::error, 2, "SUBARCHITECTURE without a name", "write"));
    EXPECT_TRUE(reports(result, Severity::error, 3, "'x' is a value without an option"));
    EXPECT_EQ(test::count(result, Severity::error), 2U);
  }
}

TEST(Subarchitectures, NeedDifferentNames) {
  auto result = parse(system_with("SUBARCHITECTURE sa\n") + wm + tm);
  EXPECT_TRUE(reports(result, Severity::error, 5, "a subarchitecture 'sa' already, at main.cast:2",
                      "another name"));
  EXPECT_EQ(test::count(result, Severity::error), 1U);
}

TEST(Subarchitectures, MayNotTakeTheNameOfTheSystemsOwn) {
  auto result = parse(system_with("SUBARCHITECTURE castor\n") + wm + tm + "CPP UM castor_wm A\n");
  EXPECT_TRUE(reports(result, Severity::error, 5, "is the subarchitecture of the health entries",
                      "another name"));
  EXPECT_TRUE(reports(result, Severity::error, 8, "a working memory that every system has"));
  EXPECT_EQ(test::count(result, Severity::error), 2U);
}

TEST(Subarchitectures, AreOnThisMachineIfNoHostIsNamed) {
  auto result = parse("SUBARCHITECTURE s\n" + wm + tm + "CPP MG a A\n");
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(result.diagnostics.empty());
  EXPECT_EQ(result.architecture->component("a")->host, "localhost");
}

TEST(Subarchitectures, NeedAWorkingMemoryAndATaskManager) {
  auto result = parse("HOST h\nSUBARCHITECTURE s\nCPP MG a A\nSUBARCHITECTURE t\n" + wm);
  EXPECT_TRUE(reports(result, Severity::error, 2, "'s' has no working memory",
                      "CPP WM SubarchitectureWorkingMemory"));
  EXPECT_TRUE(reports(result, Severity::error, 2, "'s' has no task manager",
                      "CPP TM AlwaysPositiveTaskManager"));
  EXPECT_TRUE(reports(result, Severity::error, 4, "'t' has no task manager"));
  EXPECT_EQ(test::count(result, Severity::error), 3U);
}

TEST(Subarchitectures, DoNotMissALineThatIsOnlyWrong) {
  auto result = parse("HOST h\nSUBARCHITECTURE s\nCPP WM\n" + tm);
  EXPECT_TRUE(reports(result, Severity::error, 3, "class is missing"));
  EXPECT_EQ(test::count(result, Severity::error), 1U);
}

TEST(Subarchitectures, TakeTheLastOfSeveralWorkingMemories) {
  auto result = parse(system_with("CPP WM Other\nCPP TM OtherToo\nCPP MG a A\n"));
  EXPECT_TRUE(reports(result, Severity::warning, 5, "second WM line", "remove one"));
  EXPECT_TRUE(reports(result, Severity::warning, 6, "replaces the one at main.cast:4"));
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->component("sa_wm")->class_name, "Other");
  EXPECT_EQ(result.architecture->component("sa_wm")->number, 2U);
  EXPECT_EQ(result.architecture->component("a")->number, 4U);
}

TEST(Subarchitectures, EndAtAnySectionLine) {
  for (std::string line : {"HOST h", "COMPONENT CPP x X", "CONNECTION a b", "ACCESS * WRITES *"}) {
    auto result = parse(system_with(line + "\nCPP MG a A\n"));
    EXPECT_TRUE(reports(result, Severity::error, 6,
                        "outside of any subarchitecture: the last section ended at main.cast:5 "
                        "with '" +
                          line.substr(0, line.find(' ')) + "'",
                        "move it up"))
      << line;
  }
}

TEST(Subarchitectures, MayBeSplitByBlankLinesAndComments) {
  EXPECT_TRUE(is_clean(parse(system_with("\n# comment\n\n  CPP MG a A\n"))));
}

TEST(ComponentLines, OutsideOfSectionsAreErrors) {
  auto result = parse("HOST h\nCPP MG a A\nother CPP MG b B");
  EXPECT_TRUE(reports(result, Severity::error, 2, "outside of any subarchitecture",
                      "write SUBARCHITECTURE name above it"));
  EXPECT_TRUE(reports(result, Severity::error, 3, "outside of any subarchitecture"));
}

TEST(ComponentLines, HaveUniqueNames) {
  auto result = parse(system_with("CPP MG a A\nCPP UM a B\nCOMPONENT CPP a C\n"));
  EXPECT_TRUE(reports(result, Severity::error, 6, "a component 'a' already, at main.cast:5"));
  EXPECT_TRUE(reports(result, Severity::error, 7, "a component 'a' already, at main.cast:5",
                      "unique in the whole architecture"));
}

TEST(ComponentLines, MayNotTakeTheNameOfAWorkingMemory) {
  auto result = parse(system_with("CPP MG sa_wm A\nCOMPONENT CPP sa_tm B\n"));
  EXPECT_TRUE(reports(result, Severity::error, 5, "name of the working memory of 'sa'"));
  EXPECT_TRUE(reports(result, Severity::error, 6, "name of the task manager of 'sa'"));
}

TEST(StandaloneComponents, AreReadAfterEverythingElse) {
  auto result = parse("COMPONENT CPP x X --a\nHOST h\n");
  ASSERT_TRUE(result.ok());
  const auto& x = result.architecture->standalone.at(0);
  EXPECT_EQ(x.kind, ComponentKind::standalone);
  EXPECT_EQ(x.host, "h");
  EXPECT_EQ(x.subarchitecture, "");
  EXPECT_EQ(x.options.at(0).key, "--a");
}

TEST(StandaloneComponents, SeeTheLastHostOfTheFile) {
  auto result = parse("HOST a\nCOMPONENT CPP x X\nCOMPONENT c CPP y Y\nHOST b\nCOMPONENT CPP z Z");
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->component("x")->host, "b");
  EXPECT_EQ(result.architecture->component("y")->host, "c");
  EXPECT_TRUE(reports(result, Severity::warning, 2, "host is 'b', that of the last HOST line",
                      "before the language"));
  EXPECT_EQ(test::count(result, Severity::warning), 1U);
}

TEST(StandaloneComponents, AreOnThisMachineIfNoHostIsNamed) {
  auto result = parse("COMPONENT CPP x X");
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->component("x")->host, "localhost");
}

TEST(Hosts, NeedAName) {
  EXPECT_TRUE(reports(parse("HOST"), Severity::error, 1, "HOST without", "write HOST localhost"));
  EXPECT_TRUE(reports(parse("HOST # x"), Severity::error, 1, "HOST without a host"));
}

TEST(Hosts, MayNotBeCalledLikeTheKeyword) {
  auto result = parse(system_with("HOST1 CPP MG a A"));
  EXPECT_TRUE(reports(result, Severity::error, 5, "'HOST1' is read as HOST", "HOSTNAME"));
}

TEST(Keywords, MatchByPrefix) {
  auto result = parse("HOSTS h\nSUBARCHITECTURES s\n" + wm + tm + "COMPONENTS CPP x X\n");
  EXPECT_TRUE(reports(result, Severity::warning, 1, "'HOSTS' is read as HOST", "put a blank"));
  EXPECT_TRUE(reports(result, Severity::warning, 2, "is read as SUBARCHITECTURE"));
  EXPECT_TRUE(reports(result, Severity::warning, 5, "is read as COMPONENT"));
  ASSERT_TRUE(result.ok());
  EXPECT_NE(result.architecture->component("x"), nullptr);
}

TEST(Keywords, ThatAreMisspeltMayBeginLikeOthers) {
  auto result = parse("HOSTNAM Main robot");
  EXPECT_TRUE(
    reports(result, Severity::warning, 1, "'HOSTNAM' is read as HOST", "did you mean 'HOSTNAME'?"));
}

TEST(Keywords, WithoutMeaningGetAWarning) {
  auto result = parse("ARCHITECTURE name\nCONNECTION Type a PUSH_TO b\n" + system_with(""));
  EXPECT_TRUE(reports(result, Severity::warning, 1, "ARCHITECTURE has no effect"));
  EXPECT_TRUE(reports(result, Severity::warning, 2, "CONNECTION has no effect"));
  EXPECT_TRUE(result.ok());
}

TEST(Keywords, WithoutComponentLinesRefuseThem) {
  auto result = parse("HOST h\nARCHITECTURE\nCPP MG a A\n");
  EXPECT_TRUE(reports(result, Severity::error, 3, "no component lines in an ARCHITECTURE"));
}

TEST(Keywords, ThatDoNotExistAreErrors) {
  auto result = parse("nonsense here\n" + system_with(""));
  EXPECT_TRUE(reports(result, Severity::error, 1, "'nonsense' is not a keyword", "or # before"));
}

TEST(Keywords, ThatAreMisspeltAreRecognised) {
  auto result = parse("HOST h\nSUBARCHITECURE s\n" + wm + tm + "subarchitecture t\n" + wm + tm +
                      "SETVR x=1\nCOMPONET CPP x X\nCOMPONET CPP y Y");
  EXPECT_TRUE(reports(result, Severity::error, 2, "'SUBARCHITECURE' is not a keyword",
                      "did you mean 'SUBARCHITECTURE'?"));
  EXPECT_TRUE(reports(result, Severity::error, 5, "'subarchitecture'", "'SUBARCHITECTURE'"));
  EXPECT_TRUE(reports(result, Severity::error, 8, "'SETVR'", "did you mean 'SETVAR'?"));
  EXPECT_TRUE(reports(result, Severity::error, 9, "'COMPONET'", "did you mean 'COMPONENT'?"));
  EXPECT_EQ(test::count(result, Severity::error), 5U)
    << "the lines of a section with a misspelt keyword are correct\n"
    << render(result.diagnostics);
}

TEST(Keywords, FromVariablesBeginSections) {
  auto result = parse("SETVAR section=SUBARCHITECTURE\nSETVAR nothing=\nSETVAR off=#\nHOST h\n"
                      "%(section) s\n%(nothing)\n%(off) rubbish\n" +
                      wm + tm);
  EXPECT_TRUE(is_clean(result));
}

TEST(Keywords, FromVariablesDoNotCommand) {
  auto result = parse("SETVAR command=SETVAR\n%(command) a=1");
  EXPECT_TRUE(reports(result, Severity::error, 2, "'SETVAR' came out of a variable"));
}

TEST(EmptyFiles, AreErrors) {
  for (auto text : {"", "\n\n", "# nothing", "HOST localhost"}) {
    auto result = parse(text);
    EXPECT_TRUE(reports(result, Severity::error, 0, "describes no components", "SUBARCHITECTURE"));
    EXPECT_EQ(result.diagnostics.size(), 1U);
  }
}

TEST(Errors, AreReportedAllAtOnceInFileOrder) {
  auto result = parse("HOST\nnonsense\nSUBARCHITECTURE s h\nCPP XX a A\nCPP MG b\nCOMPONENT CPP\n"
                      "ENDIF\nACCESS a WRITES b\nSETVAR\nINCLUDE none");
  std::vector<std::size_t> lines;
  for (const auto& diagnostic : result.diagnostics)
    lines.push_back(diagnostic.where.line());
  EXPECT_EQ(lines, (std::vector<std::size_t>{1, 2, 3, 3, 4, 5, 6, 7, 8, 8, 9, 10}))
    << render(result.diagnostics);
  EXPECT_FALSE(result.architecture);
}

} // namespace

} // namespace castor::cast
