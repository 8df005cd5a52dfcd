#pragma once

#include "castor/tests/tools/linearizability/fault.hpp"
#include "castor/tests/tools/linearizability/real_run.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace castor::linearizability {

/// How long processes that cannot reach each other try, if nothing else is said: longer than any
/// fault lasts.
inline constexpr std::chrono::milliseconds ample_patience{30'000};

/// How the processes of `NodeRuns` deal with each other.
struct NodeRunOptions {
  std::chrono::milliseconds patience = ample_patience;
  /// A folder that `scripts/make-certs` has made for run, node1, node2 and node3, if all is to be
  /// encrypted.
  std::filesystem::path certificates;
};

/// Is a node of `NodeRuns`, for as long as its parent lives.
[[noreturn]] void serve(const std::string& name, const NodeRunOptions& options);

/// Runs like those of `run_for_real` whose working memories and components are spread over this
/// process and three nodes, which are processes of their own. What they did until they were killed
/// is known, too.
class NodeRuns {
public:
  /// `executable --serve NAME --patience DURATION [--tls DIR]` has to `serve`. Where faults last
  /// longer than the patience, processes lose each other though they live.
  explicit NodeRuns(const std::string& executable, const NodeRunOptions& options = {});
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
