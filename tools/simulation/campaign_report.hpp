#pragma once

#include "castor/tools/simulation/happenings.hpp"
#include "castor/tools/simulation/seeds.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace castor::simulation {

struct SystemResult;

/// A simulated system that violated a promise of Castor.
struct Violation {
  std::uint64_t seed = 0;
  /// Findings, as lines of text.
  std::string text;
  /// Number of faults of the seed.
  std::size_t faults = 0;
  /// A minimal set of faults that causes the violation, as a fault plan; empty if it occurs without
  /// faults.
  std::string plan;
  /// Command line that repeats the run.
  std::string command;
};

/// Results of the systems of consecutive seeds.
struct CampaignReport {
  /// Seeds of the campaign.
  Seeds seeds;
  /// Number of seeds done, from the first on.
  std::uint64_t done = 0;
  /// Number of systems whose history the checker could not decide.
  std::uint64_t undecided = 0;
  /// Operations of clients on working memories.
  std::uint64_t operations = 0;
  /// Number of scheduling decisions: to handle a message, or to let time pass.
  std::uint64_t steps = 0;
  Happenings happened = Happenings::everything();
  std::vector<Violation> violations;
  std::chrono::duration<double> elapsed{0};

  bool is_complete() const { return done == seeds.size(); }
  bool held() const { return violations.empty(); }
  double systems_per_second() const {
    return elapsed.count() > 0 ? double(done) / elapsed.count() : 0;
  }

  /// Counts a simulated system; the caller adds its violation, if there is one.
  void add(const SystemResult& x);
  /// Adds the results of the next seeds.
  void append(CampaignReport next);
};

/// Lines of text for a terminal.
std::string to_text(const CampaignReport& x);

/// The report as JSON for `from_json`; also the format of the state file.
std::string to_json(const CampaignReport& x);

/// Throws std::invalid_argument with the error in the text.
CampaignReport from_json(const std::string& text);

} // namespace castor::simulation
