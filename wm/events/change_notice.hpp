#pragma once

#include "castor/wm/entries/change_event.hpp"

#include <cstdint>
#include <vector>

namespace castor {

/// Number that a component gives to one of its filters.
using FilterId = std::uint32_t;

/// An event for a receiver, with the receiver's filters that match it.
struct ChangeNotice {
  ChangeEventPtr event;
  std::vector<FilterId> filters;
};

} // namespace castor
