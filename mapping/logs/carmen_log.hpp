#pragma once

#include "castor/mapping/logs/robot_log.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace castor::mapping {

struct CarmenLogOptions {
  /// Lines that cannot be used are left out with a warning, instead of an error.
  bool skip_bad_lines = false;
  /// Ranges from here on are beams that nothing came back from, m; SICK scanners write 81.91.
  double max_range = 80;
  /// Times of lines may run backward by this, s: messages that a logger took late have late times.
  /// The scans' times are made to fit, with a warning.
  double most_lateness = 2;
};

/// Reads the text of a CARMEN log (the format is documented in the log files themselves, and in
/// "CARMEN: Robot Navigation Toolkit", Montemerlo, Roy, Thrun 2003): lines FLASER, ROBOTLASER1,
/// ODOM and PARAM; others are left out. If the log has both kinds of scans, those of ROBOTLASER1
/// count, which say their angles. Beams of FLASER cover half a turn, from the right: they are a
/// whole number of degrees or half degrees apart, or as PARAM laser_front_laser_fov says.
///
/// The scanner is mounted where the first scan's poses of laser and robot have it, or
/// PARAM robot_frontlaser_offset. Poses further apart than a metre are no mount but a corrected
/// path, which is left out with a note.
///
/// Errors: a line that is cut off, what is no number, a range that is NaN or negative, time that
/// runs backward by more than the options allow, a number of beams that changes, and a log without
/// scans.
RobotLogResult parse_carmen_log(std::string_view text, const std::string& file,
                                const CarmenLogOptions& options = {});

/// The same for a file, which may be compressed by gzip.
RobotLogResult read_carmen_log(const std::filesystem::path& file,
                               const CarmenLogOptions& options = {});

} // namespace castor::mapping
