#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <string>
#include <vector>

namespace castor::communication {

/// What is to be said in reply to a dialogue move.
struct Response {
  RhetoricalRelation relation = RhetoricalRelation::narration;
  /// One sentence each.
  std::vector<LogicalForm> contents;
  /// Instead of them, what the lexicon has no words for.
  std::string text;
  /// The nominal that is asked back about, if one is.
  std::string asked_about;
};

/// What was meant, once somebody has said "the red one" to "which ball do you mean?".
///
/// \param move what was not clear, of which `nominal` was asked back about
DialogueMove clarified(DialogueMove move, const std::string& nominal, const LogicalForm& fragment);

/// The reply to a question, an assertion, a request, or a greeting, by what is known of the scene.
/// It counts only if `scene` has no open questions afterwards; else ask binding and call it again.
/// What cannot be answered is said so: unknown, ambiguous, or not understood.
Response respond(const DialogueMove& move, const Antecedents& antecedents, SceneKnowledge& scene);

} // namespace castor::communication
