#include "castor/tests/tools/cli/castor_fixture.hpp"

#include "castor/tests/support/eventually.hpp"
#include "castor/tests/support/terminal.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/progress_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;
using test::screen;
using test::Terminal;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string last_line_of(Terminal& terminal) {
  return screen(terminal.written()).back();
}

TEST(ProgressLine, ShowsTheShareTheTimesAndTheText) {
  EXPECT_EQ(progress_line({"export", 25, 100, 10s, "25 of 100 MB"}, 100),
            "export  [#####...............]  25%  10 s, 30 s left  25 of 100 MB");
}

TEST(ProgressLine, ShowsTheTimeOnlyIfNobodyKnowsTheTotal) {
  EXPECT_EQ(progress_line({"checking", 25, {}, 65s, "camera"}, 100),
            "checking  1 min 05 s  camera");
  EXPECT_EQ(progress_line({"checking", 25, 0, 2h + 3min, {}}, 100), "checking  2 h 03 min");
}

TEST(ProgressLine, EstimatesNothingInTheBeginningAndInTheEnd) {
  EXPECT_THAT(progress_line({"export", 25, 100, 2s, {}}, 100), Not(HasSubstr("left")));
  EXPECT_THAT(progress_line({"export", 0, 100, 20s, {}}, 100), Not(HasSubstr("left")));
  EXPECT_THAT(progress_line({"export", 1e-9, 100, 20s, {}}, 100), Not(HasSubstr("left")));
  EXPECT_THAT(progress_line({"export", 100, 100, 20s, {}}, 100),
              AllOf(HasSubstr("100%"), Not(HasSubstr("left"))));
}

TEST(ProgressLine, StaysWithinTheTotal) {
  EXPECT_THAT(progress_line({"export", 120, 100, 2s, {}}, 100),
              HasSubstr("[####################] 100%"));
  EXPECT_THAT(progress_line({"export", -5, 100, 2s, {}}, 100),
              HasSubstr("[....................]   0%"));
}

TEST(ProgressLine, IsNotCompleteBeforeTheEnd) {
  EXPECT_THAT(progress_line({"export", 99'999, 100'000, 2s, {}}, 100), HasSubstr(" 99%"));
}

TEST(ProgressLine, LeavesTheBarOutWhereThereIsNoRoom) {
  EXPECT_EQ(progress_line({"export", 25, 100, 10s, "25 of 100 MB"}, 50),
            "export   25%  10 s, 30 s left  25 of 100 MB");
}

TEST(ProgressLine, FitsIntoEveryWidth) {
  const ProgressState state{"prüfe", 25, 100, 10s, "größer — 25 of 100 MB"};
  for (std::size_t columns = 0; columns < 100; ++columns) {
    auto line = progress_line(state, columns);
    std::size_t characters = 0;
    for (unsigned char c : line)
      characters += (c & 0xC0U) != 0x80U;
    EXPECT_LE(characters, columns) << line;
  }
  EXPECT_EQ(progress_line(state, 6), "prü...");
}

TEST(ProgressLine, StaysOneLine) {
  EXPECT_EQ(progress_line({"export", 0, {}, 1s, "a\nb\x1b[2J"}, 100), "export  1 s  a b [2J");
}

class ProgressOnTerminal : public testing::Test {
protected:
  void SetUp() override { setenv("TERM", "xterm", 1); }

  static std::string last_line(Terminal& terminal) { return last_line_of(terminal); }
};

TEST_F(ProgressOnTerminal, IsDrawnAndErased) {
  Terminal terminal;
  {
    Progress progress{"export", terminal.descriptor()};
    progress.update(25, 100, "25 of 100 MB");
    ASSERT_TRUE(terminal.wait_for("25 of 100 MB"));
    EXPECT_THAT(last_line(terminal), StartsWith("export  [#####....."));
    EXPECT_TRUE(test::eventually([&] { return progress.due(); }));
    progress.update("on its own");
    ASSERT_TRUE(terminal.wait_for("on its own"));
  }
  EXPECT_TRUE(test::eventually([&] { return last_line(terminal).empty(); }));
}

TEST_F(ProgressOnTerminal, RespectsTheWidth) {
  Terminal terminal{20};
  Progress progress{"export", terminal.descriptor()};
  progress.update(25, 100, "25 of 100 MB");
  ASSERT_TRUE(terminal.wait_for("export"));
  EXPECT_EQ(last_line(terminal), "export   25%  0 ...");
}

TEST_F(ProgressOnTerminal, GivesWayToOtherOutput) {
  Terminal terminal;
  Progress progress{"export", terminal.descriptor()};
  progress.update("first");
  ASSERT_TRUE(terminal.wait_for("first"));
  {
    ProgressPause pause;
    ASSERT_EQ(write(terminal.descriptor(), "a message\n", 10), 10);
  }
  progress.update("second");
  ASSERT_TRUE(terminal.wait_for("second"));
  EXPECT_THAT(screen(terminal.written()),
              ElementsAre("a message", AllOf(StartsWith("export"), EndsWith("second"))));
}

TEST_F(ProgressOnTerminal, ShowsTheInnermostTask) {
  Terminal terminal;
  Progress outer{"outer", terminal.descriptor()};
  {
    Progress inner{"inner", terminal.descriptor()};
    ASSERT_TRUE(terminal.wait_for("inner"));
    EXPECT_THAT(terminal.written(), Not(HasSubstr("outer")));
  }
  EXPECT_TRUE(terminal.wait_for("outer"));
}

TEST_F(ProgressOnTerminal, IsRedrawnTenTimesASecondAtMost) {
  Terminal terminal;
  auto begin = std::chrono::steady_clock::now();
  std::uint64_t updates = 0;
  {
    Progress progress{"export", terminal.descriptor()};
    for (; std::chrono::steady_clock::now() < begin + 1s; ++updates)
      progress.update(static_cast<double>(updates), {}, "working");
  }
  auto took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  auto drawn = std::ranges::count(terminal.written(), '\r');
  EXPECT_GT(updates, 1000U);
  EXPECT_LE(static_cast<double>(drawn), took * 10 + 2);
}

TEST_F(ProgressOnTerminal, IsNotShownElsewhere) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  EXPECT_FALSE(Progress::is_shown_on(pipe_ends[1]));
  Terminal terminal;
  EXPECT_TRUE(Progress::is_shown_on(terminal.descriptor()));
  setenv("TERM", "dumb", 1);
  EXPECT_FALSE(Progress::is_shown_on(terminal.descriptor()));
  unsetenv("TERM");
  EXPECT_FALSE(Progress::is_shown_on(terminal.descriptor()));
  Progress progress{"export", pipe_ends[1]};
  progress.update(1, 2, "text");
  EXPECT_FALSE(progress.due());
  for (int x : pipe_ends)
    close(x);
}

TEST_F(ProgressOnTerminal, IsErasedWhenCtrlCEndsTheProcess) {
  Terminal terminal;
  auto child = fork();
  if (child == 0) {
    Progress progress{"export", terminal.descriptor()};
    for (;;)
      pause();
  }
  ASSERT_TRUE(terminal.wait_for("export"));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  EXPECT_TRUE(test::eventually([&] { return last_line(terminal).empty(); }));
}

class ProgressOfStart : public test::Castor {};

TEST_F(ProgressOfStart, NamesTheNodesThatAreWaitedFor) {
  setenv("TERM", "xterm", 1);
  Terminal terminal{120};
  // Nobody listens there.
  terminal.start(command({"run", "--node", "arm=127.0.0.1:1", system("arm CPP UM clock Clock\n")}));
  EXPECT_TRUE(terminal.wait_for("waiting for nodes: arm"));
  EXPECT_EQ(terminal.wait(), 2);
  for (auto& line : screen(terminal.written()))
    EXPECT_THAT(line, Not(StartsWith("starting  "))) << testing::PrintToString(terminal.written());
}

/// What is shown of a run of `castor chaos`.
class ProgressOfChaos : public test::Castor {
protected:
  std::vector<std::string> chaos(const std::string& duration) const {
    return command({"chaos",
                    system("CPP UM clock Clock\nCPP UM listener Listener --count 100000\n"),
                    "--plan", write("system.plan", "at 200ms crash clock\n"), "--duration",
                    duration, "--settle", "100ms"});
  }
};

TEST_F(ProgressOfChaos, IsTheLastLineOfTheTerminal) {
  setenv("TERM", "xterm", 1);
  Terminal terminal{120};
  terminal.start(chaos("2s"));
  ASSERT_TRUE(terminal.wait_for("faults: 1, components down: 0"));
  EXPECT_THAT(last_line_of(terminal), StartsWith("chaos  ["));
  terminal.wait();
  for (auto& line : screen(terminal.written()))
    EXPECT_THAT(line, Not(StartsWith("chaos  ")));
}

TEST_F(ProgressOfChaos, LeavesACleanLineAtCtrlC) {
  setenv("TERM", "xterm", 1);
  Terminal terminal{120};
  terminal.start(chaos("10min"));
  ASSERT_TRUE(terminal.wait_for("faults: 1"));
  terminal.type("\x03");
  terminal.wait();
  for (auto& line : screen(terminal.written()))
    EXPECT_THAT(line, Not(HasSubstr("chaos  [")));
}

TEST_F(ProgressOfChaos, IsNothingInAPipe) {
  setenv("TERM", "xterm", 1);
  test::Process castor{chaos("1s")};
  castor.wait();
  EXPECT_THAT(
    castor.output() + castor.errors(),
    AllOf(Not(HasSubstr("\r")), Not(HasSubstr("components down:")), HasSubstr("[clock]")));
}

} // namespace

} // namespace castor::cli
