#include "castor/tools/cli/man_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

Command tool() {
  Command run;
  run.path = {"tool", "run"};
  run.help = "run what a file describes: all of it";
  run.footer = "Ctrl-C stops it.\n"
               "Exit status: 0 if it ran, 3 if not.\n"
               "Examples: tool run 'x y' --for 10s\n"
               "          tool run .\\hidden";
  run.positionals = {{{}, "FILE", "the file", {}, {}, ValueKind::file, {}, {}, true, false}};
  run.options = {{{"-f", "--for"},
                  "DURATION",
                  "stop after so long",
                  {},
                  {},
                  ValueKind::text,
                  {},
                  {},
                  false,
                  false},
                 {{"--mode"},
                  "MODE",
                  "how; as `tool modes` shows",
                  {},
                  "fast",
                  ValueKind::choice,
                  {"fast", "slow"},
                  {},
                  false,
                  false}};
  run.inherited = {
    {{"--plugin"}, "FILE", "a library", {}, {}, ValueKind::file, {}, {}, false, true}};
  Command check;
  check.path = {"tool", "check"};
  check.help = "check it";
  Command result;
  result.path = {"tool"};
  result.help = "A tool.";
  result.commands = {run, check};
  return result;
}

std::string page(std::size_t command) {
  auto program = tool();
  return man_page(program.commands.at(command), program, {"1.2.3", "2026-01-31"});
}

TEST(ManPage, HasATitleWithDateAndVersion) {
  EXPECT_THAT(page(0), HasSubstr(".TH TOOL\\-RUN 1 \"2026-01-31\" \"tool 1.2.3\""));
}

TEST(ManPage, NamesTheCommandForWhoSearches) {
  EXPECT_THAT(page(0), HasSubstr(".SH NAME\ntool\\-run \\- run what a file describes\n"));
}

TEST(ManPage, ShowsWhatMayBeLeftOut) {
  EXPECT_THAT(page(0),
              HasSubstr(".SH SYNOPSIS\n\\fBtool run\\fR [\\fIOPTION\\fR ...] \\fIFILE\\fR\n"));
}

TEST(ManPage, ExplainsEveryArgument) {
  auto text = page(0);
  EXPECT_THAT(text, HasSubstr(".TP\n\\fIFILE\\fR\nThe file.\n"));
  EXPECT_THAT(
    text,
    HasSubstr(".TP\n\\fB\\-f\\fR, \\fB\\-\\-for\\fR \\fIDURATION\\fR\nStop after so long.\n"));
  EXPECT_THAT(text,
              HasSubstr("How; as \\fBtool modes\\fR shows. One of fast, slow. Default: fast.\n"));
  EXPECT_THAT(text, HasSubstr("\\fB\\-\\-plugin\\fR \\fIFILE\\fR"));
}

TEST(ManPage, MakesSectionsOfTheFooter) {
  auto text = page(0);
  EXPECT_THAT(text, HasSubstr("Ctrl-C stops it.\n"));
  EXPECT_THAT(text, HasSubstr(".SH EXIT STATUS\n0 if it ran, 3 if not.\n"));
  EXPECT_THAT(text, HasSubstr(".SH EXAMPLES\n"));
  EXPECT_THAT(text, Not(HasSubstr("Examples:")));
}

TEST(ManPage, KeepsListsOfTheFooter) {
  auto program = tool();
  program.commands[1].footer = "quick      a glance\nthorough   all of it\nThat is all.";
  auto text = man_page(program.commands[1], program, {"1.2.3", "2026-01-31"});
  EXPECT_THAT(text, HasSubstr(".TP\n\\fBquick\\fR\na glance\n"));
  EXPECT_THAT(text, HasSubstr(".TP\n\\fBthorough\\fR\nall of it\n.PP\nThat is all.\n"));
}

TEST(ManPage, LeavesNothingInTheTextForRoffToObey) {
  auto text = page(0);
  EXPECT_THAT(text, HasSubstr("\\fBtool run \\(aqx y\\(aq \\-\\-for 10s\\fR\n"));
  EXPECT_THAT(text, HasSubstr("\\fBtool run .\\ehidden\\fR\n"));
}

TEST(ManPage, BeginsNoLineWithADotWhereItBreaksText) {
  auto program = tool();
  program.commands[1].help = std::string(75, 'x') + " .cast files";
  auto text = man_page(program.commands[1], program, {"1.2.3", "2026-01-31"});
  EXPECT_THAT(text, HasSubstr("x\n\\&.cast files.\n"));
}

TEST(ManPage, HasTheUsualExitStatusWhereNoneIsSaid) {
  EXPECT_THAT(page(1), HasSubstr(".SH EXIT STATUS\n0 if all went well"));
}

TEST(ManPage, ListsTheCommandsOfAProgram) {
  auto program = tool();
  auto text = man_page(program, program, {"1.2.3", "2026-01-31"});
  EXPECT_THAT(text, HasSubstr(".SH COMMANDS\n.TP\n\\fBtool\\-run\\fR(1)\nRun what a file"));
  EXPECT_THAT(text, HasSubstr(".SH EXAMPLES\n.nf\n.RS\n\\fBtool run"));
  EXPECT_THAT(text, HasSubstr(".SH SEE ALSO\n\\fBtool\\-run\\fR(1),\n\\fBtool\\-check\\fR(1)\n"));
}

} // namespace
} // namespace castor::cli
