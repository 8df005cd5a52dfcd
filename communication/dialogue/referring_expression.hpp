#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>

namespace castor::communication {

/// "A large red ball": all known properties of a thing.
LogicalForm indefinite_description(const SceneKnowledge& scene, const std::string& union_id);

/// The same of the thing that somebody has asked for: "the small red ball".
LogicalForm full_description(const SceneKnowledge& scene, const std::string& union_id);

/// "The ball", "the red ball", "the large red ball": as little of what is known of a thing as tells
/// it from all others, in this order (Dale and Reiter 1995). Indefinite, if that is not enough.
LogicalForm referring_expression(SceneKnowledge& scene, const std::string& union_id);

/// The same without what `besides` says; nothing if the rest does not tell it from all others.
std::optional<LogicalForm> definite_description(SceneKnowledge& scene, const std::string& union_id,
                                                binding::FeatureKind besides);

} // namespace castor::communication
