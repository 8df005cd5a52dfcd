#pragma once

#include "castor/communication/dialogue/sequels.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// A request with another for the case that it cannot be done, "put the ball behind the cube, or in
/// front of it if there is no room", or with the remark that it may be impossible, "if you can".
/// The alternative is what is said otherwise of its sequel. Nothing if the parts are not understood
/// by themselves.
std::optional<PackedLogicalForm> parsed_alternative(Parser& parser,
                                                    const std::vector<std::string>& words,
                                                    const PartParser& parse_part);

} // namespace castor::communication
