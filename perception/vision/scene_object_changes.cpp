#include "castor/perception/vision/scene_object_changes.hpp"

namespace castor::vision {

SceneObjectUpdate changes(const std::string& id, const SceneObject& before,
                          const SceneObject& after) {
  SceneObjectUpdate update;
  update.object_id = id;
  update.position = after.pose != before.pose || after.box != before.box;
  update.shape = after.shape != before.shape;
  update.size = after.size != before.size;
  update.colour = after.colour != before.colour;
  update.label = after.label != before.label;
  return update;
}

void place_at(const AlignedBox& box, SceneObject& object) {
  object.box = box;
  object.pose.position = box.centroid;
  object.pose.frame = box.frame;
}

bool is_change(const SceneObjectUpdate& update) {
  return update.position || update.shape || update.size || update.colour || update.label;
}

} // namespace castor::vision
