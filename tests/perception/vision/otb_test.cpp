// Real pictures, where there are any.

#include "castor/benchmarks/tracking/otb_sequence.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace castor::otb {

namespace {

TEST(BoxTrackerOnOtb, FollowsSomebodyAcrossTheStreet) {
  std::filesystem::path folder = CASTOR_OTB "/Crossing";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "there are no pictures at " << folder;
  auto score = run(load_sequence(folder));
  EXPECT_EQ(score.pictures, 119);
  EXPECT_GE(score.mean_overlap, 0.7);
  EXPECT_GE(score.success_rate, 0.95);
}

} // namespace

} // namespace castor::otb
