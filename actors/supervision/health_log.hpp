#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/supervision/deployment.hpp"

#include <caf/event_based_actor.hpp>

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace castor {

/// Reports components and working memories that go down and come back: in the log, to the callbacks
/// of the options, and as entries of the working memory of `castor` (health.hpp).
class HealthLog {
public:
  /// All of them have to outlive it.
  HealthLog(caf::event_based_actor* self, const Deployments& deployments,
            const SystemOptions& options)
    : self_(self), deployments_(deployments), options_(options) {}

  struct Subject {
    std::string name;
    /// Empty for a stand-alone component.
    std::string subarchitecture;
    std::uint64_t incarnation = 1;
    /// Whether its failure is in the log of this process already.
    bool reports_itself = false;
  };

  /// One that is known to be down is not reported again, unless it will not be restarted.
  void down(const Subject& who, const std::string& reason, bool will_restart);

  /// Nothing happens if it is not known to be down.
  void up(const Subject& who);

  /// Forgets those that are no part of the architecture any more.
  void forget_others(const ArchitectureDescription& architecture);

private:
  using Clock = std::chrono::steady_clock;

  /// Replaces the entry of a component.
  void write(const std::string& name, Value value);

  caf::event_based_actor* self_;
  const Deployments& deployments_;
  const SystemOptions& options_;
  std::map<std::string, Clock::time_point> down_since_;
  /// Names of those that have an entry.
  std::set<std::string> reported_;
};

} // namespace castor
