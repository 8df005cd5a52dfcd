#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace castor::communication {

/// What the pronouns of a move, in any of its readings, stand for by what was said before, and
/// phrases with "other", which are about other things than those spoken of last. Nothing is found
/// before a move that was not understood, or a request of which it was not clear what it is about.
///
/// \param history referents of the moves before, in any order
Antecedents antecedents_in(const DialogueMove& move, std::span<const MoveReferents> history,
                           const Vocabulary& vocabulary);

/// What a move speaks of, by what is known of the scene: the answer to a question first. Counts
/// only if `scene` has no open questions afterwards.
std::vector<DiscourseReferent> referents_of(const DialogueMove& move,
                                            const Antecedents& antecedents, SceneKnowledge& scene);

/// Which one it is of several that a request left to whoever does it: of "take a cube", the cube
/// that is taken. What is said next can be about that one, and about "the other one".
///
/// \param things proxies of what was chosen
void note_chosen(MoveReferents& request, const std::vector<std::string>& things);

/// Proxies by which things are known now, by those that they had before they were moved.
using RenamedThings = std::map<std::string, std::string>;
void rename(MoveReferents& move, const RenamedThings& renamed);
void rename(Antecedents& antecedents, const RenamedThings& renamed);

/// For the entry of a move's referents, and back.
std::vector<PronounReferents> to_entry(const Antecedents& antecedents);
Antecedents from_entry(const std::vector<PronounReferents>& pronouns);

} // namespace castor::communication
