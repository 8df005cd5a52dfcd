#pragma once

#include "castor/tools/simulation/campaign_report.hpp"
#include "castor/tools/simulation/seeds.hpp"

#include <cstddef>
#include <functional>

namespace castor::simulation {

class SystemSimulation;

struct CampaignOptions {
  Seeds seeds;
  /// Each simulates systems of its own.
  unsigned threads = 1;
  /// It ends after so many violations; at least 1.
  std::size_t most_violations = 1;
  /// Asked some ten times a second, by the thread that called `run_campaign`. Systems that are
  /// under way then come to their end, which takes some tenths of a second.
  std::function<bool()> interrupted = [] { return false; };
  /// Told as often, by the same thread: all that is done so far, without gaps.
  std::function<void(const CampaignReport&)> progress = [](const CampaignReport&) {};
};

/// What is wrong with a system that violates something, with as few of its faults as it takes.
Violation violation_of(SystemSimulation& simulation, const SystemResult& result);

/// Simulates one system for every seed that `before` has not done, and adds what came of them. The
/// same seeds give the same report, but for the time it took, however many threads there are.
CampaignReport run_campaign(CampaignReport before, const CampaignOptions& options);

} // namespace castor::simulation
