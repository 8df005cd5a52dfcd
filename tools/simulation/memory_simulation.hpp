#pragma once

#include "castor/tools/linearizability/checker.hpp"
#include "castor/tools/linearizability/history.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace castor::linearizability {

struct SimulationResult {
  History history;
  /// Verdict of the checker.
  Verdict verdict;
  /// Other errors: missing answers, leases that were never released, events in the wrong order.
  std::vector<std::string> findings;

  bool ok() const { return verdict.ok() && findings.empty(); }

  /// Whether an error was found; false if the checker could not decide.
  bool is_wrong() const { return verdict.kind == Verdict::Kind::violation || !findings.empty(); }
};

/// Lines of text: all errors.
std::string to_string(const SimulationResult& x);

/// Two or three working memories and four to eight clients on CAF's test coordinator. A seed
/// determines which actor runs next, when time passes and what the clients do.
///
/// The clients operate on one to four entries at random, several operations at a time, through
/// their own or another working memory; they wait, give up waiting, end and restart, let leases
/// expire, and show old tokens and guessed versions. The results are checked after all activity has
/// ended.
class Simulation {
public:
  Simulation();
  ~Simulation();

  /// Simulates and checks one history.
  SimulationResult run(std::uint64_t seed);

private:
  class Stage;
  std::unique_ptr<Stage> stage_;
};

} // namespace castor::linearizability
