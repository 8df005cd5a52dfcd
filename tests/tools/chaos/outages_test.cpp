#include "castor/tools/chaos/outages.hpp"

#include "castor/tools/chaos/recovery_times.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;
using Kind = LifeNote::Kind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Outage> outages_from(std::vector<LifeNote> notes) {
  return outages_of(notes,
                    [](auto& name) { return name == "slow" ? Timestamp{5s} : Timestamp{1s}; });
}

TEST(Outages, AreWhatTheNotesComeTo) {
  auto x = outages_from({{1s, "a", Kind::up, ""},
                         {2s, "a", Kind::down, "crash"},
                         {3s, "slow", Kind::down, "killed"},
                         {4s, "a", Kind::up, ""},
                         {5s, "a", Kind::first_callback, ""},
                         {6s, "a", Kind::first_callback, ""},
                         {7s, "a", Kind::down, "again"},
                         {8s, "slow", Kind::escalated, ""}});
  ASSERT_EQ(x.size(), 3U);
  EXPECT_EQ(x[0].target, "a");
  EXPECT_EQ(x[0].reason, "crash");
  EXPECT_EQ(x[0].recovery(), 3s);
  EXPECT_EQ(x[0].bound, 1s);
  EXPECT_EQ(x[1].bound, 5s);
  EXPECT_EQ(x[1].recovery(), std::nullopt);
  EXPECT_EQ(x[1].escalated, 8s);
  EXPECT_EQ(x[2].down, 7s);
  EXPECT_EQ(x[2].up, std::nullopt);
}

TEST(Outages, WhoGoesDownTwiceWasDownAllTheTime) {
  auto x = outages_from(
    {{1s, "a", Kind::down, "first"}, {2s, "a", Kind::down, "second"}, {3s, "a", Kind::up, ""}});
  ASSERT_EQ(x.size(), 1U);
  EXPECT_EQ(x[0].recovery(), 2s);
  EXPECT_EQ(x[0].reason, "first");
}

TEST(Outages, WhoIsBackOrGivenUpInTimeIsNotLate) {
  auto x = outages_from({{1s, "a", Kind::down, ""},
                         {2s, "a", Kind::up, ""},
                         {3s, "b", Kind::down, ""},
                         {3500ms, "b", Kind::escalated, ""},
                         {9s, "b", Kind::up, ""},
                         {99500ms, "c", Kind::down, ""}});
  EXPECT_THAT(late_recoveries(x, 100s), IsEmpty());
}

TEST(Outages, WhoIsNotIsLate) {
  auto x = outages_from({{1s, "a", Kind::down, "crash"},
                         {2100ms, "a", Kind::up, ""},
                         {3s, "b", Kind::down, "crash"},
                         {5s, "b", Kind::escalated, ""},
                         {5s, "c", Kind::down, "crash"}});
  EXPECT_THAT(late_recoveries(x, 100s),
              ElementsAre(HasSubstr("a, down at 1 s (crash), was back only after 1.1 s"),
                          HasSubstr("b, down at 3 s (crash), was given up only after 2 s"),
                          HasSubstr("c, down at 5 s (crash), was neither back nor given up")));
}

TEST(RecoveryTimes, PercentilesAreNearestRanks) {
  std::vector<Timestamp> times;
  EXPECT_EQ(percentile(times, 50), std::nullopt);
  for (int i = 1; i <= 10; ++i)
    times.emplace_back(i);
  EXPECT_EQ(percentile(times, 0), Timestamp{1});
  EXPECT_EQ(percentile(times, 50), Timestamp{5});
  EXPECT_EQ(percentile(times, 51), Timestamp{6});
  EXPECT_EQ(percentile(times, 99), Timestamp{10});
  EXPECT_EQ(percentile(times, 100), Timestamp{10});
}

TEST(RecoveryTimes, BinsAreRound) {
  std::vector<Timestamp> times{3ms, 4ms, 120ms, 390ms};
  auto bins = histogram(times, 10);
  ASSERT_EQ(bins.size(), 8U);
  EXPECT_EQ(bins[0], (HistogramBin{0ms, 50ms, 2}));
  EXPECT_EQ(bins[2], (HistogramBin{100ms, 150ms, 1}));
  EXPECT_EQ(bins[7], (HistogramBin{350ms, 400ms, 1}));
  EXPECT_THAT(histogram({}, 10), IsEmpty());
  std::vector<Timestamp> nothing{0ms};
  EXPECT_THAT(histogram(nothing, 10), ElementsAre(HistogramBin{0us, 1us, 1}));
}

RC_GTEST_PROP(RecoveryTimes, EveryTimeIsInItsBin, ()) {
  auto counts = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::int64_t>>(
    rc::gen::inRange<std::int64_t>(0, *rc::gen::element<std::int64_t>(3, 1000, 100'000'000))));
  std::ranges::sort(counts);
  std::vector<Timestamp> times;
  for (auto x : counts)
    times.emplace_back(x);
  auto most = *rc::gen::inRange<std::size_t>(1, 40);
  auto bins = histogram(times, most);
  RC_ASSERT(bins.size() <= most);
  RC_ASSERT(bins.front().from == 0us);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (i > 0)
      RC_ASSERT(bins[i].from == bins[i - 1].to);
    RC_ASSERT(bins[i].count == std::size_t(std::ranges::count_if(times, [&](auto t) {
                return t >= bins[i].from && t < bins[i].to;
              })));
  }
  RC_ASSERT(times.back() < bins.back().to);
}

} // namespace

} // namespace castor::faults
