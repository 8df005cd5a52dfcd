#pragma once

#include "castor/mapping/slam/slam.hpp"

#include <string_view>

namespace castor::slam_benchmark {

/// Settings of SLAM that studies change, by their names in the options of the benchmarks; null if
/// none has that name. It is valid as long as `x`.
double* setting(mapping::SlamOptions& x, std::string_view name);

} // namespace castor::slam_benchmark
