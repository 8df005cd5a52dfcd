#include "castor/perception/vision/tracking/box_tracker.hpp"

#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/segmentation/region_matching.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace castor::vision {

namespace {

using namespace std::chrono_literals;

/// A table that is looked at ten times a second.
struct Table {
  explicit Table(const std::string& things)
    : scene(parse_tabletop_scene("table cloth\nimage 320 240\n"
                                 "camera 0 -0.62 0.55 looking-at 0 0 0 fov 42\n" +
                                   things,
                                 "test")
              .scene) {}

  Image picture() {
    RenderOptions options;
    options.frame = frame;
    return render(scene.at(frame++ * 100ms), scene.camera, options);
  }

  /// What a segmentor sees, from the left to the right.
  std::vector<Region> regions() const {
    auto result = find_regions(render(scene.at(frame * 100ms), scene.camera), &scene.camera);
    std::sort(result.begin(), result.end(),
              [](auto& a, auto& b) { return a.roi.box.center.x < b.roi.box.center.x; });
    return result;
  }

  TabletopScene scene;
  std::uint64_t frame = 0;
};

void follow(BoxTracker& tracker, const std::string& name, const ROI& roi) {
  tracker.follow(name, roi.box, roi.region, roi.mask);
}

TEST(BoxTracker, FollowsSeveralThingsAtOnce) {
  Table table{"red cube at -0.15 0 size 0.07\nblue sphere at 0.12 0.05 size 0.07\n"
              "after 200ms move red cube to -0.15 0.2 over 1s\n"
              "after 200ms move blue sphere to 0.05 -0.15 over 1s\n"};
  auto regions = table.regions();
  ASSERT_EQ(regions.size(), 2u);
  BoxTracker tracker;
  follow(tracker, "cube", regions[0].roi);
  follow(tracker, "sphere", regions[1].roi);
  std::vector<Track> tracks;
  while (table.frame < 15)
    tracks = tracker.update(table.picture());
  ASSERT_EQ(tracks.size(), 2u);
  regions = table.regions();
  ASSERT_EQ(regions.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(tracks[i].name, i == 0 ? "cube" : "sphere");
    EXPECT_EQ(tracks[i].missing, 0);
    EXPECT_GE(overlap(tracks[i].box, regions[i].roi.box), 0.6) << tracks[i].name;
  }
}

TEST(BoxTracker, FindsWhatHasJumpedBetweenTwoPictures) {
  Table table{"red cube at -0.2 0.1 size 0.07\nblue cube at 0 0 size 0.07\n"
              "after 300ms move red cube to 0.2 -0.1\n"};
  auto regions = table.regions();
  ASSERT_EQ(regions.size(), 2u);
  BoxTracker tracker;
  follow(tracker, "red", regions[0].roi);
  while (table.frame < 5)
    ASSERT_EQ(tracker.update(table.picture()).at(0).missing, 0) << table.frame;
  regions = table.regions();
  ASSERT_EQ(regions[1].colour.value, "red");
  EXPECT_GE(overlap(tracker.update(table.picture()).at(0).box, regions[1].roi.box), 0.5);
}

TEST(BoxTracker, LosesWhatIsGoneAfterSomePictures) {
  Table table{"red cube at -0.1 0 size 0.07\nblue cube at 0.1 0 size 0.07\n"
              "after 300ms remove red cube\n"};
  auto regions = table.regions();
  TrackingOptions options;
  options.max_missing = 3;
  BoxTracker tracker{options};
  follow(tracker, "blue", regions.at(1).roi);
  follow(tracker, "red", regions.at(0).roi);
  std::vector<int> missing;
  std::vector<bool> lost;
  while (tracker.follows("red")) {
    auto track = tracker.update(table.picture()).at(1);
    EXPECT_EQ(track.name, "red");
    missing.push_back(track.missing);
    lost.push_back(track.is_lost);
  }
  EXPECT_EQ(missing, (std::vector<int>{0, 0, 0, 1, 2, 3}));
  EXPECT_EQ(lost, (std::vector<bool>{false, false, false, false, false, true}));
  EXPECT_EQ(tracker.update(table.picture()).size(), 1u);
}

TEST(BoxTracker, SeesAgainWhatWasHiddenForAWhile) {
  Table table{"red cube at -0.1 0 size 0.07\nblue cube at 0.1 0 size 0.07\n"
              "after 300ms remove red cube\n"
              "after 500ms add red cube at -0.1 0.1 size 0.07\n"};
  auto regions = table.regions();
  BoxTracker tracker;
  follow(tracker, "red", regions.at(0).roi);
  std::vector<int> missing;
  while (table.frame < 7)
    missing.push_back(tracker.update(table.picture()).at(0).missing);
  EXPECT_EQ(missing, (std::vector<int>{0, 0, 0, 1, 2, 0, 0}));
}

TEST(BoxTracker, LeavesBoxesWhereTheyAreWhileNothingMoves) {
  Table table{"noise 3\nred cube at -0.1 0 size 0.07\n"};
  auto roi = table.regions().at(0).roi;
  BoxTracker tracker;
  follow(tracker, "red", roi);
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(tracker.update(table.picture()).at(0).box, roi.box);
}

TEST(BoxTracker, ForgetsOnRequest) {
  Table table{"red cube at -0.1 0 size 0.07\n"};
  BoxTracker tracker;
  follow(tracker, "red", table.regions().at(0).roi);
  EXPECT_TRUE(tracker.follows("red"));
  tracker.forget("red");
  EXPECT_FALSE(tracker.follows("red"));
  EXPECT_TRUE(tracker.update(table.picture()).empty());
}

TEST(BoxTracker, RefusesAMaskThatDoesNotFit) {
  BoxTracker tracker;
  Image region{2, 1, 3, {1, 2, 3, 4, 5, 6}};
  EXPECT_THROW(tracker.follow("x", {}, region, {1, 1, 1, {255}}), std::invalid_argument);
  EXPECT_THROW(tracker.follow("x", {}, region, {2, 1, 1, {0, 0}}), std::invalid_argument);
  EXPECT_THROW(tracker.follow("x", {}, {}), std::invalid_argument);
  EXPECT_FALSE(tracker.follows("x"));
}

} // namespace

} // namespace castor::vision
