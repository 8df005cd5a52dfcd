#pragma once

#include "castor/wm/change_event.hpp"

#include <string>

namespace castor::cli {

/// One line of the timeline: time, subarchitecture, operation, type, id, component, version.
std::string timeline_line(const ChangeEvent& event, bool coloured);

/// What the columns are.
std::string timeline_head(bool coloured);

} // namespace castor::cli
