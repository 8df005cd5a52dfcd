#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <string>

namespace castor::communication {

/// "A large red ball": all known properties of a thing.
LogicalForm indefinite_description(const SceneKnowledge& scene, const std::string& union_id);

/// "The ball", "the red ball", "the large red ball": the fewest known properties of a thing, added
/// in this order, that distinguish it from all others (Dale and Reiter 1995). Indefinite if they do
/// not.
LogicalForm referring_expression(const SceneKnowledge& scene, const std::string& union_id);

} // namespace castor::communication
