#include "castor/tools/chaos/recorded_actions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace castor::faults::test {

namespace {

using linearizability::Verdict;

Judgement judge(const std::string& log) {
  std::istringstream in{log};
  std::vector<ExecutedAction> actions;
  read_actions(in, actions);
  return judge_actions(actions);
}

std::string begins(const std::string& who, int life, const std::string& action, int at) {
  return R"({"executes": ")" + who + R"(", "at": )" + std::to_string(at) + R"(, "life": )" +
         std::to_string(life) + R"(, "type": "PickUp", "where": "planning", "id": ")" + action +
         "\"}\n";
}

TEST(ActionsExecutedOnce, OtherLinesAndOtherActionsDoNotMatter) {
  const auto judgement =
    judge(begins("arm", 1, "0:1", 5) + R"({"begin": 1, "at": 6, "do": "read"})" + "\n" +
          begins("arm", 2, "1:1", 7) + "{\"executes\": \"ar");
  EXPECT_EQ(judgement.verdict, Verdict::Kind::ok) << judgement.report;
  EXPECT_EQ(judgement.grounds, "2 actions of 1 type");
}

TEST(ActionsExecutedOnce, NotByTheSuccessorOfWhoHasBegun) {
  const auto judgement = judge(begins("arm", 2, "0:1", 9) + begins("arm", 1, "0:1", 5));
  EXPECT_EQ(judgement.verdict, Verdict::Kind::violation);
  EXPECT_EQ(judgement.report, "arm (incarnation 2) executed the PickUp planning/0:1, which arm "
                              "(incarnation 1) had begun before\n");
}

TEST(ActionsExecutedOnce, NotByTheSameOnceMore) {
  const auto judgement = judge(begins("arm", 1, "0:1", 5) + begins("arm", 1, "0:1", 6));
  EXPECT_EQ(judgement.verdict, Verdict::Kind::violation);
}

} // namespace

} // namespace castor::faults::test
