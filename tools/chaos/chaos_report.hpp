#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <string>

namespace castor::faults {

/// A self-contained page: the verdict, every violation with the command that reproduces it, a
/// timeline of faults and outages, recovery times, resources over time, the lists of all of it, and
/// the plan.
std::string to_html(const ChaosRun& run);

/// The report as JSON. Times are in microseconds.
std::string to_json(const ChaosRun& run);

/// A summary of the report for a terminal.
/// @param coloured uses ANSI escape sequences
std::string to_text(const ChaosRun& run, bool coloured = false);

/// The verdict and its grounds in one line.
std::string to_line(const ChaosRun& run, bool coloured = false);

/// "held", "2 violations", or "vacuous, nothing went down".
std::string verdict_of(const ChaosRun& run);

/// "14 outages: component 11, working memory 3".
std::string outage_summary(const ChaosRun& run);

/// "11.2 callbacks and 30.1 operations a second, active in 58 of 60 samples".
std::string activity_summary(const Activity& x);

/// "17 of 20 faults happened, 2 never triggered, 1 not injected".
std::string fault_summary(const ChaosRun& run);

/// "41 back, 1 given up, 0 neither; half within 120ms, 99 % within 800ms, all within 910ms".
std::string recovery_summary(const ChaosRun& run);

} // namespace castor::faults
