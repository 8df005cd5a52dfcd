#pragma once

#include "castor/communication/types.hpp"
#include "castor/planning/motivation/motive_templates.hpp"

#include <string>

namespace castor::planning {

/// What a request says, for templates: `text`, `speaker`, and of its parts `patient` and
/// `destination` their nouns, `patient-proxy` and `destination-proxy` the proxies in binding, where
/// it is certain which are meant, and `relation` where the destination is to its anchor.
MotiveValues values_of_request(const communication::DialogueMove& move,
                               const communication::MoveReferents& referents,
                               const std::string& speaker, const std::string& text);

} // namespace castor::planning
