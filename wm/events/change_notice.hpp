#pragma once

#include "castor/wm/entries/change_event.hpp"

#include <cstdint>
#include <vector>

namespace castor {

/// A component's name for one of its filters.
using FilterId = std::uint32_t;

/// To a receiver: an event, and which of its filters want it.
struct ChangeNotice {
  ChangeEventPtr event;
  std::vector<FilterId> filters;
};

} // namespace castor
