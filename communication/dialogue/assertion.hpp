#pragma once

#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <vector>

namespace castor::communication {

/// Whether an assertion agrees with what is perceived. `Truth::unknown` is what can be learned from
/// it; what is said of something that is shown ("this is a ball") is unknown where it is not clear
/// what is meant.
///
/// \param root of the form, which the evaluation is of, too
/// \throws Uninterpretable
Truth judge_assertion(const Nominal& root, const LogicalForm& form, Evaluation& evaluation);

/// Of what binding is told what is asserted.
enum class Telling {
  /// Of nothing: "most balls are toys".
  nothing,
  /// Of the thing that it is about: "the ball is a toy", "there is a toy".
  of_one,
  /// Of each of the things that it is about: "all balls are toys", "the ball is a toy and the cube
  /// is a gift".
  of_each,
};

Telling telling_of(const Nominal& root, const LogicalForm& form);

/// What binding is told.
struct Told {
  Telling telling = Telling::nothing;
  /// Features of each of the proxies; those of what is meant refer to a proxy of it.
  std::vector<std::vector<binding::Feature>> proxies;
};

/// What an assertion tells binding: nothing if what is seen contradicts it, if it is not clear what
/// it is about, if it is a name of which somebody else takes note (`name_told`), or if there is
/// nothing that it says of one thing.
///
/// \param referents of the move
/// \pre asked again, as long as `scene` has open questions
Told told_by(const DialogueMove& move, const MoveReferents& referents, SceneKnowledge& scene);

} // namespace castor::communication
