#pragma once

#include "castor/communication/parsing/word_meanings.hpp"
#include "castor/communication/types.hpp"

#include <string>
#include <string_view>

namespace castor::communication {

/// Whether a request has no verb, so that it may be meant otherwise: "the ball on the left".
bool is_verbless(const LogicalForm& form);

/// The feature of the root of a phrase that is said as a question: "a ball?"
inline constexpr std::string_view said_as_question = "As-Question";

/// The dialogue move of a logical form, by its mood and kind: "can you see the ball" is a question,
/// even if meant as a request. `none` for fragments such as "the red ball".
DialogueMoveType dialogue_move_type(const LogicalForm& form);

/// Gives a move the readings of an utterance that is understood, the likeliest as its content.
void take_readings(const PackedLogicalForm& form, DialogueMove& move);

/// Whether it is not a phrase: somebody does something or something is so.
bool is_clause(const LogicalForm& form, const Nominal& x);

/// Takes an utterance for a request if it can be read so and the lexicon has an action for its
/// verb, and gives the move that action. "Find the ball" asks where the ball is only where nobody
/// finds things, "give me the ball" asks what there is only where nobody gives; "can you take the
/// ball?" asks to take it where somebody takes things.
void take_requests(DialogueMove& move, const WordMeanings& meanings);

/// "I take 'squre' for 'square'. I leave out 'my notes say'.", if words of the utterance were taken
/// for others or left out, and what is not understood beside a request; else empty.
std::string said_back(const DialogueMove& move);

/// What to say of an utterance that is not understood, for people to read; of a request with a verb
/// that is not known, what the robot can do instead.
std::string problem_of(const PackedLogicalForm& form, const WordMeanings& meanings);

/// Type name of the action that a request's verb asks for; empty if no action does what it says.
std::string action_asked_for(const LogicalForm& request, const WordMeanings& meanings);

} // namespace castor::communication
