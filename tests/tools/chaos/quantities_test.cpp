#include "castor/tools/chaos/quantities.hpp"

#include "castor/tools/chaos/rounded.hpp"

#include <gtest/gtest.h>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;

TEST(Quantities, TimesAreReadInAllUnits) {
  EXPECT_EQ(parse_time("20us"), 20us);
  EXPECT_EQ(parse_time("50ms"), 50ms);
  EXPECT_EQ(parse_time("1.5s"), 1500ms);
  EXPECT_EQ(parse_time("2min"), 2min);
  EXPECT_EQ(parse_time("1h"), 1h);
  EXPECT_EQ(parse_time("0s"), 0us);
  EXPECT_EQ(parse_time("0.000001s"), 1us);
}

TEST(Quantities, OtherTextsAreNoTimes) {
  for (auto text : {"", "s", "5", "5 s", "1.s", ".5s", "1.5us", "-1s", "1e3s", "1s2", "2days",
                    "1001h", "1000000000s", "0.0000001s", "1.2.3s"})
    EXPECT_EQ(parse_time(text), std::nullopt) << text;
  EXPECT_EQ(parse_time("1000h"), longest_time);
}

TEST(Quantities, PercentagesAndRatesHaveLimits) {
  EXPECT_EQ(parse_percent("10%"), Percent{10'000});
  EXPECT_EQ(parse_percent("0.125%"), Percent{125});
  EXPECT_EQ(parse_percent("100%"), everything);
  for (auto text : {"0%", "100.001%", "0.0001%", "10", "%", "-1%"})
    EXPECT_EQ(parse_percent(text), std::nullopt) << text;
  EXPECT_EQ(parse_rate("0.5/s"), Rate{500});
  for (auto text : {"0/s", "101/s", "0.5", "0.5/min"})
    EXPECT_EQ(parse_rate(text), std::nullopt) << text;
}

TEST(Quantities, AreWrittenInTheLargestUnitThatFits) {
  EXPECT_EQ(to_text(Timestamp{2s}), "2s");
  EXPECT_EQ(to_text(Timestamp{1500ms}), "1500ms");
  EXPECT_EQ(to_text(Timestamp{1'000'001us}), "1000001us");
  EXPECT_EQ(to_text(Percent{10'000}), "10%");
  EXPECT_EQ(to_text(Percent{10'020}), "10.02%");
  EXPECT_EQ(to_text(Percent{5}), "0.005%");
  EXPECT_EQ(to_text(Rate{500}), "0.5/s");
}

TEST(Quantities, AreRoundedForPeople) {
  EXPECT_EQ(rounded(0us), "0 us");
  EXPECT_EQ(rounded(235'934us), "236 ms");
  EXPECT_EQ(rounded(999'600us), "1 s");
  EXPECT_EQ(rounded(31'400ms), "31.4 s");
  EXPECT_EQ(rounded(-5s), "-5 s");
  EXPECT_EQ(rounded(1h), "3600 s");
}

} // namespace

} // namespace castor::faults
