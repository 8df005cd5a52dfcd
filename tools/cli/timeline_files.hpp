#pragma once

#include "castor/actors/system/system.hpp"
#include "castor/tools/timeline/stages.hpp"

#include <mutex>
#include <string>
#include <vector>

namespace castor::cli {

/// For CLI11's `check` of a timeline's file name: empty if the file can be written, otherwise an
/// error message.
std::string check_timeline_file(const std::string& name);

/// Records the changes on the working memories of a system, and draws them.
class TimelineFiles {
public:
  explicit TimelineFiles(timeline::StageOptions options) : stages_(options) {}

  /// To be called before the system is made.
  void watch(SystemOptions& options);

  /// Adds entries restored from journals. To be called before the system starts.
  void look_at_beginning(System& system);

  /// To be called before the system is stopped: later changes belong to the shutdown and are not
  /// drawn.
  void end(System& system);

  /// To be called once the system has stopped. Throws std::runtime_error.
  void write(const std::vector<std::string>& files, const std::string& title,
             std::vector<std::string> subarchitectures);

private:
  std::mutex mutex_;
  timeline::Stages stages_;
  bool ended_ = false;
};

} // namespace castor::cli
