#pragma once

#include "castor/base/small_vector.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <cstdint>

namespace castor {

/// Number that a component gives to one of its filters.
using FilterId = std::uint32_t;

/// Numbers of the filters of one receiver that match an event, which seldom are many.
using FilterIds = SmallVector<FilterId, 2>;

/// An event for a receiver, with the receiver's filters that match it.
struct ChangeNotice {
  ChangeEventPtr event;
  FilterIds filters;
};

} // namespace castor
