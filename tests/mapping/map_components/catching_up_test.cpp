// Components that follow keyframes, when there are many of them at once.

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/mapping/map_components/follows_keyframes.hpp"
#include "castor/mapping/octree/types.hpp"
#include "castor/tests/mapping/grid/box_room.hpp"
#include "castor/tests/mapping/map_components/mapping_system.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>

namespace castor::mapping::test {

/// Call: how far a follower is.
struct AskProgress {
  bool now = true;
};
CASTOR_REFLECT(AskProgress, now)

struct FollowerProgress {
  /// Of this life: keyframes that it was told of, and ends of passes.
  std::int64_t told = 0;
  std::int64_t passes = 0;
};
CASTOR_REFLECT(FollowerProgress, told, passes)

/// Entry: what an asker has seen.
struct SeenProgress {
  /// Lives of the follower.
  std::int64_t lives = 1;
  /// Different answers in the midst of a pass of many keyframes, and after one.
  std::int64_t answers_between = 0;
  /// Keyframes that it was told of between two answers, at most.
  std::int64_t longest = 0;

  friend bool operator==(const SeenProgress&, const SeenProgress&) = default;
};
CASTOR_REFLECT(SeenProgress, lives, answers_between, longest)

/// Entry: answers on a wall since it was seen first, and those of them that do not know it.
struct SeenWall {
  std::int64_t answers = 0;
  std::int64_t unknown = 0;
};
CASTOR_REFLECT(SeenWall, answers, unknown)

/// Entry: corrects all poses.
struct CorrectAll {
  bool now = true;
};
CASTOR_REFLECT(CorrectAll, now)

namespace {

using namespace std::chrono_literals;

constexpr int keyframes = 200;

/// Adds many keyframes at once, and corrects them when an entry says so.
class CrowdFeeder final : public UnmanagedComponent {
  void start() override {
    on_change(added<CorrectAll>(), [this](const ChangeEvent&) {
      GraphPoses graph;
      graph.version = 1;
      for (int i = 0; i < keyframes; ++i)
        graph.poses.push_back(compose({0, 0, 1}, pose(i)));
      put(here("graph"), graph);
    });
    const BoxRoom room{-2, 3, -1.5, 2.5};
    for (int i = 0; i < keyframes; ++i) {
      Keyframe x;
      x.number = i;
      x.time = 100'000 * x.number;
      x.local_pose = pose(i);
      x.scan = room.scan(x.local_pose, 60);
      add(here("keyframe " + std::to_string(i)), x);
    }
  }

  static Pose2 pose(int i) { return {0.005 * i, 0, 0.01 * i}; }
};
CASTOR_COMPONENT(CrowdFeeder, "adds many keyframes")

/// Tells how far it is.
class AskedFollower final : public FollowsKeyframes<UnmanagedComponent> {
  void start() override {
    on_call<AskProgress>([this](const AskProgress&) { return progress_; });
    follow_keyframes();
  }

  void place(const EntryOf<Keyframe>&, const Pose2&) override { ++progress_.told; }
  void remove(const std::string&) override {}
  void placed() override { ++progress_.passes; }

  FollowerProgress progress_;
};
CASTOR_COMPONENT(AskedFollower, "counts keyframes")

/// Asks the follower again and again.
class ProgressAsker final : public UnmanagedComponent {
  void run() override {
    FollowerProgress last;
    SeenProgress seen;
    while (sleep_for(1ms)) {
      FollowerProgress x;
      try {
        x = call<AskProgress, FollowerProgress>(subarchitecture(), {});
      } catch (const CallException&) {
        continue;
      }
      auto now = seen;
      if (x.told < last.told) {
        ++now.lives;
        now.answers_between = now.longest = 0;
        last = {};
      }
      if (x.told > last.told && x.told % keyframes != 0)
        ++now.answers_between;
      now.longest = std::max(now.longest, x.told - last.told);
      last = x;
      if (now != seen)
        put(here("seen"), now);
      seen = now;
    }
  }
};
CASTOR_COMPONENT(ProgressAsker, "asks a follower how far it is")

/// Has all keyframes corrected after some time.
class CorrectionAsker final : public UnmanagedComponent {
  void run() override {
    sleep_for(after_.get());
    add(CorrectAll{});
  }

  Option<std::chrono::milliseconds> after_{this, "after", 1000ms, "when"};
};
CASTOR_COMPONENT(CorrectionAsker, "has all keyframes corrected")

/// Looks at one place of the octree again and again.
class WallAsker final : public UnmanagedComponent {
  void run() override {
    SeenWall seen;
    while (sleep_for(5ms)) {
      try {
        // The wall at the left, in front of which the robot began.
        const auto end = call<AskRay, RayEnd>(subarchitecture(), {.origin = {0, 0, 0.3},
                                                                  .direction = {-1, 0, 0},
                                                                  .max_range = 5,
                                                                  .stops_at_unknown = true});
        if (end.met == Occupancy::occupied)
          is_known_ = true;
        if (!is_known_)
          continue;
        ++seen.answers;
        seen.unknown += end.met != Occupancy::occupied;
      } catch (const CallException&) {
        continue;
      }
      put(here("wall"), seen);
    }
  }

  bool is_known_ = false;
};
CASTOR_COMPONENT(WallAsker, "asks the octree for a wall")

std::string cast_with_crowd(const std::string& components) {
  return cast_with("CPP UM feeder CrowdFeeder\n" + components);
}

/// By id of the entry.
std::map<std::string, Version> block_versions(TestSystem& system) {
  std::map<std::string, Version> result;
  for (auto& entry : system.system().entries("mapping"))
    if (entry->value.as<OctreeBlock>())
      result[entry->address.id] = entry->version;
  return result;
}

TEST(FollowsKeyframes, AnswersBetweenTheStepsOfARestart) {
  TestSystem system{cast_with_crowd("CPP UM follower AskedFollower --slice 0ms\n"
                                    "CPP UM asker ProgressAsker\n"),
                    {.simulated_time = true}};
  system.expect_entry("SeenProgress in mapping");
  system.inject("crash follower");
  system.expect_back("follower");
  // A step is one keyframe; in the time of an answer there are some steps.
  const auto seen =
    system.expect_entry("SeenProgress in mapping where lives == 2 && answers_between > 30")
      ->value.as<SeenProgress>();
  EXPECT_LT(seen->longest, 20);
  system.expect_nobody_else_down({"follower"});
}

TEST(FollowsKeyframes, AnswersBetweenTheStepsOfACorrection) {
  TestSystem system{cast_with_crowd("CPP UM follower AskedFollower --slice 0ms\n"
                                    "CPP UM asker ProgressAsker\n"
                                    "CPP UM corrector CorrectionAsker\n"),
                    {.simulated_time = true}};
  system.expect_entry("GraphPoses in mapping");
  const auto before = all<SeenProgress>(system).front().answers_between;
  system.wait_until("answers between the steps", [&] {
    return all<SeenProgress>(system).front().answers_between > before + 30;
  });
  system.expect_nobody_else_down({});
}

TEST(OctreeBuilder, AnswersByItsEntriesUntilItIsMadeAnewAfterACrash) {
  TestSystem system{cast_with_crowd("CPP UM octree OctreeBuilder --slice 0ms\n"
                                    "CPP UM asker WallAsker\n"),
                    {.simulated_time = true}};
  system.expect_entry("SeenWall in mapping where answers > 100");
  const auto before = block_versions(system);
  EXPECT_GT(before.size(), 4U);
  system.inject("crash octree");
  system.expect_back("octree");
  // 200 keyframes are taken up in 0.2 s, and put into the new octree in 1 s.
  system.advance(3s);
  const auto answers = all<SeenWall>(system).front().answers;
  system.expect_entry("SeenWall in mapping where answers > " + std::to_string(answers));
  EXPECT_EQ(all<SeenWall>(system).front().unknown, 0);
  EXPECT_GT(answers, 400);
  // Nothing differs, so nothing was written.
  EXPECT_EQ(block_versions(system), before);
}

} // namespace

} // namespace castor::mapping::test
