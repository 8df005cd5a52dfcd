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
  /// What the checker said of it.
  Verdict verdict;
  /// What else is wrong: answers that never came, leases that nobody gave back, changes told in
  /// the wrong order.
  std::vector<std::string> findings;

  bool ok() const { return verdict.ok() && findings.empty(); }

  /// Not so if the checker could not decide.
  bool is_wrong() const { return verdict.kind == Verdict::Kind::violation || !findings.empty(); }
};

/// Lines of text: what is wrong.
std::string to_string(const SimulationResult& x);

/// Two or three working memories and four to eight clients on CAF's test coordinator. Who runs
/// next, when time passes and what the clients do follows from a seed.
///
/// The clients operate on one to four entries at random, several operations at a time, through
/// their own or another working memory; they wait, give up waiting, die and come back, let leases
/// run out, show old tokens and guess versions. What they see is checked when all has come to rest.
class Simulation {
public:
  Simulation();
  ~Simulation();

  /// One history, checked.
  SimulationResult run(std::uint64_t seed);

private:
  class Stage;
  std::unique_ptr<Stage> stage_;
};

} // namespace castor::linearizability
