#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/wm/journal/journal.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace castor::simulation {

/// Of the machines of a simulated system; the first is the coordinator's.
inline constexpr std::array<std::string_view, 3> machine_names{faults::coordinator, "node1",
                                                               "node2"};

/// No fault begins after that.
inline constexpr std::chrono::milliseconds time_of_faults{1500};
/// How long the links of a simulated system wait for a process to be back.
inline constexpr std::chrono::milliseconds link_patience{1500};

/// How many machines a simulated system has: one, two or three.
std::size_t machine_count(std::uint64_t seed);

/// Which journals the working memories of a simulated system keep: one system in five has `full`
/// ones, one in five `batched` ones, and the others have none.
JournalMode journal_mode(std::uint64_t seed);

/// What of a plan cannot be injected into the system of that seed, or not in a simulation: it takes
/// one fault at a time, `at` given times, of known targets, for as long as the plan says.
std::vector<Diagnostic> check_simulated(const faults::FaultPlan& plan, std::uint64_t seed);

/// What is injected into a simulated system: up to six faults, at given times, which follow from
/// the seed. Every component, working memory and node may end; what keeps processes apart is much
/// shorter than the patience of links, or much longer.
faults::FaultPlan system_faults(std::uint64_t seed);

/// How long a process that is killed at that time is not there.
std::chrono::milliseconds time_until_return(std::uint64_t seed, Timestamp killed);

} // namespace castor::simulation
