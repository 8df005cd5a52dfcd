#include "castor/tools/chaos/resource_growth.hpp"

#include "castor/tools/chaos/seeded_random.hpp"

#include <gmock/gmock.h>

#include <functional>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// One sample each second, as `f` has it at that second.
ProcessResources process(int seconds, const std::function<ResourceSample(std::uint64_t)>& f) {
  ProcessResources result{"node1", {}};
  for (int i = 0; i <= seconds; ++i) {
    result.samples.push_back(f(static_cast<std::uint64_t>(i)));
    result.samples.back().at = Timestamp{1s} * i;
  }
  return result;
}

ResourceSample sample(std::uint64_t megabytes, std::uint64_t files = 20,
                      std::uint64_t threads = 8) {
  return {{}, megabytes * 1'000'000, files, threads};
}

TEST(RobustSlope, IsThatOfTheMany) {
  std::vector<double> x{0, 1, 2, 3, 4, 5, 6};
  std::vector<double> y{1, 3, 5, 700, 9, 11, 13};
  EXPECT_DOUBLE_EQ(robust_slope(x, y), 2);
  EXPECT_DOUBLE_EQ(robust_slope({}, {}), 0);
  std::vector<double> one{1};
  EXPECT_DOUBLE_EQ(robust_slope(one, one), 0);
}

TEST(Leaks, SteadyGrowthIsOne) {
  EXPECT_THAT(
    leaks(process(60, [](auto t) { return sample(50 + t); })),
    ElementsAre(AllOf(HasSubstr("node1: 55 MB more memory in 55 s"), HasSubstr("from 55 to 110"))));
  EXPECT_THAT(leaks(process(60, [](auto t) { return sample(50, 20 + t / 5); })),
              ElementsAre(HasSubstr("more file descriptors")));
  EXPECT_THAT(leaks(process(60, [](auto t) { return sample(50, 20, 8 + t / 5); })),
              ElementsAre(HasSubstr("more threads")));
  EXPECT_THAT(leaks(process(3600, [](auto t) { return sample(50 + t / 60); })),
              ElementsAre(HasSubstr("memory")));
}

TEST(Leaks, WhatGoesUpAndDownIsNone) {
  SeededRandom random{1};
  EXPECT_THAT(leaks(process(300,
                            [&](auto) {
                              return sample(50 + random.below(60), 20 + random.below(30),
                                            8 + random.below(9));
                            })),
              IsEmpty());
  EXPECT_THAT(leaks(process(60, [](auto t) { return sample(t % 10 == 0 ? 400 : 50); })), IsEmpty());
}

TEST(Leaks, FillingUpInTheBeginningIsNone) {
  EXPECT_THAT(leaks(process(60, [](auto t) { return sample(t < 5 ? 10 * t : 50); })), IsEmpty());
  EXPECT_THAT(leaks(process(60, [](auto t) { return sample(t < 15 ? 10 * t : 150); })), IsEmpty());
}

TEST(Leaks, ShortSeriesSayNothing) {
  EXPECT_THAT(leaks({"node1", {}}), IsEmpty());
  EXPECT_THAT(leaks(process(12, [](auto t) { return sample(50 + 50 * t); })), IsEmpty());
}

TEST(Leaks, LargeProcessesMayGrowMore) {
  EXPECT_THAT(leaks(process(60, [](auto t) { return sample(1000 + 2 * t); })), IsEmpty());
  EXPECT_THAT(leaks(process(60, [](auto t) { return sample(100 + 2 * t); })),
              ElementsAre(HasSubstr("memory")));
}

} // namespace

} // namespace castor::faults
