#include "castor/actors/cast/reader.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace castor::cast {

namespace {

using test::World;

std::vector<std::string> texts(const Source& source) {
  std::vector<std::string> result;
  for (const auto& line : source.lines)
    if (line.kind == SourceLine::Kind::text)
      result.emplace_back(line.text);
  return result;
}

std::vector<std::string> read(std::string_view text, World world = {}) {
  DiagnosticLog log(10);
  auto options = test::options_for(std::move(world));
  return texts(read_source(text, "main.cast", options, log));
}

using Lines = std::vector<std::string>;

TEST(Reader, TrimsEveryLineAndKeepsBlankOnes) {
  EXPECT_EQ(read("  a b \t\n\n\tc"), (Lines{"a b", "", "c"}));
}

TEST(Reader, EndsLinesAtAnyKindOfLineBreak) {
  EXPECT_EQ(read("a\r\nb\rc\nd"), (Lines{"a", "b", "c", "d"}));
  EXPECT_EQ(read("a\n"), Lines{"a"});
  EXPECT_EQ(read(""), Lines{});
}

TEST(Reader, SkipsAByteOrderMark) {
  EXPECT_EQ(read("\xef\xbb\xbfHOST a"), Lines{"HOST a"});
}

TEST(Reader, CountsLinesFromOne) {
  DiagnosticLog log(10);
  auto options = test::options_for({});
  auto source = read_source("a\n\nb", "main.cast", options, log);
  EXPECT_EQ(to_string(source.lines.back().where()), "main.cast:3");
}

TEST(Reader, PutsAnIncludedFileInThePlaceOfTheLine) {
  World world{{{"other.cast", "b\nc"}}, {}};
  EXPECT_EQ(read("a\nINCLUDE other.cast\nd", world), (Lines{"a", "b", "c", "d"}));
}

TEST(Reader, TakesTheRestOfTheLineForThePath) {
  World world{{{"my other file.cast", "b"}}, {}};
  EXPECT_EQ(read("INCLUDE \t my other file.cast  ", world), Lines{"b"});
}

TEST(Reader, LooksForFilesBesideTheIncludingFile) {
  World world{{{"parts/a.cast", "INCLUDE b.cast\nINCLUDE sub/c.cast\nINCLUDE /etc/d.cast"},
               {"parts/b.cast", "b"},
               {"parts/sub/c.cast", "c"},
               {"/etc/d.cast", "d"}},
              {}};
  EXPECT_EQ(read("INCLUDE parts/a.cast", world), (Lines{"b", "c", "d"}));
}

TEST(Reader, FindsIncludesOfAMainFileWithADirectory) {
  World world{{{"config/main.cast", "INCLUDE a.cast"}, {"config/a.cast", "a"}}, {}};
  DiagnosticLog log(10);
  auto options = test::options_for(world);
  EXPECT_EQ(texts(read_source("config/main.cast", options, log)), Lines{"a"});
  EXPECT_FALSE(log.has_errors());
}

TEST(Reader, FindsIncludesOfAMainFileWithABareName) {
  World world{{{"main.cast", "INCLUDE a.cast"}, {"a.cast", "a"}}, {}};
  DiagnosticLog log(10);
  auto options = test::options_for(world);
  EXPECT_EQ(texts(read_source("main.cast", options, log)), Lines{"a"});
  EXPECT_FALSE(log.has_errors());
}

TEST(Reader, LeavesCommentedIncludesAlone) {
  EXPECT_EQ(read("#INCLUDE missing.cast"), Lines{"#INCLUDE missing.cast"});
}

TEST(Reader, IncludesTheSameFileTwice) {
  World world{{{"a.cast", "a"}}, {}};
  EXPECT_EQ(read("INCLUDE a.cast\nINCLUDE a.cast", world), (Lines{"a", "a"}));
}

TEST(Reader, LoadsAFileOnceHoweverOftenItIsIncluded) {
  int loads = 0;
  auto options = test::options_for({});
  options.load = [&loads](const std::string&, std::size_t) -> FileContent {
    ++loads;
    return {"a", {}};
  };
  DiagnosticLog log(10);
  read_source("INCLUDE a.cast\nINCLUDE a.cast", "main.cast", options, log);
  EXPECT_EQ(loads, 1);
}

TEST(Reader, RemembersTheIncludeChain) {
  World world{{{"a.cast", "\nINCLUDE b.cast"}, {"b.cast", "x"}}, {}};
  DiagnosticLog log(10);
  auto options = test::options_for(world);
  auto source = read_source("\n\nINCLUDE a.cast", "main.cast", options, log);
  auto found = std::find_if(source.lines.begin(), source.lines.end(),
                            [](const SourceLine& line) { return line.text == "x"; });
  ASSERT_NE(found, source.lines.end());
  EXPECT_EQ(found->where().include_chain(),
            (std::vector<IncludeSite>{{"a.cast", 2}, {"main.cast", 3}}));
}

TEST(Reader, MarksEntriesIntoFilesAndReturns) {
  World world{{{"a.cast", ""}}, {}};
  DiagnosticLog log(10);
  auto options = test::options_for(world);
  auto source = read_source("INCLUDE a.cast", "main.cast", options, log);
  std::vector<std::string> entered;
  for (const auto& line : source.lines)
    if (line.kind == SourceLine::Kind::enter_file)
      entered.push_back(line.unit->file);
  EXPECT_EQ(entered, (std::vector<std::string>{"main.cast", "a.cast", "main.cast"}));
}

TEST(Reader, IncludesFilesInDisabledBlocksToo) {
  auto result = test::parse("IFTRUE(no)\nINCLUDE missing.cast\nENDIF");
  EXPECT_TRUE(test::reports(result, Severity::error, 2, "cannot read 'missing.cast'"));
}

TEST(Reader, DisablesTheLinesOfAFileInADisabledBlock) {
  World world{{{"a.cast", "SETVAR x=2"}}, {}};
  EXPECT_EQ(test::values("SETVAR x=1\nIFTRUE(no)\nINCLUDE a.cast\nENDIF\n#EXPAND %(x)", world),
            Lines{"1"});
}

TEST(Reader, LetsBlocksSpanFiles) {
  World world{{{"begin.incl", "IFTRUE(no)"}, {"end.incl", "ENDIF"}}, {}};
  EXPECT_EQ(test::values("SETVAR x=1\nINCLUDE begin.incl\nSETVAR x=2\nINCLUDE end.incl\n"
                         "#EXPAND %(x)",
                         world),
            Lines{"1"});
}

TEST(Reader, ReportsAMissingFileAndGoesOn) {
  auto result = test::parse("INCLUDE no.cast\nINCLUDE neither.cast\nSETVAR x=1\n#EXPAND %(x)");
  EXPECT_TRUE(test::reports(result, Severity::error, 1, "cannot read 'no.cast': no such file",
                            "relative to the directory of the including file"));
  EXPECT_TRUE(test::reports(result, Severity::error, 2, "cannot read 'neither.cast'"));
  EXPECT_EQ(result.expansions, Lines{"#EXPAND 1"});
}

TEST(Reader, ExplainsWhyAPathIsTakenLiterally) {
  EXPECT_TRUE(test::reports(test::parse("INCLUDE a.cast # comment"), Severity::error, 1,
                            "cannot read", "comment on a line of its own"));
  EXPECT_TRUE(test::reports(test::parse("INCLUDE %(dir)/a.cast"), Severity::error, 1, "cannot read",
                            "variables are not replaced"));
  EXPECT_TRUE(test::reports(test::parse("INCLUDE $HOME/a.cast"), Severity::error, 1, "cannot read",
                            "variables are not replaced"));
}

TEST(Reader, ReportsAnIncludeWithoutAPath) {
  EXPECT_TRUE(
    test::reports(test::parse("INCLUDE"), Severity::error, 1, "without a path", "INCLUDE other"));
  EXPECT_TRUE(test::reports(test::parse("INCLUDE  "), Severity::error, 1, "without a path"));
}

TEST(Reader, SkipsOneCharacterBehindTheKeyword) {
  World world{{{"a.cast", "x"}}, {}};
  EXPECT_EQ(read("INCLUDE:a.cast", world), Lines{"x"});
  EXPECT_TRUE(test::reports(test::parse("INCLUDE:a.cast", world), Severity::warning, 1,
                            "not part of the path", "put a blank"));
}

TEST(Reader, ReportsAMissingMainFile) {
  auto result = parse_file("nowhere.cast", test::options_for({}));
  EXPECT_FALSE(result.ok());
  EXPECT_EQ(result.diagnostics.size(), 1U);
  EXPECT_TRUE(test::reports(result, Severity::error, 0, "cannot read 'nowhere.cast': no such file",
                            "", "nowhere.cast"));
}

TEST(Reader, NamesTheFilesOfAnIncludeCycle) {
  World world{{{"a.cast", "INCLUDE ./b.cast"}, {"./b.cast", "\nINCLUDE a.cast"}}, {}};
  world.files["./a.cast"] = world.files["a.cast"];
  auto result = test::parse("INCLUDE a.cast", world);
  EXPECT_TRUE(test::reports(result, Severity::error, 2, "in a cycle: a.cast -> b.cast -> a.cast",
                            "remove one", "./b.cast"));
}

TEST(Reader, ReportsAFileThatIncludesItself) {
  World world{{{"main.cast", "INCLUDE main.cast"}}, {}};
  auto result = parse_file("main.cast", test::options_for(world));
  EXPECT_TRUE(
    test::reports(result, Severity::error, 1, "in a cycle: main.cast -> main.cast", "remove"));
}

TEST(Reader, RefusesFilesThatAreNoText) {
  World world{{{"a.cast", std::string("HOST a\nHOST \0b", 14)}, {"b.cast", "\xff\xfeH"}}, {}};
  auto result = test::parse("INCLUDE a.cast\nINCLUDE b.cast", world);
  EXPECT_TRUE(test::reports(result, Severity::error, 1, "line 2 contains a zero byte"));
  EXPECT_TRUE(test::reports(result, Severity::error, 2, "UTF-16; save it as UTF-8"));
  EXPECT_FALSE(test::parse(std::string_view("\0", 1)).ok());
}

} // namespace

} // namespace castor::cast
