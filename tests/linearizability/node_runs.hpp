#pragma once

#include "castor/tests/linearizability/fault.hpp"
#include "castor/tests/linearizability/real_run.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace castor::linearizability {

/// Is a node of `NodeRuns`, for as long as its parent lives.
[[noreturn]] void serve(const std::string& name);

/// Runs like those of `run_for_real` whose working memories and components are spread over this
/// process and three nodes, which are processes of their own. What they did until they were killed
/// is known, too.
class NodeRuns {
public:
  /// `executable --serve NAME` has to `serve`.
  explicit NodeRuns(const std::string& executable);
  NodeRuns(const NodeRuns&) = delete;
  NodeRuns& operator=(const NodeRuns&) = delete;
  ~NodeRuns();

  /// Nodes and connections fail while it goes on, for so long at most; with nothing, they do not.
  RealRunResult run(std::uint64_t seed, std::optional<std::chrono::milliseconds> longest_fault);

  /// How often each kind of fault happened.
  const std::map<FaultKind, std::size_t>& faults() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace castor::linearizability
