#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <functional>
#include <vector>

namespace castor::communication {

/// Calls `f` for a request, or each of several in their order.
/// \param x root of the form
void for_each_action(const LogicalForm& form, const Nominal& x,
                     const std::function<void(const Nominal&)>& f);

/// Whether a request, or each of several, asks for what is done to things that are seen: the
/// lexicon has an action for its verb and lists it as `handling`.
bool is_handling(const LogicalForm& request, const WordMeanings& meanings);

/// Whether it is only asked whether something can be done: "can you reach the ball?"
bool asks_for_ability(const LogicalForm& form);

/// What is asked whether it is possible, as a request to do it.
LogicalForm as_request(LogicalForm form);

/// Whether an action is not to be done, or forbids one: "do not take it", "leave it alone".
bool forbids(const Nominal& action);

/// Whether it corrects the request before: "no, to the left of it".
bool is_correction(const LogicalForm& said);

/// Without the signs that it is one.
LogicalForm without_correction(LogicalForm form);

/// Whether it is to be done before what was asked for: "take the box away first".
bool is_to_be_first(const LogicalForm& request);

/// Whether a move asks for an action, or whether one is possible.
bool asks_to_act(const DialogueMove& move);

/// The steps that a move asks for, or asks whether they are possible (asks_for_ability); none if it
/// asks for something else, or it is not clear what for.
std::vector<DirectiveStep> steps_asked_for(const DialogueMove& move, const Antecedents& antecedents,
                                           SceneKnowledge& scene);

/// What a request asks to do with things, one step after the other: "take a ball and put it on the
/// box" has two. "It" and "them" are the things of the step before, where there is one.
///
/// \pre is_handling(request)
/// \throws Uninterpretable if it is not clear what is meant, nothing like it is there, or a step is
/// nothing that could be done
std::vector<DirectiveStep> steps_of(const LogicalForm& request, const Antecedents& antecedents,
                                    SceneKnowledge& scene);

} // namespace castor::communication
