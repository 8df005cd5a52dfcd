#include "castor/mapping/logs/robot_log_file.hpp"

#include "castor/mapping/logs/carmen_log.hpp"
#include "castor/mapping/logs/rawlog.hpp"

#include <utility>

namespace castor::mapping {

RobotLogResult read_robot_log(const std::filesystem::path& file) {
  if (file.extension() != ".rawlog")
    return read_carmen_log(file);
  auto read = read_rawlog(file);
  RobotLogResult result{std::nullopt, std::move(read.diagnostics)};
  if (!read.rawlog)
    return result;
  if (read.rawlog->log.scans.empty()) {
    Diagnostic x;
    x.where = SourceLocation{file.string(), 0};
    x.message = "the log has " + std::to_string(read.rawlog->clouds.size()) +
                " clouds of points, but no scan of a planar laser";
    x.remedy = "Use a log with CObservation2DRangeScan.";
    result.diagnostics.push_back(std::move(x));
    return result;
  }
  result.log = std::move(read.rawlog->log);
  return result;
}

} // namespace castor::mapping
