#pragma once

#include "castor/communication/dialogue/response.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>

namespace castor::communication {

/// The reply to a question, an assertion, a request, or a greeting, by what is known of the scene;
/// of its readings the likeliest that makes sense is replied to. It counts only if `scene` has no
/// open questions afterwards; else ask binding and call it again. What cannot be answered is said
/// so: unknown, ambiguous, or not understood.
Response respond(const DialogueMove& move, const Antecedents& antecedents, SceneKnowledge& scene);

/// The move with one of its readings as its content, and no alternatives.
DialogueMove reading_of(DialogueMove move, std::size_t reading);

} // namespace castor::communication
