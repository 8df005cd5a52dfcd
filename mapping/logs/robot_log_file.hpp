#pragma once

#include "castor/mapping/logs/robot_log.hpp"

#include <filesystem>

namespace castor::mapping {

/// Reads a log of either kind: a file that ends in `.rawlog` with read_rawlog(), any other one with
/// read_carmen_log(). A rawlog with clouds but without a planar laser is an error here.
RobotLogResult read_robot_log(const std::filesystem::path& file);

} // namespace castor::mapping
