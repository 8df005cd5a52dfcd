#pragma once

#include "castor/actors/node/system_options.hpp"
#include "castor/tools/chaos/workload.hpp"

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace castor::cli {

/// Changes that the workload forbids, as the system tells of them, by any thread.
class ForbiddenChanges {
public:
  explicit ForbiddenChanges(const std::vector<faults::ForbiddenChange>& never)
    : never_(never), seen_(never.size()) {}

  /// Adds the filters to those that the system watches.
  void watch(SystemOptions& options);

  /// One text for each filter that a change matched.
  std::vector<std::string> violations() const;

private:
  struct Seen {
    std::size_t count = 0;
    std::string first;
  };

  const std::vector<faults::ForbiddenChange>& never_;
  mutable std::mutex mutex_;
  std::vector<Seen> seen_;
};

} // namespace castor::cli
