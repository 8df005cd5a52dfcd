#pragma once

#include "castor/actors/system/system.hpp"
#include "castor/tools/chaos/chaos_run.hpp"
#include "castor/tools/chaos/expected_changes.hpp"
#include "castor/tools/chaos/outages.hpp"
#include "castor/tools/chaos/workload.hpp"
#include "castor/tools/cli/chaos_setup.hpp"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::cli {

class ForbiddenChanges;
class HistoryWatch;
class WorkloadRun;

/// What a trial is judged by. Each check is noted in the run with what it rests on, and each
/// violation with what was found.
class ChaosChecks {
public:
  /// @param when follows the names of violations, and checks that hold are not noted, unless it is
  ///   empty: of a run without faults only violations are of interest
  ChaosChecks(const ChaosSetup& setup, faults::ChaosRun& run, std::string when)
    : setup_(setup), run_(run), when_(std::move(when)) {}

  /// Changes that the workload forbids, and those that it demands; none without a workload.
  const std::vector<faults::ForbiddenChange>& forbidden() const;
  const std::vector<faults::ExpectedChange>& demanded() const;

  /// @param ended exit status and reason of a system that ended by itself
  void survival(EndReason reason, const std::optional<std::pair<int, std::string>>& ended);

  /// @param wanted, got states from `state_of`, without and with faults
  void state(const std::vector<std::string>& wanted, const std::vector<std::string>& got);

  faults::WorkloadRecord workload(WorkloadRun& work);
  void forbidden_changes(const ForbiddenChanges& seen);
  void expected_changes(const faults::ExpectedChanges& expected);

  /// @param end time since the beginning of the run
  void outages(const std::vector<faults::LifeNote>& notes, Timestamp end);
  void components(const SystemSummary& summary);

  /// @param begin is called with the name of each check before it is made
  void histories(const HistoryWatch& histories,
                 const std::function<void(const std::string& name)>& begin);
  void resources(std::vector<faults::ProcessResources> resources);

  /// @param name of a check, without `when`
  void violation(const std::string& name, const std::string& text);

private:
  void check(const std::string& name, bool held, const std::string& grounds);

  const ChaosSetup& setup_;
  faults::ChaosRun& run_;
  const std::string when_;
};

} // namespace castor::cli
