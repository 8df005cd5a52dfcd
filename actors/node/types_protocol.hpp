#pragma once

#include "castor/actors/link/wire.hpp"
#include "castor/base/caf.hpp"
#include "castor/wm/values/type_descriptor.hpp"

#include <vector>

/// How an inspection asks the agents of processes for the entry types that these know.
namespace castor {

struct TypesQuery {};

struct TypesReport {
  std::vector<TypeDescriptorPtr> types;
};

CASTOR_WIRE(TypesQuery)
CASTOR_WIRE(TypesReport, types)

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::TypesQuery)
CASTOR_LOCAL_MESSAGE(castor::TypesReport)
