#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <string>
#include <vector>

namespace castor::communication {

/// Reply to a dialogue move.
struct Response {
  RhetoricalRelation relation = RhetoricalRelation::narration;
  /// One sentence each.
  std::vector<LogicalForm> contents;
  /// Text to say instead of `contents`, if the lexicon has no words for it.
  std::string text;
  /// Nominal of a clarification question; empty if there is none.
  std::string asked_about;
};

/// The move with a clarified nominal, after the reply "the red one" to "which ball do you mean?".
///
/// \param move the unclear move; `nominal` was the object of the clarification question
DialogueMove clarified(DialogueMove move, const std::string& nominal, const LogicalForm& fragment);

/// The reply to a question, an assertion, a request, or a greeting, based on the knowledge of the
/// scene. Valid only if `scene` has no open questions afterwards; otherwise ask binding and call it
/// again. If there is no answer, the reply says why: unknown, ambiguous, or not understood.
Response respond(const DialogueMove& move, const Antecedents& antecedents, SceneKnowledge& scene);

} // namespace castor::communication
