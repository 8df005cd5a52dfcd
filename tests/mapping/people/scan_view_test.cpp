// What a scan says of a place: hidden, passed, or filled.

#include "castor/mapping/people/scan_view.hpp"

#include "castor/tests/mapping/people/uniform_scan.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace castor::mapping {

TEST(ScanView, BeamsThatEndBeforeAPlaceHideIt) {
  const auto scan = uniform_scan(180, 2);
  const ScanView view{scan, {}};
  EXPECT_DOUBLE_EQ(view.towards({3, 0}, 0.2).hidden, 1);
  EXPECT_DOUBLE_EQ(view.towards({3, 0}, 0.2).passed, 0);
}

TEST(ScanView, BeamsThatEndBeyondAPlaceShowThatNobodyIsThere) {
  for (const float range : {5.F, 0.F}) {
    const auto scan = uniform_scan(180, range);
    const ScanView view{scan, {}};
    EXPECT_DOUBLE_EQ(view.towards({3, 0}, 0.2).hidden, 0) << range;
    EXPECT_DOUBLE_EQ(view.towards({3, 0}, 0.2).passed, 1) << range;
  }
}

TEST(ScanView, BeamsThatEndInAPlaceDoNeither) {
  const auto scan = uniform_scan(180, 3);
  const ScanView view{scan, {}};
  EXPECT_DOUBLE_EQ(view.towards({3, 0}, 0.2).hidden, 0);
  EXPECT_DOUBLE_EQ(view.towards({3, 0}, 0.2).passed, 0);
}

TEST(ScanView, WhatIsBehindTheScannerIsHidden) {
  const auto scan = uniform_scan(180, 5);
  const ScanView view{scan, {0, 0, std::numbers::pi}};
  EXPECT_DOUBLE_EQ(view.towards({3, 0}, 0.2).hidden, 1);
  EXPECT_DOUBLE_EQ(view.towards({-3, 0}, 0.2).passed, 1);
}

TEST(ScanView, HalfHiddenIsHalf) {
  auto scan = uniform_scan(180, 5);
  for (std::size_t i = 0; i < 90; ++i)
    scan.ranges[i] = 1;
  const ScanView view{scan, {}};
  EXPECT_NEAR(view.towards({3, 0}, 0.2).hidden, 0.5, 0.1);
  EXPECT_NEAR(view.towards({3, 0}, 0.2).passed, 0.5, 0.1);
}

} // namespace castor::mapping
