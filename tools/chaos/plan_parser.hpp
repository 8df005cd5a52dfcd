#pragma once

#include "castor/actors/cast/parse_options.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/tools/chaos/fault_plan.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

struct PlanResult {
  /// Present exactly if no diagnostic is an error.
  std::optional<FaultPlan> plan;
  /// In the order of the lines.
  std::vector<Diagnostic> diagnostics;

  bool ok() const noexcept { return plan.has_value(); }
};

/// Reads a plan and the files that it includes. All errors are reported as diagnostics. Only the
/// loader and the limits of the options are used.
PlanResult parse_plan_file(const std::string& file, const cast::ParseOptions& options = {});

/// Takes `text` for the content of `file_name`, which need not exist.
PlanResult parse_plan(std::string_view text, const std::string& file_name,
                      const cast::ParseOptions& options = {});

} // namespace castor::faults
