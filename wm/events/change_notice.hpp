#pragma once

#include "castor/wm/entries/change_event.hpp"

#include <cstdint>
#include <vector>

namespace castor {

/// To a receiver: an event, and which of its filters want it.
struct ChangeNotice {
  ChangeEventPtr event;
  std::vector<std::uint32_t> filters;
};

} // namespace castor
