#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

namespace castor::communication {

/// What "this room" and "this" in "this is the kitchen" mean where the robot is in a room: what it
/// is in, under `pointed_at`, as if somebody pointed at it. Nothing for phrases that stand for what
/// is seen. Counts only if `scene` has no open questions afterwards.
Antecedents antecedents_by_presence(const DialogueMove& move, SceneKnowledge& scene);

/// A statement whose subject is shown, and that calls it by a name of its kind: "this is the
/// office" tells that it is an office.
DialogueMove with_names_told(DialogueMove move, const Vocabulary& vocabulary);

} // namespace castor::communication
