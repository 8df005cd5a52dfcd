#include "castor/planning/manipulation/hidden_posture.hpp"

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/collision_checker.hpp"
#include "castor/planning/manipulation/kinematics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace castor::manipulation {

namespace {

// Configurations that are tried.
constexpr int candidates = 3000;

bool is_in_picture(const Point3& point, const geometry::Camera& camera) {
  const auto pixel = geometry::project(camera, point);
  return pixel && pixel->x > -0.5 && pixel->y > -0.5 && pixel->x < camera.width - 0.5 &&
         pixel->y < camera.height - 0.5;
}

/// Points of the solid, or of the cylinder around it: on it and within.
std::vector<Point3> points_of(const Solid& solid) {
  constexpr std::array shares{-1.0, -0.5, 0.0, 0.5, 1.0};
  constexpr int around = 12;
  const Point3 half{solid.size.x / 2, solid.size.y / 2, solid.size.z / 2};
  std::vector<Point3> result;
  for (const double z : shares)
    if (solid.kind == SolidKind::box)
      for (const double x : shares)
        for (const double y : shares)
          result.push_back({x * half.x, y * half.y, z * half.z});
    else
      for (int i = 0; i < around; ++i)
        for (const double share : {0.0, 0.5, 1.0}) {
          const double angle = 2 * std::numbers::pi * i / around;
          result.push_back(
            {share * half.x * std::cos(angle), share * half.x * std::sin(angle), z * half.z});
        }
  return result;
}

std::size_t count_in_sight(const Solid& solid, const Pose& pose, const geometry::Camera& camera) {
  const auto points = points_of(solid);
  return static_cast<std::size_t>(std::ranges::count_if(
    points, [&](const Point3& x) { return is_in_picture(geometry::transform(pose, x), camera); }));
}

} // namespace

std::size_t points_in_sight(const ArmModel& arm, std::span<const double> configuration,
                            const std::optional<NamedSolid>& held, const geometry::Camera& camera) {
  std::size_t result = 0;
  const auto links = link_poses(arm, configuration);
  for (std::size_t i = 1; i < links.size(); ++i)
    for (const auto& shape : arm.links[i].shapes)
      result += count_in_sight(shape.solid, geometry::compose(links[i], shape.pose), camera);
  const auto tool = tool_pose(arm, configuration);
  if (arm.gripper)
    for (const auto& finger : fingers(arm, arm.gripper->widest))
      result += count_in_sight(finger.solid, geometry::compose(tool, finger.pose), camera);
  if (held)
    result += count_in_sight(held->solid, geometry::compose(tool, held->pose), camera);
  return result;
}

std::vector<Configuration> hidden_postures(const ArmModel& arm, const Scene& scene,
                                           const Configuration& wanted,
                                           const geometry::Camera* camera, std::size_t most) {
  const auto moving = moving_joints(arm);
  const auto first = kept_within_limits(arm, wanted);
  std::mt19937 random(1);
  std::vector<Configuration> all;
  for (int i = 0; i < candidates; ++i) {
    auto& x = all.emplace_back();
    for (const auto index : moving)
      x.push_back(arm.joints[index].lower + (arm.joints[index].upper - arm.joints[index].lower) *
                                              std::uniform_real_distribution(0.0, 1.0)(random));
  }
  std::ranges::sort(all, {}, [&](const auto& x) { return distance(x, first); });
  all.insert(all.begin(), first);
  CollisionChecker checker(arm, scene);
  std::erase_if(all, [&](const auto& x) {
    return (camera != nullptr && points_in_sight(arm, x, scene.held, *camera) > most) ||
           !checker.is_free(x);
  });
  return all;
}

} // namespace castor::manipulation
