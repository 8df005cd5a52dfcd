// People are followed by where they are detected, and keep their ids.

#include "castor/mapping/people/person_tracks.hpp"

#include "castor/tests/mapping/people/uniform_scan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace castor::mapping {

namespace {

constexpr std::int64_t scan_period = 100'000; // microseconds

/// Feeds scans until that time, seconds; each person is a function of time, and seen as a body.
class Scene {
public:
  /// @param range of all beams: who is not seen is hidden, if it is short
  explicit Scene(std::uint64_t seed, float range = 0.1F)
    : random_(seed), scan_(uniform_scan(360, range)) {}

  using Walk = std::function<Point2(double)>;

  void run(PersonTracks& tracks, const std::vector<Walk>& people, double until,
           const std::function<bool(std::size_t, double)>& is_seen = {}) {
    std::normal_distribution<double> noise{0, 0.03};
    for (; time_ <= until; time_ += 0.1) {
      std::vector<BodyPart> parts;
      for (std::size_t i = 0; i < people.size(); ++i) {
        const auto x = people[i](time_);
        if (!is_seen || is_seen(i, time_))
          parts.push_back({{x.x + noise(random_), x.y + noise(random_)}, 0.4, true, true});
      }
      tracks.add(parts, ScanView{scan_, {8, 8, 0}},
                 static_cast<std::int64_t>(std::round(time_ * 10)) * scan_period);
    }
  }

private:
  std::mt19937_64 random_;
  LaserScan scan_;
  double time_ = 0;
};

/// The id of the person nearest to the place; 0 if there is none within half a metre.
std::int64_t id_at(const PersonTracks& tracks, const Point2& place) {
  for (const auto& x : tracks.people())
    if (distance(x.place, place) < 0.5)
      return x.id;
  return 0;
}

Point2 from_left(double t) {
  return {-3 + 0.8 * t, 0};
}
Point2 from_right(double t) {
  return {3 - 0.8 * t, 0.1};
}

} // namespace

TEST(PersonTracks, WalkersAreKnownAsPeople) {
  PersonTracks tracks{{}, 5};
  Scene scene{1};
  scene.run(tracks, {from_left}, 3);
  ASSERT_EQ(tracks.people().size(), 1u);
  const auto x = tracks.people()[0];
  EXPECT_EQ(x.id, 5);
  EXPECT_NEAR(x.speed(), 0.8, 0.15);
  EXPECT_NEAR(x.heading, 0, 0.2);
  EXPECT_GT(x.visibility, 0.9);
  EXPECT_NEAR(distance(x.place, from_left(3)), 0, 0.1);
}

TEST(PersonTracks, ThingsAreNoPeople) {
  PersonTracks tracks{{}};
  Scene scene{1};
  scene.run(tracks, {[](double) { return Point2{2, 1}; }}, 60);
  EXPECT_TRUE(tracks.people().empty());
}

TEST(PersonTracks, SomebodyWhoStopsIsStillAPerson) {
  PersonTracks tracks{{}};
  Scene scene{1};
  scene.run(tracks, {[](double t) { return from_left(std::min(t, 3.0)); }}, 30);
  ASSERT_EQ(tracks.people().size(), 1u);
  EXPECT_LT(tracks.people()[0].speed(), 0.15);
  EXPECT_NEAR(tracks.people()[0].heading, 0, 0.5) << "that of the last step";
}

TEST(PersonTracks, GivesUpWhoIsGone) {
  PersonTracks tracks{{}};
  Scene scene{1};
  const auto leaves = [](std::size_t, double t) { return t < 3; };
  scene.run(tracks, {from_left}, 5.5, leaves);
  EXPECT_EQ(tracks.people().size(), 1u) << "still expected";
  EXPECT_LT(tracks.people()[0].visibility, 0.2);
  scene.run(tracks, {from_left}, 6.5, leaves);
  EXPECT_TRUE(tracks.people().empty());
}

TEST(PersonTracks, GivesUpAtOnceWhereBeamsPass) {
  PersonTracks tracks{{}};
  Scene scene{1, 0.F}; // nothing comes back
  scene.run(tracks, {from_left}, 5, [](std::size_t, double t) { return t < 3; });
  EXPECT_TRUE(tracks.people().empty());
}

TEST(PersonTracks, TwoLegsAreOnePerson) {
  PersonTracks tracks{{}};
  const auto scan = uniform_scan(360, 0.1F);
  for (int i = 0; i < 40; ++i) {
    const double t = i * 0.1;
    const auto at = from_left(t);
    const double swing = 0.22 * std::sin(2 * std::numbers::pi * t * 0.8 / 1.3);
    std::vector<BodyPart> legs{{{at.x + swing, at.y + 0.11}, 0.12, true, true},
                               {{at.x - swing, at.y - 0.11}, 0.12, true, true}};
    if (i % 5 == 4)
      legs.pop_back(); // hidden behind the other
    tracks.add(legs, ScanView{scan, {8, 8, 0}}, i * scan_period);
  }
  ASSERT_EQ(tracks.people().size(), 1u);
  EXPECT_NEAR(distance(tracks.people()[0].place, from_left(3.9)), 0, 0.15);
  EXPECT_NEAR(tracks.people()[0].speed(), 0.8, 0.2);
}

TEST(PersonTracks, WhatIsWhereThingsStoodIsNobodyNew) {
  PersonTracks tracks{{}};
  const auto scan = uniform_scan(360, 0.1F);
  for (int i = 0; i < 40; ++i) {
    const std::vector<BodyPart> parts{{from_left(i * 0.1), 0.4, false, true, true}};
    tracks.add(parts, ScanView{scan, {8, 8, 0}}, i * scan_period);
  }
  EXPECT_TRUE(tracks.people().empty());
}

RC_GTEST_PROP(PersonTracksProperties, KeepIdsThroughCrossings, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  // They cross at an angle from 50 to 180 degrees, and where they are close only one of them is
  // seen.
  const double angle = 0.9 + *rc::gen::inRange(0, 100) * 0.01 * (std::numbers::pi - 0.9);
  const Scene::Walk other = [angle](double t) {
    const double along = -3 + 0.8 * t;
    return Point2{along * std::cos(angle), along * std::sin(angle) + 0.1};
  };
  PersonTracks tracks{{}};
  Scene scene{seed};
  const auto is_seen = [&](std::size_t i, double t) {
    return i == 0 || distance(from_left(t), other(t)) > 0.4;
  };
  scene.run(tracks, {from_left, other}, 2.2, is_seen);
  const auto first = id_at(tracks, from_left(2.2));
  const auto second = id_at(tracks, other(2.2));
  RC_ASSERT(first != 0 && second != 0 && first != second);
  scene.run(tracks, {from_left, other}, 6.5, is_seen);
  RC_ASSERT(id_at(tracks, from_left(6.5)) == first);
  RC_ASSERT(id_at(tracks, other(6.5)) == second);
}

TEST(PersonTracks, KeepsIdsWherePeopleMeetHeadOn) {
  PersonTracks tracks{{}};
  Scene scene{3};
  scene.run(tracks, {from_left, from_right}, 2);
  const auto left = id_at(tracks, from_left(2));
  const auto right = id_at(tracks, from_right(2));
  scene.run(tracks, {from_left, from_right}, 6);
  EXPECT_EQ(id_at(tracks, from_left(6)), left);
  EXPECT_EQ(id_at(tracks, from_right(6)), right);
}

} // namespace castor::mapping
