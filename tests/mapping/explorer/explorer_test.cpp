// configs/explorer.cast while its components fail, and at rest. In simulated time.

#include "castor/actors/system/system.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/map_components/types.hpp"
#include "castor/mapping/octree/types.hpp"
#include "castor/mapping/pictures/components/types.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace castor::mapping::test {

namespace {

using namespace std::chrono_literals;
using castor::test::TemporaryFolder;

class Explorer : public ::testing::Test {
protected:
  /// The robot drives from the corridor into a room and back, and stays there.
  TestSystemOptions options() const {
    const auto path = (folder_ / "short.path").string();
    save_text(path, "2.5 5.1\n7 5.1\n7 2.6\n7 5.1\n4 5.1\n");
    TestSystemOptions result;
    result.file = CASTOR_CONFIGS "/explorer.cast";
    result.simulated_time = true;
    result.patience = 300s;
    // All failures of a test happen within ten seconds of real time: more restarts than usual, or
    // the map is lost with its working memory.
    result.variables = {{"path", path},
                        {"after", "stay"},
                        {"state", (folder_ / "robot.state").string()},
                        {"restarts", "20"}};
    return result;
  }

  /// Occupied voxels of the octree whose middles are in the box, which is in the map's frame.
  static int occupied_voxels(TestSystem& system, const geometry::Point3& low,
                             const geometry::Point3& high) {
    int result = 0;
    for (auto& entry : system.system().entries("mapping")) {
      const auto block = entry->value.as<OctreeBlock>();
      if (!block)
        continue;
      const auto voxels = decode_tile(block->bytes);
      const auto middle = [&](std::int32_t of_block, std::size_t i) {
        return (16 * of_block + static_cast<double>(i) + 0.5) * block->voxel_size;
      };
      for (std::size_t i = 0; i < voxels.size(); ++i) {
        const double x = middle(block->x, i % 16);
        const double y = middle(block->y, i / 16 % 16);
        const double z = middle(block->z, i / 256);
        result += voxels[i] > 0 && x > low.x && x < high.x && y > low.y && y < high.y &&
                  z > low.z && z < high.z;
      }
    }
    return result;
  }

  static std::string cast() { return load_text(CASTOR_CONFIGS "/explorer.cast"); }

  /// Of all entries; of those that are written anew, the version.
  static std::map<std::string, Version> versions(TestSystem& system) {
    std::map<std::string, Version> result;
    for (const auto* where : {"navigation", "slam", "mapping"})
      for (auto& x : system.system().entries(where))
        result[to_string(x->address)] = x->version;
    return result;
  }

  /// How often entries were written in half a minute, by their addresses; those never written are
  /// left out.
  static std::map<std::string, Version> writes_at_rest(TestSystem& system) {
    const auto before = versions(system);
    EXPECT_GT(before.size(), 50U);
    system.advance(30s);
    std::map<std::string, Version> result;
    for (auto& [address, version] : versions(system)) {
      auto known = before.find(address);
      if (known == before.end() || known->second != version)
        result[address] = known == before.end() ? 1 : version - known->second;
    }
    return result;
  }

  /// Scans are noisy: now and then one says that the standing robot is a little aside. Without
  /// PoseNews there would be 300.
  static void expect_rest(TestSystem& system) {
    for (auto& [address, writes] : writes_at_rest(system)) {
      if (address == "mapping/map-picture") {
        EXPECT_LE(writes, 1U) << "the last metres of the way are drawn late, but only once";
        continue;
      }
      EXPECT_TRUE(address == "slam/robot-pose" || address == "slam/odometry-frame") << address;
      EXPECT_LE(writes, 5U) << address;
    }
  }

  static PathError error_of(TestSystem& system) {
    return *system.expect_entry("PathError in mapping")->value.as<PathError>();
  }

  TemporaryFolder folder_;
};

} // namespace

TEST_F(Explorer, PutsWhatItsDepthCameraSeesIntoTheOctree) {
  for (const bool camera : {false, true}) {
    auto with_camera = options();
    const auto path = with_camera.variables.at("path");
    // Before the desk of the first office, which stands on legs: the laser looks through below.
    save_text(path, "2.5 5.1\n2.5 3\n1.9 2.2\n");
    with_camera.variables["camera"] = camera ? "true" : "false";
    TestSystem system{cast(), with_camera};
    system.expect_entry("PathProgress in navigation where arrived == true");
    // OctreeBuilder's period.
    system.advance(10s);
    const int desk = occupied_voxels(system, {0.3, 0.3, 0.6}, {1.7, 0.9, 0.9});
    if (camera)
      EXPECT_GT(desk, 5);
    else
      EXPECT_EQ(desk, 0);
    EXPECT_GT(occupied_voxels(system, {-1, -1, 0}, {19, 16, 0.5}), 50);
    EXPECT_EQ(error_of(system).collisions, 0);
  }
}

TEST_F(Explorer, WritesHardlyAnythingWhileItStands) {
  TestSystem system{cast(), options()};
  system.expect_entry("PathProgress in navigation where arrived == true");
  // PathEvaluator's period.
  system.advance(15s);
  expect_rest(system);
  const auto picture = *system.expect_entry("MapPicture in mapping")->value.as<MapPicture>();
  EXPECT_NE(picture.content.find("grid"), std::string::npos) << picture.content;
  EXPECT_NE(picture.content.find("trajectory"), std::string::npos) << picture.content;
  EXPECT_EQ(picture.image.bytes.size(),
            std::size_t{3} * picture.image.width * picture.image.height);
  EXPECT_EQ(error_of(system).collisions, 0);
  system.expect_nobody_else_down();
}

TEST_F(Explorer, ArrivesAndComesToRestWhateverFailsOnTheWay) {
  TestSystem system{cast(), options()};
  auto fails_at = [&](const std::string& component, double done) {
    system.expect_entry("PathProgress in navigation where done > " + std::to_string(done));
    system.inject("crash " + component);
    system.expect_back(component);
  };
  fails_at("front-end", 1);
  fails_at("driver", 2);
  fails_at("grid", 3);
  fails_at("loops", 4);
  fails_at("robot", 6);
  fails_at("graph", 7);
  fails_at("octree", 8);
  fails_at("evaluator", 9);
  fails_at("exporter", 9);
  system.expect_entry("PathProgress in navigation where arrived == true");
  // A driver that is started while the robot stands at the end of its path has nothing to do; the
  // others find what is there.
  system.inject("crash driver");
  system.expect_back("driver", 3);
  system.inject("crash front-end");
  system.expect_back("front-end", 3);
  system.advance(15s);
  expect_rest(system);
  const auto error = error_of(system);
  // The evaluator has not seen where the robot was before it failed.
  EXPECT_GT(error.keyframes, 10);
  EXPECT_LT(error.most, 0.06);
  EXPECT_EQ(error.collisions, 0);
}

} // namespace castor::mapping::test
