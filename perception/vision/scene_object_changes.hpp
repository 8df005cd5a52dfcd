#pragma once

#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/entry.hpp"

#include <chrono>
#include <string>

namespace castor::vision {

/// Updates are notifications and are deleted after a minute.
inline constexpr EntryLife update_life{.time_to_live = std::chrono::minutes{1}};

/// The update to add with the overwrite of the object `id`: its changes.
SceneObjectUpdate changes(const std::string& id, const SceneObject& before,
                          const SceneObject& after);

/// The object is there, as far as its box tells; how it is turned stays as it is.
void place_at(const AlignedBox& box, SceneObject& object);

/// Whether an update has any change.
bool is_change(const SceneObjectUpdate& update);

} // namespace castor::vision
