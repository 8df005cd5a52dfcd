#pragma once

#include "castor/tools/simulation/happenings.hpp"
#include "castor/tools/simulation/seeds.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace castor::simulation {

struct SystemResult;

/// A system that did not keep what Castor promises.
struct Violation {
  std::uint64_t seed = 0;
  /// What is wrong, in lines.
  std::string text;
  /// How many faults the seed has.
  std::size_t faults = 0;
  /// As few of them as it takes, as a fault plan; empty if it takes none.
  std::string plan;
  /// Shows the run once more.
  std::string command;
};

/// What came of the systems of consecutive seeds.
struct CampaignReport {
  /// What is asked for.
  Seeds seeds;
  /// So many of them are done, from the first on.
  std::uint64_t done = 0;
  /// Systems whose history the checker could not decide on.
  std::uint64_t undecided = 0;
  /// Operations of clients on working memories.
  std::uint64_t operations = 0;
  /// Scheduling decisions: messages that were handled, or time that passed.
  std::uint64_t steps = 0;
  Happenings happened = Happenings::everything();
  std::vector<Violation> violations;
  std::chrono::duration<double> elapsed{0};

  bool is_complete() const { return done == seeds.size(); }
  bool held() const { return violations.empty(); }
  double systems_per_second() const {
    return elapsed.count() > 0 ? double(done) / elapsed.count() : 0;
  }

  /// Counts a system that was simulated; its violation, if there is one, is added by the caller.
  void add(const SystemResult& x);
  /// Adds what came of the next seeds.
  void append(CampaignReport next);
};

/// Lines of text for a terminal.
std::string to_text(const CampaignReport& x);

/// The report as JSON, which `from_json` reads back: it is the state file, too.
std::string to_json(const CampaignReport& x);

/// Throws std::invalid_argument, which says what is wrong with the text.
CampaignReport from_json(const std::string& text);

} // namespace castor::simulation
