#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace castor::test {

namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

/// `wheel.cast`: a wheel and two drivers of a plug-in, over three nodes.
class EffectorChaos : public Castor {
protected:
  Answer run(const std::string& duration) const {
    auto wheel = std::filesystem::path{CASTOR_WHEEL};
    return ask({"chaos", wheel.string(), "--plan", wheel.replace_extension("plan").string(),
                "--duration", duration, "--settle", "300ms", "--report",
                (folder / "report").string()});
  }
};

TEST_F(EffectorChaos, OnlyTheHolderOfTheLeaseTurnsTheWheelWhateverFails) {
  auto answer = run("8s");
  EXPECT_EQ(answer.status, 0) << answer.output << answer.errors;
  EXPECT_THAT(answer.output,
              AllOf(HasSubstr("wheel.cast: held"),
                    ContainsRegex("ok +commands with valid tokens +[1-9][0-9]+ commands obeyed, "
                                  "[1-9][0-9]+ of them under a lease")));
  // The faults met drivers while they held the lease.
  auto report = json::parse(read(folder / "report" / "chaos.json"));
  std::size_t stopped = 0;
  for (auto& x : report["faults"])
    stopped += x["fault"] == "stop one for 800ms" && x["state"] == "happened" ? 1 : 0;
  EXPECT_GT(stopped, 0U) << report["faults"];
}

} // namespace

} // namespace castor::test
