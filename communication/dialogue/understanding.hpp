#pragma once

#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <functional>
#include <string>
#include <vector>

namespace castor::communication {

/// The packed logical form of an utterance as a whole: as it stands, with its spelling corrected,
/// in other words that say the same (`reparsed`), or of what is understood in it
/// (`partly_understood`); what was taken for something else is among its corrections. Without
/// readings if nothing is understood.
///
/// \param said in the form returned by words_of()
/// \param heard called with what has been understood so far, after each word
PackedLogicalForm understood(Parser& parser, const std::vector<std::string>& said,
                             const std::function<void(const PackedLogicalForm&)>& heard = {});

} // namespace castor::communication
