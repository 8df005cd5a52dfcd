#include "castor/tools/simulation/campaign.hpp"

#include "castor/tools/simulation/campaign_report.hpp"
#include "castor/tools/simulation/seeds.hpp"
#include "castor/tools/simulation/system_simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace castor::simulation {

namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Without what differs from run to run.
std::string comparable(CampaignReport x) {
  x.elapsed = {};
  return to_json(x);
}

CampaignOptions options(Seeds seeds, unsigned threads = 1) {
  CampaignOptions result;
  result.seeds = seeds;
  result.threads = threads;
  return result;
}

} // namespace

TEST(Seeds, AreANumberOrTwo) {
  EXPECT_EQ(parse_seeds("7"), (Seeds{7, 7}));
  EXPECT_EQ(parse_seeds("1..1000000"), (Seeds{1, 1'000'000}));
  EXPECT_EQ(parse_seeds("0..18446744073709551614").size(), 18446744073709551615u);
  for (auto* text : {"", "..", "1..", "..2", "2..1", "-1..2", "1.5", "1...2", "a..b", "1..2 ",
                     "0..18446744073709551615", "18446744073709551616"})
    EXPECT_THROW(parse_seeds(text), std::invalid_argument) << text;
}

TEST(Happenings, AddUpAndKnowWhatNeverHappened) {
  auto all = Happenings::everything();
  EXPECT_THAT(all.never(), Contains("faults: crash"));
  Happenings some;
  some.add("faults", "crash", 2);
  some.add("faults", "earthquake");
  all.add(some);
  all.add(some);
  EXPECT_EQ(all.count("faults", "crash"), 4u);
  EXPECT_EQ(all.sum("faults"), 6u);
  EXPECT_EQ(all.count("faults", "flood"), 0u);
  EXPECT_THAT(all.never(), Not(Contains("faults: crash")));
}

TEST(CampaignReport, IsReadBackAsItWasWritten) {
  CampaignReport report;
  report.seeds = {5, 20};
  report.done = 7;
  report.undecided = 1;
  report.operations = 300;
  report.steps = 9000;
  report.elapsed = std::chrono::duration<double>{1.5};
  report.happened.add("faults", "crash", 3);
  report.violations.push_back(
    {11, "something is wrong\nin two lines", 4, "crash a1 at 5ms\n", "castor simulate --seed 11"});
  auto again = from_json(to_json(report));
  EXPECT_EQ(to_json(again), to_json(report));
  EXPECT_EQ(again.seeds, report.seeds);
  EXPECT_EQ(again.happened, report.happened);
  EXPECT_FALSE(again.held());
  for (std::string text : {"", "{}", "[]", "17", "nonsense", R"({"format":2})"})
    EXPECT_THROW(from_json(text), std::invalid_argument) << text;
  auto json = to_json(report);
  json.replace(json.find("\"done\":7"), 8, "\"done\":99");
  EXPECT_THROW(from_json(json), std::invalid_argument);
}

TEST(CampaignReport, TellsOfViolationsAndHowToRepeatThem) {
  CampaignReport report;
  report.seeds = {1, 10};
  report.done = 10;
  EXPECT_THAT(to_text(report), HasSubstr("verdict: held\n"));
  report.violations.push_back({3, "something is wrong", 4, {}, "castor simulate --seed 3"});
  auto text = to_text(report);
  EXPECT_THAT(text, HasSubstr("something is wrong"));
  EXPECT_THAT(text, HasSubstr("Once more: castor simulate --seed 3\n"));
  EXPECT_THAT(text, HasSubstr("verdict: violated\n"));
}

TEST(Campaign, ThreadsMakeNoDifference) {
  auto one = run_campaign({}, options({1, 230}));
  EXPECT_TRUE(one.is_complete());
  EXPECT_EQ(one.done, 230u);
  EXPECT_EQ(comparable(one), comparable(run_campaign({}, options({1, 230}, 3))));
}

TEST(Campaign, GoesOnWhereItWasInterrupted) {
  auto whole = run_campaign({}, options({1, 400}));
  auto interrupted = options({1, 400}, 2);
  interrupted.interrupted = [] { return true; };
  auto part = run_campaign({}, interrupted);
  ASSERT_FALSE(part.is_complete());
  EXPECT_EQ(comparable(run_campaign(from_json(to_json(part)), options({1, 400}, 2))),
            comparable(whole));
}

TEST(Campaign, TellsOfItsProgress) {
  std::uint64_t last = 0;
  auto some = options({1, 400});
  some.progress = [&](const CampaignReport& x) {
    EXPECT_GE(x.done, last);
    last = x.done;
  };
  auto report = run_campaign({}, some);
  EXPECT_GT(last, 0u);
  EXPECT_LE(last, report.done);
}

} // namespace castor::simulation
