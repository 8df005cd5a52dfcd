#pragma once

#include "castor/actors/system/system.hpp"
#include "castor/tools/timeline/stages.hpp"

#include <mutex>
#include <string>
#include <vector>

namespace castor::cli {

/// What a user may call a file of a timeline: empty if it can be written, otherwise what is wrong
/// with it, as command lines have it.
std::string check_timeline_file(const std::string& name);

/// Follows what happens in the working memories of a system, and draws it.
class TimelineFiles {
public:
  explicit TimelineFiles(timeline::StageOptions options) : stages_(options) {}

  /// To be called before the system is made.
  void watch(SystemOptions& options);

  /// To be called before the system starts: what journals have brought back.
  void look_at_beginning(System& system);

  /// To be called before the system is stopped: what happens from now on is its end.
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
