#pragma once

#include "castor/base/caf.hpp"
#include "castor/wm/clock/clock_messages.hpp"

namespace castor {

/// Message to the clock of the coordinator's process.
struct ClockReportFrom {
  ClockMember from = 0;
  ClockReport report;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::ClockAdvance)
CASTOR_LOCAL_MESSAGE(castor::ClockReportFrom)
