#pragma once

#include "castor/tools/chaos/chaos_run.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// 0 and its multiples of 1, 2 or 5 times a power of ten, up to `most`: about so many.
std::vector<double> round_ticks(double most, int count);

/// These are SVG elements for the page of `to_html`, which has the styles that their classes name.
/// What cannot be seen at once is told where the mouse is.

/// A row for everything that failed or was to fail: its faults, when it was down, when it was back.
std::string timeline_chart(const ChaosRun& run);

/// How many outages took how long; empty if there are none that ended.
std::string recovery_chart(const ChaosRun& run);

/// The names of the processes, each once; the lines of all that had one name look alike.
std::vector<std::string> process_names(const ChaosRun& run);

/// The styles c0, c1 and so on of the lines of processes; then they begin anew.
inline constexpr std::size_t chart_colours = 6;

/// One of the values of all processes over time, divided by `unit`; empty if there are none.
std::string resource_chart(const ChaosRun& run, std::uint64_t ResourceSample::*value, double unit,
                           std::string_view title);

} // namespace castor::faults
