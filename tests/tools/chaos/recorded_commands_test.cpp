#include "castor/tools/chaos/recorded_commands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace castor::faults::test {

namespace {

using testing::HasSubstr;
using Verdict = linearizability::Verdict;

/// Writes the log of a process: times in milliseconds.
class CommandLog {
public:
  void lock(const std::string& who, int token, int at) {
    ++number_;
    text_ << R"({"begin": )" << number_ << R"(, "at": )" << at - 1 << R"(000000, "component": ")"
          << who << R"(", "life": 1, "do": "lock", "where": "a", "id": "drive", "level": 0})"
          << "\n"
          << R"({"end": )" << number_ << R"(, "at": )" << at << R"(000000, "token": )" << token
          << "}\n";
  }

  void obeys(const std::string& who, int token, int at, bool demands_lease = true) {
    text_ << R"({"obeys": "wheel", "at": )" << at << R"(000000, "type": "Turn", "component": ")"
          << who << R"(", "life": 1, "token": )" << token
          << (demands_lease ? R"(, "where": "a", "id": "drive")" : "") << "}\n"
          << R"({"rests": "wheel", "at": )" << at << R"(000001, "type": "Turn"})"
          << "\n";
  }

  Judgement judge() const {
    std::istringstream operations{text_.str()};
    RecordingReader reader;
    reader.read(operations);
    std::istringstream lines{text_.str()};
    std::vector<ObeyedCommand> commands;
    read_commands(lines, commands);
    return judge_commands(commands, reader.take());
  }

private:
  std::ostringstream text_;
  int number_ = 0;
};

TEST(CommandsWithValidTokens, TheHolderIsObeyed) {
  CommandLog log;
  log.lock("ann", 7, 10);
  log.obeys("ann", 7, 20);
  log.obeys("ann", 7, 30);
  auto judgement = log.judge();
  EXPECT_EQ(judgement.verdict, Verdict::Kind::ok) << judgement.report;
  EXPECT_EQ(judgement.grounds, "2 commands obeyed, 2 of them under a lease");
}

TEST(CommandsWithValidTokens, WithoutALeaseAnybodyMayCommand) {
  CommandLog log;
  log.obeys("ann", 0, 20, false);
  EXPECT_EQ(log.judge().verdict, Verdict::Kind::ok);
}

TEST(CommandsWithValidTokens, ATokenOfNobodyIsAViolation) {
  CommandLog log;
  log.lock("ann", 7, 10);
  log.obeys("bob", 7, 20);
  auto judgement = log.judge();
  EXPECT_EQ(judgement.verdict, Verdict::Kind::violation);
  EXPECT_EQ(judgement.report, "wheel obeyed a Turn of bob (incarnation 1, token 7), but it was "
                              "never granted that lease of a/drive\n");
}

TEST(CommandsWithValidTokens, AFormerHolderIsObeyedForAsLongAsItsLeaseIsTrusted) {
  CommandLog log;
  log.lock("ann", 7, 10);
  log.lock("bob", 8, 100);
  log.obeys("ann", 7, 200);
  EXPECT_EQ(log.judge().verdict, Verdict::Kind::ok);
  log.obeys("ann", 7, 201);
  auto judgement = log.judge();
  EXPECT_EQ(judgement.verdict, Verdict::Kind::violation);
  EXPECT_THAT(judgement.report,
              HasSubstr("101 ms after bob had got the lease of a/drive (token 8)"));
}

TEST(CommandsWithValidTokens, NobodyIsObeyedAfterHisSuccessor) {
  CommandLog log;
  log.lock("ann", 7, 10);
  log.lock("bob", 8, 100);
  log.obeys("bob", 8, 101);
  log.obeys("ann", 7, 103);
  auto judgement = log.judge();
  EXPECT_EQ(judgement.verdict, Verdict::Kind::violation);
  EXPECT_THAT(judgement.report, HasSubstr("2 ms after one of bob with token 8"));
}

} // namespace

} // namespace castor::faults::test
