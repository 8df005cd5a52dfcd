// The system of `desk.cast` under faults: no action is executed twice, and no motive is lost.

#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;

class DeskChaos : public Castor {
protected:
  void SetUp() override {
    Castor::SetUp();
    // Journals come into the folder in which the command runs.
    std::filesystem::current_path(folder);
  }

  /// What `castor chaos` found, as JSON.
  json run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{"chaos", CASTOR_DESK "/desk.cast", "--report",
                                 (folder / "report").string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto answer = ask(all);
    EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
    EXPECT_THAT(answer.output,
                AllOf(ContainsRegex("ok +no action twice +[1-9][0-9]+ actions of 3 types"),
                      ContainsRegex("ok +expected changes +[1-9][0-9]* entries, within"),
                      ContainsRegex("ok +no forbidden change")));
    return json::parse(read(folder / "report" / "chaos.json"));
  }
};

TEST_F(DeskChaos, NoActionIsExecutedTwiceAndNoMotiveIsLost) {
  run({"--duration", "25s", "--seed", "1"});
}

TEST_F(DeskChaos, NorWhenProcessesAreKilledInTheMidstOfPlanningAndActing) {
  const auto report = run({"--duration", "25s", "--plan", CASTOR_DESK "/desk-kills.plan"});
  std::size_t killed = 0;
  for (const auto& x : report["faults"])
    killed += x["kind"] == "kill" && x["state"] == "happened" ? 1 : 0;
  EXPECT_GE(killed, 5U) << report["faults"];
}

} // namespace

} // namespace castor::test
