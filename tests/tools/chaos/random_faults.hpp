#pragma once

#include "castor/tools/chaos/fault_plan.hpp"

#include <rapidcheck.h>

#include <iosfwd>

/// Plans of any kind, with names of any kind.
namespace castor::faults::test {

rc::Gen<Fault> any_fault();
rc::Gen<FaultPlan> any_plan();

} // namespace castor::faults::test

namespace castor::faults {

/// For rapidcheck.
// NOLINTNEXTLINE(readability-identifier-naming): the name is rapidcheck's
void showValue(const FaultPlan& x, std::ostream& out);

} // namespace castor::faults
