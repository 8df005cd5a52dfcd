#include "castor/actors/system/reconfiguration.hpp"

#include "castor/actors/cast/running.hpp"
#include "castor/actors/node/check.hpp"
#include "castor/base/log.hpp"

#include <algorithm>
#include <utility>

namespace castor {

Reconfiguration::Reconfiguration(ArchitectureDescription& architecture,
                                 const SystemOptions& options, Processes& processes,
                                 const RosterFeed& roster, SupervisorClient& supervisor,
                                 Observation& observation)
  : architecture_(architecture), options_(options), processes_(processes), roster_(roster),
    supervisor_(supervisor), observation_(observation) {
  for_each_component(architecture_,
                     [&](auto& x) { next_number_ = std::max(next_number_, x.number + 1); });
}

std::vector<Diagnostic> Reconfiguration::add(ArchitectureDescription added) {
  auto joined = architecture_;
  if (auto problems = cast::join(joined, added, next_number_); !problems.empty())
    return problems;
  auto placement = place(joined, options_.nodes, roster_.newest()->hosts);
  if (auto problems = problems_of(placement, joined); !problems.empty())
    return problems;
  try {
    processes_.connect(joined, placement);
    supervisor_.deploy(joined, placement);
  } catch (const SystemError& e) {
    revert(std::move(placement));
    return e.diagnostics();
  }
  auto before = std::exchange(architecture_, std::move(joined));
  observation_.update();
  auto problems = supervisor_.start(names_of(added));
  if (!problems)
    return {
      {Severity::error, {}, {}, {}, "the system ended before the new components were started", {}}};
  if (problems->empty())
    return {};
  supervisor_.stop(names_of(added));
  architecture_ = std::move(before);
  revert(placement);
  observation_.update();
  return *std::move(problems);
}

std::string Reconfiguration::remove(const std::string& name) {
  auto rest = architecture_;
  auto removal = cast::remove(rest, name);
  if (!removal.problem.empty())
    return removal.problem;
  supervisor_.stop_and_log(removal.components);
  architecture_ = std::move(rest);
  auto placement = place(architecture_, options_.nodes, roster_.newest()->hosts);
  forget_lost_hosts(placement);
  try {
    supervisor_.deploy(architecture_, placement);
  } catch (const SystemError& e) {
    // A node that does not answer now will be told of it when it is asked for something else.
    log_runtime(LogLevel::warning, e.what());
  }
  observation_.update();
  return {};
}

/// What could not be added is to be nowhere.
void Reconfiguration::revert(Placement placement) {
  auto before = place(architecture_, options_.nodes, roster_.newest()->hosts);
  // A host whose process could not be reached gets another one next time.
  std::erase_if(placement.hosts, [&](auto& x) {
    return before.hosts.count(x.first) == 0 &&
           (x.second >= processes_.size() || processes_.state(x.second).link == LinkState::lost);
  });
  placement.processes.resize(processes_.size());
  before.hosts = std::move(placement.hosts);
  before.processes = std::move(placement.processes);
  try {
    supervisor_.deploy(architecture_, before);
  } catch (const SystemError& e) {
    log_runtime(LogLevel::warning, e.what());
  }
}

/// What is added for a host whose process is lost, once nothing is left of what it ran, goes to the
/// process that listens there then.
void Reconfiguration::forget_lost_hosts(Placement& placement) const {
  std::erase_if(placement.hosts, [&](auto& host) {
    return processes_.state(host.second).link == LinkState::lost &&
           std::none_of(placement.of.begin(), placement.of.end(),
                        [&](auto& x) { return x.second == host.second; });
  });
}

} // namespace castor
