#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/base/diagnostic.hpp"
#include "castor/tools/chaos/fault_plan.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// The possible targets of faults in a system.
struct FaultTargets {
  /// Number of restarts that a supervisor allows within a period.
  struct RestartLimit {
    std::uint32_t restarts = 0;
    Timestamp period{0};
  };
  struct Component {
    std::string name;
    /// Empty for a stand-alone component.
    std::string subarchitecture;
    ComponentKind kind = ComponentKind::managed;
    /// Runs in a process of its own.
    bool isolated = false;

    /// Whether `any component` of a plan includes it.
    bool is_any() const {
      return kind != ComponentKind::working_memory && kind != ComponentKind::task_manager;
    }
  };
  struct Subarchitecture {
    std::string name;
    /// Whether its working memory has a journal.
    bool has_journal = false;
    /// Whether its working memory continues without the journal if that fails.
    bool goes_on_without_journal = false;
    RestartLimit limit = {};
  };

  /// In the order of the file, working memories and task managers included.
  std::vector<Component> components;
  std::vector<Subarchitecture> subarchitectures;
  /// Without the coordinator.
  std::vector<std::string> nodes;
  /// Limit of the supervisor of stand-alone components and subarchitectures.
  RestartLimit system_limit = {};

  /// The subarchitecture of a component or a working memory; empty for a stand-alone one.
  std::string supervisor_of(const std::string& component) const;
  /// Limit of a subarchitecture, or of the system if `supervisor` is empty.
  RestartLimit limit_of(const std::string& supervisor) const;
};

/// Kind of a component or a working memory: "isolated component", "task manager".
std::string_view word_for(const FaultTargets& targets, const std::string& component);

FaultTargets targets_of(const ArchitectureDescription& architecture,
                        std::vector<std::string> nodes);

/// Errors in a plan: names unknown in the system, and faults that cannot be injected into their
/// target.
std::vector<Diagnostic> check_plan(const FaultPlan& plan, const FaultTargets& targets);

} // namespace castor::faults
