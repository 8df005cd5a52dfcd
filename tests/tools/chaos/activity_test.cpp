#include "castor/tools/chaos/activity.hpp"

#include <gtest/gtest.h>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;

TEST(ActivityMeter, CountsWhatWasDoneAfterTheFirstSample) {
  ActivityMeter meter;
  meter.take(10s, {{"a", 1, 100, 1000}, {"b", 1, 5, 5}});
  meter.take(11s, {{"a", 1, 110, 1050}, {"b", 1, 5, 5}});
  meter.take(12s, {{"a", 1, 120, 1100}, {"b", 1, 5, 6}});
  auto total = meter.total();
  EXPECT_EQ(total.duration, 2s);
  EXPECT_EQ(total.callbacks, 20U);
  EXPECT_EQ(total.operations, 101U);
  EXPECT_DOUBLE_EQ(total.rate(total.callbacks), 10);
  auto components = meter.by_component();
  EXPECT_DOUBLE_EQ(components["a"].callbacks, 10);
  EXPECT_DOUBLE_EQ(components["b"].operations, 0.5);
}

TEST(ActivityMeter, ALaterLifeBeginsAtZero) {
  ActivityMeter meter;
  meter.take(0s, {{"a", 1, 100, 0}});
  meter.take(1s, {{"a", 2, 3, 0}});
  meter.take(2s, {{"a", 2, 4, 0}});
  EXPECT_EQ(meter.total().callbacks, 4U);
}

TEST(ActivityMeter, WhatAComponentDoesAtItsStartIsNoSignThatSomethingGoesOn) {
  ActivityMeter meter;
  meter.take(0s, {{"a", 1, 0, 0}, {"b", 1, 0, 0}});
  meter.take(1s, {{"a", 1, 0, 9}, {"b", 1, 0, 0}});
  meter.take(2s, {{"a", 1, 0, 9}, {"b", 2, 0, 7}});
  meter.take(3s, {{"a", 1, 0, 9}, {"b", 2, 0, 9}});
  EXPECT_EQ(meter.total().moments, 3U);
  EXPECT_EQ(meter.total().busy_moments, 0U);
  meter.take(4s, {{"a", 1, 0, 10}, {"b", 2, 0, 9}});
  EXPECT_EQ(meter.total().busy_moments, 1U);
}

TEST(ActivityMeter, WithoutSamplesNothingWasMeasured) {
  EXPECT_EQ(ActivityMeter{}.total().moments, 0U);
  EXPECT_DOUBLE_EQ(ActivityMeter{}.total().rate(5), 0);
  EXPECT_TRUE(ActivityMeter{}.by_component().empty());
}

} // namespace

} // namespace castor::faults
