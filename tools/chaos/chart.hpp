#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// About `count` axis ticks from 0 to `most`, at multiples of 1, 2 or 5 times a power of ten.
std::vector<double> round_ticks(double most, int count);

/// These are SVG elements for the page of `to_html`, which defines the styles of their classes.
/// Details are shown as tooltips.

/// A row for each target of a fault: its faults, outages and recoveries.
std::string timeline_chart(const ChaosRun& run);

/// Histogram of recovery times; empty if no outage has ended.
std::string recovery_chart(const ChaosRun& run);

/// The distinct names of the processes. The lines of processes of one name look alike.
std::vector<std::string> process_names(const ChaosRun& run);

/// Number of line styles (c0, c1, ...); further processes reuse them in order.
inline constexpr std::size_t chart_colours = 6;

/// One resource of all processes over time, divided by `unit`; empty without samples.
std::string resource_chart(const ChaosRun& run, std::uint64_t ResourceSample::*value, double unit,
                           std::string_view title);

} // namespace castor::faults
