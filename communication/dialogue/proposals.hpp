#pragma once

#include "castor/communication/dialogue/response.hpp"
#include "castor/communication/types.hpp"

#include <string>
#include <vector>

/// Requests that the robot proposes to do, since it has not understood all that was said
/// (`PartialRequest`).
namespace castor::communication {

/// Asks whether it is to be done, or where something is to go.
///
/// \pre it is clear which things are meant
Response proposal(const PartialRequest& request, const LogicalForm& content);

/// "Shall I give you the ball and then swap the cubes?"
///
/// \param deeds what is to be done, one after the other, as infinitives
std::string proposal_of(const std::vector<std::string>& deeds);

/// Whether somebody agrees to what is proposed: "yes", "go ahead".
bool is_agreement(const DialogueMove& move);

/// Whether somebody says that what is possible is to be done: "yes", "do it", but not "ok".
bool says_to_go_ahead(const DialogueMove& move);

/// Whether somebody declines it: "no, thanks".
bool is_refusal(const DialogueMove& move);

/// The move as the refusal of a proposal, after which the robot asks what else to do.
DialogueMove as_refusal_of_proposal(DialogueMove move);

bool is_refusal_of_proposal(const LogicalForm& content);

} // namespace castor::communication
