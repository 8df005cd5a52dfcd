#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

/// What somebody means who points at a place on the table and says "this" or "the cube here".
namespace castor::communication {

struct PointingLimits {
  /// Greatest distance from the place to the edge of what is meant; metres.
  double reach = 0.1;
  /// A gesture is stale after so many utterances in succession that do not take it up...
  std::size_t utterances = 3;
  /// ...and when it is older than this, if its time is known.
  Timestamp age = std::chrono::seconds{60};
};

/// Whether a gesture that is not held has been made too long ago.
/// \param use the gesture and its version
/// \param history the moves before, in any order
bool is_stale(const Pointing& pointing, const PointingUse& use,
              std::span<const MoveReferents> history, Timestamp now, const PointingLimits& limits);

/// Whether a phrase is about what is pointed at, if anything is: "this", "those two cubes", "the
/// one here".
bool is_shown(const LogicalForm& form, const Nominal& phrase, const Vocabulary& vocabulary);

/// What the phrases of a move, in any of its readings, mean that are about what is pointed at,
/// under `pointed_at`: the nearest thing of the kind that is spoken of, two if they are as near as
/// each other; for "these" and "here" all within reach, for "these two" the nearest two. Counts
/// only if `scene` has no open questions afterwards.
///
/// \param antecedents what other phrases stand for
/// \param reach greatest distance from the place to the edge of a thing, metres
Antecedents antecedents_by_pointing(const DialogueMove& move, const Place& place,
                                    const Antecedents& antecedents, SceneKnowledge& scene,
                                    double reach);

/// The place in "0.1,-0.2"; nothing for other texts.
std::optional<Place> place_of_text(std::string_view text);

} // namespace castor::communication
