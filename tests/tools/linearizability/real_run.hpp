#pragma once

#include "castor/tests/tools/linearizability/world.hpp"
#include "castor/tools/linearizability/checker.hpp"
#include "castor/tools/linearizability/history.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace castor::linearizability {

struct RealRunResult {
  /// What the run was: components, subarchitectures, entries.
  std::string description;
  /// Moments are nanoseconds.
  History history;
  Verdict verdict;
  /// What else is wrong.
  std::vector<std::string> findings;

  bool is_wrong() const { return verdict.kind == Verdict::Kind::violation || !findings.empty(); }
};

/// Runs a system of 4 to 16 components, each on its own thread, that operate on a few entries at
/// random through the interface that component authors use, and checks what they saw. What they
/// try follows from the seed; what comes of it does not.
RealRunResult run_for_real(std::uint64_t seed);

/// A letter, from 'a' for the first one.
std::string subarchitecture_name(std::size_t subarchitecture);

/// Whether the condition comes true in time.
bool await(const std::function<bool()>& condition, std::chrono::steady_clock::time_point until);

/// Checks what was seen in a world; `ends` says from when on the leases of a client may have ended.
void judge(RealRunResult& result, const World& world, std::chrono::milliseconds lease,
           const std::map<Client, Tick>& ends);

} // namespace castor::linearizability
