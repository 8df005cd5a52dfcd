#pragma once

#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/entry.hpp"

#include <chrono>
#include <string>

namespace castor::vision {

/// An update is news, and nothing to keep.
inline constexpr EntryLife update_life{.time_to_live = std::chrono::minutes{1}};

/// What to add beside the overwrite of the object `id`: what of it changes.
SceneObjectUpdate changes(const std::string& id, const SceneObject& before,
                          const SceneObject& after);

/// Whether anything at all changes that such an update tells of.
bool is_change(const SceneObjectUpdate& update);

} // namespace castor::vision
