#pragma once

#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/supervision/roster.hpp"
#include "castor/actors/system/system_order.hpp"
#include "castor/base/caf.hpp"

#include <caf/actor.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

/// Messages to and from inspections.
namespace castor {

class ClockControl;

/// To an inspection: a request, as a JSON object.
struct InspectionRequest {
  std::string text;
};

/// From an inspection: lines of JSON, each ended by a line break.
struct InspectionReply {
  std::uint64_t connection = 0;
  std::string text;
  /// Whether this is the last reply.
  bool last = false;
};

/// To an inspection: all its replies were taken, so it may send more.
struct InspectionTaken {};

/// To an inspection from itself: a timeout has passed.
struct InspectionTimeout {
  std::function<void()> then;
};

struct InspectionParts {
  /// Named in every reply.
  std::uint64_t connection = 0;
  caf::actor endpoint;
  SystemRosterPtr roster;
  std::function<void(SystemOrder)> give_order;
  /// Log of the operations of operators, or null.
  std::shared_ptr<OperationLog> operations;
  /// Null for the real clock.
  std::shared_ptr<ClockControl> clock;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::InspectionRequest)
CASTOR_LOCAL_MESSAGE(castor::InspectionReply)
CASTOR_LOCAL_MESSAGE(castor::InspectionTaken)
CASTOR_LOCAL_MESSAGE(castor::InspectionTimeout)
