#pragma once

#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/chaos/plan_parser.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace castor::faults::test {

/// Takes the text for that of test.plan. There is one other file, more.plan: at 9s crash tracker.
PlanResult parse(std::string_view text);

/// A plan without anything to remark; fails the test otherwise.
FaultPlan plan_of(std::string_view text);

/// What is wrong with a plan, as a terminal shows it.
std::string flaws_of(std::string_view text);

/// Two subarchitectures, of which `vision` has a journal, with components, one of them isolated;
/// one stand-alone component; and two nodes.
const FaultTargets& table_top();

/// A system in one process: one subarchitecture with one component.
const FaultTargets& small_system();

} // namespace castor::faults::test
