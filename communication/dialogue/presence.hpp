#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>

namespace castor::communication {

/// What "this room" and "this" in "this is the kitchen" mean where the robot is in a room: what it
/// is in, under `pointed_at`, as if somebody pointed at it. Nothing for phrases that stand for what
/// is seen. Counts only if `scene` has no open questions afterwards.
Antecedents antecedents_by_presence(const DialogueMove& move, SceneKnowledge& scene);

/// A statement whose subject is shown, and that calls it by a name of its kind: "this is the
/// office" and "we are in the office" tell that it is an office.
DialogueMove with_names_told(DialogueMove move, const Vocabulary& vocabulary);

/// A name for what is shown, and the subarchitecture that takes note of it.
struct NameTold {
  std::string subarchitecture;
  /// A concept.
  std::string name;

  friend bool operator==(const NameTold&, const NameTold&) = default;
};

/// The name that a reading of a statement `with_names_told` gives to what is shown, by nothing but
/// a noun: "this is the office", not "this is the red office", nor what is denied. Nothing if
/// nobody takes note of such names. Counts only if `scene` has no open questions afterwards.
std::optional<NameTold> name_told(const LogicalForm& statement, SceneKnowledge& scene);

} // namespace castor::communication
