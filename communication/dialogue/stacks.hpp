#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <string>
#include <vector>

namespace castor::communication {

bool is_tower(const Nominal& phrase);

/// "The tower": what stands in the only stack on the table, from the bottom; nothing if there is
/// none, or if there are several.
std::vector<std::string> only_stack(SceneKnowledge& scene);

/// Without the things that something stands on which is not among them: "the others" of a thing on
/// a stack are not what carries it. All of them if none is left.
std::vector<std::string> without_carriers(SceneKnowledge& scene, std::vector<std::string> things);

} // namespace castor::communication
