#pragma once

#include "castor/actors/cast/parse_options.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/tools/chaos/workload.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

struct WorkloadResult {
  /// Present exactly if no diagnostic is an error.
  std::optional<Workload> workload;
  /// In the order of the lines.
  std::vector<Diagnostic> diagnostics;

  bool ok() const noexcept { return workload.has_value(); }
};

/// Reads a workload and the files that it includes. All errors are reported as diagnostics. Only
/// the loader and the limits of the options are used.
WorkloadResult parse_workload_file(const std::string& file, const cast::ParseOptions& options = {});

/// Takes `text` for the content of `file_name`, which need not exist.
WorkloadResult parse_workload(std::string_view text, const std::string& file_name,
                              const cast::ParseOptions& options = {});

} // namespace castor::faults
