#pragma once

#include "castor/tools/simulation/campaign_report.hpp"
#include "castor/tools/simulation/seeds.hpp"

#include <cstddef>
#include <functional>

namespace castor::simulation {

class SystemSimulation;

struct CampaignOptions {
  Seeds seeds;
  /// Number of threads; each simulates different systems.
  unsigned threads = 1;
  /// Number of violations after which the campaign ends; at least 1.
  std::size_t most_violations = 1;
  /// Polled about ten times a second, by the thread that called `run_campaign`. If true, the
  /// running simulations are still completed, which takes some tenths of a second.
  std::function<bool()> interrupted = [] { return false; };
  /// Called as often, by the same thread, with the results of all seeds up to the first unfinished
  /// one.
  std::function<void(const CampaignReport&)> progress = [](const CampaignReport&) {};
};

/// The violation of a failed simulation, with a minimal set of its faults.
Violation violation_of(SystemSimulation& simulation, const SystemResult& result);

/// Simulates one system for every seed that is not done in `before`, and adds the results. The same
/// seeds give the same report, except for the elapsed time, with any number of threads.
CampaignReport run_campaign(CampaignReport before, const CampaignOptions& options);

} // namespace castor::simulation
