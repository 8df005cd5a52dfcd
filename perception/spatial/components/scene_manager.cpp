#include "castor/actors/component/registry.hpp"
#include "castor/mapping/geometry/boxes.hpp"
#include "castor/perception/spatial/scene_relations.hpp"
#include "castor/perception/spatial/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor::spatial {

namespace {

using namespace std::chrono_literals;
using vision::SceneChanged;
using vision::SceneObject;

/// Keeps a location for each object that vision sees, and adds a scene of all of them when some
/// have moved.
class SceneManager final : public ManagedComponent {
  void start() override {
    on_change(changed<SceneObject>().in(vision_),
              [this](const ChangeEvent& event) { look(event.address); });
    // A scene is worth its while when vision has seen to all that has changed.
    on_change(
      overwritten<SceneChanged>().in(vision_).where(field(&SceneChanged::processed) == true),
      [this](const ChangeEvent&) { consider(); });
    for (auto& x : read_all<SpatialLocation>())
      locations_.insert_or_assign(x->object.address, x->box);
    try {
      for (auto& x : read_all_in<SceneObject>(vision_))
        look(x.address);
    } catch (const UnknownSubarchitectureException&) {
      info("there is no vision subarchitecture, so the scene has no objects");
    }
    // What is known of objects that went while nobody looked.
    for (auto& [object, box] : std::map{locations_})
      look(object);
    dirty_ = !locations_.empty();
    consider();
  }

  /// Only what has moved, or turned out to be of another height, makes a new scene.
  void look(const Address& address) {
    auto location = here(location_id(address));
    auto known = locations_.find(address);
    bool is_refined = false;
    try {
      auto object = read<SceneObject>(address);
      if (object->box == geometry::AlignedBox{})
        return; // nobody knows yet where it is
      is_refined = known != locations_.end() && geometry::is_refined(known->second, object->box);
      if (known != locations_.end() && !is_refined &&
          !geometry::has_moved(known->second, object->box))
        return;
      SpatialLocation now{{address}, object->box, {}};
      if (known == locations_.end()) {
        add(location, now);
      } else {
        read<SpatialLocation>(location);
        overwrite(location, now);
      }
      locations_[address] = object->box;
    } catch (const DoesNotExistOnWM&) {
      if (known == locations_.end())
        return;
      locations_.erase(known);
      delete_entry(location);
    }
    dirty_ = true;
    // Nothing has changed before the camera, so nobody says that this is seen to.
    if (is_refined)
      consider();
  }

  /// Several objects that move together make one scene.
  void consider() {
    if (!dirty_ || !task_.empty() || (locations_.empty() && last_scene_ == 0us))
      return;
    task_ = propose_task("update the scene", [this] {
      task_ = {};
      auto next = last_scene_ + std::chrono::duration_cast<Timestamp>(period_.get());
      if (last_scene_ > 0us && now() < next)
        sleep_for(next - now());
      add_scene();
    });
  }

  void add_scene() {
    dirty_ = false;
    last_scene_ = now();
    SpatialScene scene;
    scene.viewer = viewer();
    scene.time = last_scene_.count();
    for (auto& [object, box] : locations_)
      if (box.frame == scene.viewer.frame)
        scene.locations.push_back(location_id(object));
      else
        warning("{} is in the frame '{}', and the viewer in '{}': it is left out of the scene",
                location_id(object), box.frame, scene.viewer.frame);
    for (auto& x : read_all<RelationFinder>())
      scene.active_components.push_back(x->component);
    auto count = scene.locations.size();
    add(std::move(scene), {.time_to_live = memory_.get()});
    info("a scene of {} locations", count);
  }

  /// Where the camera is, looking at the middle of the table.
  geometry::Pose viewer() {
    geometry::Pose result;
    result.position = {viewer_x_, viewer_y_, viewer_z_};
    result.frame = frame_;
    if (!camera_->empty())
      try {
        return pull<vision::CameraFrame>(camera_)->camera.pose;
      } catch (const ConnectionError& e) {
        warning("{}", e.what());
      }
    return result;
  }

  static std::string location_id(const Address& object) { return "location of " + object.id; }

  Option<SubarchitectureName> vision_{this, "vision", "vision",
                                      "the subarchitecture with the SceneObjects"};
  Option<StandaloneName> camera_{this, "camera", "",
                                 "the camera that sees the objects; without one, the viewer "
                                 "is at --viewer-x, -y and -z"};
  Option<double> viewer_x_{this, "viewer-x", 0, "metres to the right of the table's middle"};
  Option<double> viewer_y_{this, "viewer-y", -1, "metres behind it"};
  Option<double> viewer_z_{this, "viewer-z", 0.5, "metres above it"};
  Option<std::string> frame_{this, "frame", geometry::table_frame,
                             "name of the frame of that position"};
  Option<std::chrono::milliseconds> period_{this, "period", 200ms,
                                            "least time from one scene to the next"};
  Option<std::chrono::milliseconds> memory_{this, "memory", 5min, "how long scenes are remembered"};

  std::map<Address, geometry::AlignedBox> locations_;
  /// There is something that the last scene does not show.
  bool dirty_ = false;
  Timestamp last_scene_{0};
  TaskId task_;
};

CASTOR_COMPONENT(SceneManager, "keeps locations of objects, and adds scenes when they move")

} // namespace

} // namespace castor::spatial
