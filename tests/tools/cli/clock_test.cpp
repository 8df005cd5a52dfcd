#include "castor/tests/support/eventually.hpp"
#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;
using testing::HasSubstr;

/// `castor run` with simulated time, and `castor clock`.
class ClockCommand : public Castor {
protected:
  /// Number of the last tick of a ticker that ticks every 10 ms from 0 s on.
  int ticks_after(const std::vector<std::string>& options) const {
    auto output = (folder / "output").string();
    std::vector<std::string> arguments{"run", system("CPP UM ticker Ticker\n"), "--output", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    auto answer = ask(arguments);
    EXPECT_EQ(answer.status, 0) << answer.errors;
    const auto entries = json::parse(read(folder / "output" / "entries.json"));
    for (auto& entry : entries["a"])
      if (entry["type"] == "Tick")
        return entry["value"]["number"];
    ADD_FAILURE() << "there is no tick";
    return 0;
  }

  json show() const {
    auto answer = ask({"clock", "show", "--json"});
    EXPECT_EQ(answer.status, 0) << answer.errors;
    return json::parse(answer.output);
  }
};

TEST_F(ClockCommand, ARunIsAsLongAsItsSimulatedTime) {
  EXPECT_EQ(ticks_after({"--speed", "max", "--for", "60s"}), 6001);
}

TEST_F(ClockCommand, AReproducibleRunIs) {
  EXPECT_EQ(ticks_after({"--reproducible", "--for", "10s"}), 1001);
}

TEST_F(ClockCommand, SoIsARunOverProcesses) {
  EXPECT_EQ(ticks_after({"--speed", "max", "--for", "10s", "--spread", "2"}), 1001);
}

TEST_F(ClockCommand, AReproducibleRunNeedsOneProcess) {
  auto answer = ask(
    {"run", system("CPP UM ticker Ticker\n"), "--reproducible", "--spread", "2", "--for", "1s"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, HasSubstr("a run is reproducible in one process only"));
}

TEST_F(ClockCommand, TimeIsPausedSteppedAndRun) {
  Process castor{
    command({"run", system("CPP UM ticker Ticker\n"), "--speed", "paused", "--for", "2s"})};
  ASSERT_TRUE(eventually([&] { return ask({"clock", "show"}).status == 0; }));
  EXPECT_EQ(show(),
            (json{{"kind", "simulated"}, {"time", 0.0}, {"speed", "max"}, {"paused", true}}));
  EXPECT_EQ(ask({"clock", "step", "500ms"}).status, 0);
  EXPECT_TRUE(eventually([&] { return show()["time"] == 0.5; }));
  EXPECT_THAT(ask({"ps"}).output,
              HasSubstr("\nsimulated time 0.500 s, as fast as possible, paused\n"));
  EXPECT_EQ(ask({"clock", "run", "--speed", "max"}).status, 0);
  EXPECT_EQ(castor.wait(), 0) << castor.errors();
}

TEST_F(ClockCommand, TheRealClockIsShownAndCannotBeSet) {
  Process castor{command({"run", system("CPP UM ticker Ticker\n"), "--for", "100s"})};
  ASSERT_TRUE(eventually([&] { return ask({"clock", "show"}).status == 0; }));
  EXPECT_EQ(show(), (json{{"kind", "real"}}));
  auto answer = ask({"clock", "pause"});
  EXPECT_NE(answer.status, 0);
  EXPECT_THAT(answer.errors, HasSubstr("castor run --speed"));
}

} // namespace

} // namespace castor::test
