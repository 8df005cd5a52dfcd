#pragma once

#include "castor/communication/types.hpp"
#include "castor/planning/motivation/motive_templates.hpp"

#include <string>

namespace castor::planning {

/// What a template's `on` names: the type of the action that a request asks for; `question` for a
/// question about what is not perceived; `statement` for one about a thing that is. Empty if it is
/// nothing of that.
std::string occasion_of(const communication::DialogueMove& move,
                        const communication::MoveReferents& referents);

/// What is said, for templates: `text`, `speaker`, and of a request's parts `patient` and
/// `destination` their nouns, `patient-proxy` and `destination-proxy` the proxies in binding, where
/// it is certain which are meant, and `relation` where the destination is to its anchor. The
/// patient of a question or a statement is what it is about.
MotiveValues values_of_request(const communication::DialogueMove& move,
                               const communication::MoveReferents& referents,
                               const std::string& speaker, const std::string& text);

} // namespace castor::planning
