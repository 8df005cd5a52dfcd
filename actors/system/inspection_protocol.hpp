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

/// What is said to inspections, and by them.
namespace castor {

/// To an inspection: what somebody has asked for, a JSON object.
struct InspectionRequest {
  std::string text;
};

/// From an inspection: lines of JSON, each ended by a line break.
struct InspectionReply {
  std::uint64_t connection = 0;
  std::string text;
  /// There is no more to come.
  bool last = false;
};

/// To an inspection: everything it has said was taken, so that there may be more.
struct InspectionTaken {};

/// To an inspection from itself: a time is over.
struct InspectionTimeout {
  std::function<void()> then;
};

struct InspectionParts {
  /// Named in every reply.
  std::uint64_t connection = 0;
  caf::actor endpoint;
  SystemRosterPtr roster;
  std::function<void(SystemOrder)> give_order;
  /// Where operations of operators are written down; null where they are not.
  std::shared_ptr<OperationLog> operations;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::InspectionRequest)
CASTOR_LOCAL_MESSAGE(castor::InspectionReply)
CASTOR_LOCAL_MESSAGE(castor::InspectionTaken)
CASTOR_LOCAL_MESSAGE(castor::InspectionTimeout)
