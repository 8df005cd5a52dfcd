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

/// Names of the machines of a simulated system; the first is the coordinator's.
inline constexpr std::array<std::string_view, 3> machine_names{faults::coordinator, "node1",
                                                               "node2"};

/// Time after which no fault begins.
inline constexpr std::chrono::milliseconds time_of_faults{1500};
/// Time that the links of a simulated system wait for a lost process.
inline constexpr std::chrono::milliseconds link_patience{1500};

/// Number of machines of a simulated system: one, two or three.
std::size_t machine_count(std::uint64_t seed);

/// Journal mode of the working memories of a simulated system: `full` for one system in five,
/// `batched` for one in five, none for the others.
JournalMode journal_mode(std::uint64_t seed);

/// Errors in a plan for the simulated system of that seed. A simulation supports only statements
/// `at TIME` with one fault, a named target, and a duration if the fault lasts.
std::vector<Diagnostic> check_simulated(const faults::FaultPlan& plan, std::uint64_t seed);

/// The faults of a simulated system: up to six, at fixed times, determined by the seed. Any
/// component, working memory and node may end. Partitions are either much shorter or much longer
/// than `link_patience`.
faults::FaultPlan system_faults(std::uint64_t seed);

/// Time from the kill of a process to its restart.
std::chrono::milliseconds time_until_return(std::uint64_t seed, Timestamp killed);

} // namespace castor::simulation
