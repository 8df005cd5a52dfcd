#include "castor/mapping/localisation/localisation_monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::mapping {

namespace {

using testing::HasSubstr;

class Monitor : public ::testing::Test {
protected:
  /// One scan after 0.1 s.
  LocalisationVerdict see(double explained, double weight = 1, double spread = 0.05,
                          double moved = 0.05, bool is_update = true) {
    time_ += 100000;
    LocalisationEvidence x;
    x.time = time_;
    x.clusters = weight < 1 ? 2 : 1;
    x.weight = weight;
    x.spread = spread;
    x.explained = explained;
    x.rivals = rivals_;
    x.many_rivals = many_rivals_;
    x.moved = moved;
    x.is_update = is_update;
    return monitor_.add(x);
  }

  LocalisationVerdict see_often(int times, double explained, double moved = 0.05) {
    LocalisationVerdict result;
    for (int i = 0; i < times; ++i)
      result = see(explained, 1, 0.05, moved);
    return result;
  }

  void find() { ASSERT_EQ(see_often(22, 0.95).state, LocalisationState::tracking); }

  LocalisationMonitor monitor_;
  std::size_t rivals_ = 0;
  bool many_rivals_ = false;
  std::int64_t time_ = 0;
};

TEST_F(Monitor, FindsARobotAfterSomeWay) {
  EXPECT_EQ(see(0.87).state, LocalisationState::starting);
  EXPECT_EQ(see_often(5, 0.87).state, LocalisationState::starting);
  auto found = see(0.87, 1, 0.05, 0.8);
  EXPECT_EQ(found.state, LocalisationState::tracking);
  EXPECT_THAT(found.reason, HasSubstr("found after 0.6 s"));
}

TEST_F(Monitor, OfARobotThatStandsMoreHasToFit) {
  EXPECT_EQ(see_often(20, 0.85, 0).state, LocalisationState::starting);
  EXPECT_EQ(see_often(1, 0.95, 0).state, LocalisationState::tracking);
}

TEST_F(Monitor, SeveralPlacesAreNotEnough) {
  for (int i = 0; i < 50; ++i) {
    auto x = see(0.95, 0.6);
    ASSERT_EQ(x.state, LocalisationState::starting);
    ASSERT_THAT(x.reason, HasSubstr("2 places"));
  }
  EXPECT_EQ(see(0.95).state, LocalisationState::tracking);
}

TEST_F(Monitor, APlaceThatOthersLookLikeIsNotEnough) {
  rivals_ = 2;
  for (int i = 0; i < 50; ++i) {
    auto x = see(1);
    ASSERT_EQ(x.state, LocalisationState::starting);
    ASSERT_EQ(x.reason, "3 places look alike");
    ASSERT_FALSE(x.searches_anew);
  }
  rivals_ = 0;
  many_rivals_ = true;
  EXPECT_EQ(see(1).reason, "too many places look alike");
  many_rivals_ = false;
  EXPECT_EQ(see(1).state, LocalisationState::tracking);
}

TEST_F(Monitor, OtherPlacesDoNotCountOnceTheRobotIsFound) {
  find();
  rivals_ = 2;
  EXPECT_EQ(see(0.95).state, LocalisationState::tracking);
}

TEST_F(Monitor, AWidePlaceIsNotEnough) {
  for (int i = 0; i < 50; ++i)
    ASSERT_EQ(see(0.95, 1, 0.5).state, LocalisationState::starting);
}

TEST_F(Monitor, SearchesAnewIfTheOnlyPlaceLeftDoesNotFit) {
  int searches = 0;
  for (int i = 0; i < 30; ++i) {
    auto x = see(0.3);
    EXPECT_EQ(x.state, LocalisationState::starting);
    searches += x.searches_anew ? 1 : 0;
  }
  EXPECT_EQ(searches, 2);
}

TEST_F(Monitor, ScansThatDoNotFitForAWhileAreDeadReckoning) {
  find();
  auto off = see_often(5, 0.2);
  EXPECT_EQ(off.state, LocalisationState::dead_reckoning);
  EXPECT_THAT(off.reason, HasSubstr("20 %"));
  EXPECT_EQ(see(0.9).state, LocalisationState::tracking);
}

TEST_F(Monitor, AKidnappedRobotIsLostAndFoundAgain) {
  find();
  EXPECT_EQ(see_often(9, 0.2, 0).state, LocalisationState::dead_reckoning);
  auto lost = see(0.2, 1, 0.05, 0);
  EXPECT_EQ(lost.state, LocalisationState::lost);
  EXPECT_TRUE(lost.searches_anew);
  EXPECT_THAT(lost.reason, HasSubstr("lost"));
  auto searching = see(0.5, 0.3);
  EXPECT_EQ(searching.state, LocalisationState::lost);
  EXPECT_THAT(searching.reason, HasSubstr("2 places"));
  EXPECT_FALSE(searching.searches_anew);
  auto found = see(0.9, 1, 0.05, 1);
  EXPECT_EQ(found.state, LocalisationState::tracking);
  EXPECT_THAT(found.reason, HasSubstr("found again after 0.2 s"));
}

TEST_F(Monitor, DoesNotTrackWhileThereAreSeveralPlaces) {
  find();
  EXPECT_EQ(see(0.9, 0.5).state, LocalisationState::dead_reckoning);
  EXPECT_EQ(see(0.9, 1, 0.9).state, LocalisationState::dead_reckoning);
  EXPECT_EQ(see(0.9).state, LocalisationState::tracking);
}

} // namespace

} // namespace castor::mapping
