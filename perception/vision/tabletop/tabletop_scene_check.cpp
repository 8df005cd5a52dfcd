#include "castor/perception/vision/tabletop/tabletop_scene_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_statement.hpp"

namespace castor::vision {

namespace {

/// How finely a move is looked at for collisions on the way.
constexpr int samples_per_move = 25;

double seconds(SceneTime time) {
  return static_cast<double>(time.count()) / 1e6;
}

bool moves_at(const TabletopActor& actor, SceneTime time) {
  return std::any_of(actor.moves.begin(), actor.moves.end(), [&](const TabletopMove& move) {
    return move.start < time && time < move.start + move.duration;
  });
}

std::vector<SceneTime> moments_of_moves(const TabletopScene& scene) {
  std::vector<SceneTime> times;
  for (const auto& actor : scene.actors)
    for (const auto& move : actor.moves)
      for (int i = 1; i < samples_per_move; ++i)
        times.push_back(move.start + move.duration * i / samples_per_move);
  return times;
}

bool may_overlap(const TabletopObject& a, const TabletopObject& b) {
  const double reach = std::hypot(a.size.x, a.size.y) + std::hypot(b.size.x, b.size.y);
  return std::hypot(a.x - b.x, a.y - b.y) < reach;
}

/// What is wrong between two objects, if anything: at rest is worse than on the way.
void check_pair(const TabletopScene& scene, std::size_t i, std::size_t j,
                const std::vector<SceneTime>& times, std::vector<SceneRemark>& remarks) {
  const auto& a = scene.actors[i];
  const auto& b = scene.actors[j];
  std::optional<SceneRemark> collision;
  for (const SceneTime time : times) {
    if (!a.is_there(time) || !b.is_there(time))
      continue;
    const auto object_a = a.at(time);
    const auto object_b = b.at(time);
    if (!may_overlap(object_a, object_b) || !overlap(object_a, object_b))
      continue;
    const auto name_a = description_of(object_a);
    const auto name_b = description_of(object_b);
    const bool a_moves = moves_at(a, time);
    if (!a_moves && !moves_at(b, time)) {
      remarks.push_back(
        {true, j, time,
         name_b + " overlaps " + name_a + ", " + readable(seconds(time)) + " s after the start",
         "Put them further apart, or make one of them smaller."});
      return;
    }
    if (!collision)
      collision =
        SceneRemark{false, a_moves ? i : j, time,
                    (a_moves ? name_a : name_b) + " moves through " + (a_moves ? name_b : name_a) +
                      ", about " + readable(seconds(time)) + " s after the start",
                    "Move it there in two steps, around the other one."};
  }
  if (collision)
    remarks.push_back(std::move(*collision));
}

void check_table(const TabletopScene& scene, std::size_t i, const std::vector<SceneTime>& times,
                 std::vector<SceneRemark>& remarks) {
  const auto& actor = scene.actors[i];
  const double half_width = scene.setting.table.width / 2;
  const double half_depth = scene.setting.table.depth / 2;
  const auto is_off = [&](const Point2& point) {
    return std::abs(point.x) > half_width || std::abs(point.y) > half_depth;
  };
  bool sticks_out = false;
  for (const SceneTime time : times) {
    if (!actor.is_there(time))
      continue;
    const auto object = actor.at(time);
    if (is_off({object.x, object.y})) {
      remarks.push_back({true, i, time, description_of(object) + " is not on the table",
                         "The table reaches from " + readable(-half_width) + " to " +
                           readable(half_width) + " in x and from " + readable(-half_depth) +
                           " to " + readable(half_depth) + " in y (metres)."});
      return;
    }
    const auto corners = footprint(object);
    if (!sticks_out && std::any_of(corners.begin(), corners.end(), is_off)) {
      sticks_out = true;
      remarks.push_back({false, i, time,
                         description_of(object) + " sticks out over the table's edge",
                         "Put it further to the middle, which is at 0 0."});
    }
  }
}

void check_sight(const TabletopScene& scene, std::size_t i, const std::vector<SceneTime>& times,
                 std::vector<SceneRemark>& remarks) {
  const auto& actor = scene.actors[i];
  for (const SceneTime time : times) {
    if (!actor.is_there(time) || moves_at(actor, time))
      continue;
    const auto object = actor.at(time);
    const auto pixel = project(scene.camera, pose_of(object).position);
    if (pixel && pixel->x > -0.5 && pixel->y > -0.5 && pixel->x < scene.camera.width - 0.5 &&
        pixel->y < scene.camera.height - 0.5)
      continue;
    remarks.push_back({false, i, time, "the camera does not see " + description_of(object),
                       "Put it where the camera looks, or let the camera look there."});
    return;
  }
}

} // namespace

std::string description_of(const TabletopObject& object) {
  if (!object.name.empty())
    return object.name;
  return "the " + object.colour_name + " " + std::string(to_string(object.shape));
}

std::vector<SceneRemark> check_scene(const TabletopScene& scene) {
  const auto changes = scene.change_times();
  auto moments = changes;
  const auto on_the_way = moments_of_moves(scene);
  moments.insert(moments.end(), on_the_way.begin(), on_the_way.end());
  std::vector<SceneRemark> remarks;
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    check_table(scene, i, changes, remarks);
    check_sight(scene, i, changes, remarks);
    for (std::size_t j = 0; j < i; ++j)
      check_pair(scene, j, i, moments, remarks);
  }
  return remarks;
}

} // namespace castor::vision
