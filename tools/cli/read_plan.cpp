#include "castor/tools/cli/read_plan.hpp"

#include "castor/actors/node/placement.hpp"
#include "castor/tools/chaos/plan_parser.hpp"
#include "castor/tools/cli/output.hpp"

#include <vector>

namespace castor::cli {

faults::FaultTargets targets_in(const ArchitectureDescription& architecture) {
  std::vector<std::string> nodes;
  for (auto& [host, name] : other_hosts(architecture))
    nodes.push_back(name);
  return faults::targets_of(architecture, nodes);
}

bool is_possible(const faults::FaultPlan& plan, const faults::FaultTargets& targets) {
  auto problems = faults::check_plan(plan, targets);
  print(problems);
  return problems.empty();
}

std::optional<faults::FaultPlan> read_plan(const std::string& file,
                                           const faults::FaultTargets& targets) {
  auto result = faults::parse_plan_file(file);
  print(result.diagnostics);
  if (!result.ok() || !is_possible(*result.plan, targets))
    return std::nullopt;
  return std::move(result.plan);
}

} // namespace castor::cli
