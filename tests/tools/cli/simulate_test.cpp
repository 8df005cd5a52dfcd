#include "castor/tests/support/eventually.hpp"
#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>

namespace castor {

namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class Simulate : public test::Castor {
protected:
  /// The report without what differs from run to run.
  static json comparable(const std::string& text) {
    auto result = json::parse(text);
    result.erase("seconds");
    result.erase("systems_per_second");
    return result;
  }

  std::string state() const { return (folder / "state.json").string(); }
};

} // namespace

TEST_F(Simulate, ReportsWhatHappenedAndTheVerdict) {
  auto answer = ask({"simulate", "--seeds", "1..60"});
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("60 of 60 systems were simulated (seeds 1..60)"));
  for (auto* group : {"calls", "faults", "journals", "machines", "operations", "outages", "tasks"})
    EXPECT_THAT(answer.output, HasSubstr(std::string{"\n  "} + group)) << answer.output;
  EXPECT_THAT(answer.output, HasSubstr("verdict: held\n"));
}

TEST_F(Simulate, GivesTheSameReportForTheSameSeeds) {
  auto one = ask({"simulate", "--seeds", "7..90", "--threads", "1", "--json"});
  auto two = ask({"simulate", "--seeds", "7..90", "--threads", "2", "--json"});
  EXPECT_EQ(comparable(one.output), comparable(two.output));
  EXPECT_EQ(comparable(one.output)["done"], 84);
}

TEST_F(Simulate, GoesOnFromItsStateFileAfterCtrlC) {
  test::Process castor{command({"simulate", "--seeds", "1..100000000", "--state", state()})};
  // It has begun once its state is there.
  ASSERT_TRUE(test::eventually([&] { return std::filesystem::exists(state()); }));
  castor.send_signal(SIGINT);
  EXPECT_EQ(castor.wait(), 3) << castor.errors();
  EXPECT_THAT(castor.errors(), HasSubstr("the same command goes on, from " + state()));
  EXPECT_THAT(castor.output(), HasSubstr("verdict: held so far"));
  auto done = json::parse(read(state()))["done"].get<std::uint64_t>();
  auto wanted = std::to_string(done + 70);
  auto answer = ask({"simulate", "--seeds", "1.." + wanted, "--state", state(), "--json"});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_EQ(comparable(answer.output)["done"], done + 70);
  EXPECT_EQ(comparable(read(state())), comparable(answer.output));
  EXPECT_EQ(comparable(answer.output),
            comparable(ask({"simulate", "--seeds", "1.." + wanted, "--json"}).output))
    << "as if it had not been interrupted";
}

TEST_F(Simulate, RefusesAStateThatIsNotOfTheseSeeds) {
  ask({"simulate", "--seeds", "1..10", "--state", state()});
  auto other = ask({"simulate", "--seeds", "2..10", "--state", state()});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.errors, HasSubstr("from seed 1, not from 2"));
  auto fewer = ask({"simulate", "--seeds", "1..5", "--state", state()});
  EXPECT_EQ(fewer.status, 2);
  EXPECT_THAT(fewer.errors, HasSubstr("up to 10 are done already"));
  auto broken = write("broken.json", "{\"format\":");
  auto damaged = ask({"simulate", "--seeds", "1..5", "--state", broken});
  EXPECT_EQ(damaged.status, 2);
  EXPECT_THAT(damaged.errors, HasSubstr("it is no state of a simulation"));
}

TEST_F(Simulate, ShowsOneSystemWithFaultsOfAFile) {
  auto plan = write("one.plan", "at 300ms crash a1\n");
  auto answer = ask({"simulate", "--seed", "5", "--faults", plan});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("entry 0: "));
  EXPECT_THAT(answer.output, HasSubstr("faults:\nat 300ms crash a1\n"));
  EXPECT_THAT(answer.errors, HasSubstr("[a1]"));
}

TEST_F(Simulate, RefusesFaultsThatItCannotInject) {
  for (auto* line : {"at 1s crash zebra", "every 1s crash a1", "at 1s crash any component",
                     "at 1s kill node7", "at 1s hang a1", "at 1s slow a1 by 1s for 1s"}) {
    auto answer = ask({"simulate", "--seed", "5", "--faults", write("one.plan", line)});
    EXPECT_EQ(answer.status, 2) << line << answer.output;
    EXPECT_THAT(answer.errors, HasSubstr("one.plan:1: error: ")) << line;
  }
}

TEST_F(Simulate, KeepsItsComponentsToItself) {
  EXPECT_THAT(ask({"components"}).output, Not(HasSubstr("is simulated")));
}

} // namespace castor
