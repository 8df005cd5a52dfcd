#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/stop_patience.hpp"
#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/supervision/failover.hpp"
#include "castor/actors/supervision/roster.hpp"
#include "castor/actors/supervision/supervision_tree.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace castor {

/// A component, task manager or working memory, as its supervisor knows it.
struct SupervisedChild {
  std::size_t number = 0;
  ComponentKind kind = ComponentKind::managed;
  std::string subarchitecture;
  /// How long it may take to stop.
  std::chrono::milliseconds shutdown = standard_stop_patience;
  /// Counts its lives, from 1.
  std::uint64_t incarnation = 1;
  bool alive = true;
  /// Whether it has a process of its own.
  bool isolated = false;
  /// Whether it stays as it is, and is not started again.
  bool given_up = false;
  /// Whether its process was killed because it did not stop.
  bool killed = false;
};

/// The children of a supervisor, and the plans and rosters made from them. Pure.
class SystemModel {
public:
  /// Both have to outlive it.
  SystemModel(const SupervisionTree& tree, const Failover& failover)
    : tree_(tree), failover_(failover) {}

  /// Takes the children from the architecture. The state of those that stay is kept. `shutdown` is
  /// the time to stop of those without an own setting.
  void set(ArchitectureDescription architecture, std::chrono::milliseconds shutdown);

  const ArchitectureDescription& architecture() const { return architecture_; }

  /// Null if there is no such child.
  const SupervisedChild* find(const std::string& name) const;
  /// The child must exist.
  const SupervisedChild& child(const std::string& name) const { return children_.at(name); }
  /// Those of the names that are children, in the order of their start.
  std::vector<std::string> in_order(const std::vector<std::string>& names) const;

  // -- lives of children; all of them must exist

  void begin_life(const std::string& name);
  /// Sets whether it is alive. Returns whether it was.
  bool set_alive(const std::string& name, bool alive);
  void set_given_up(const std::string& name, bool given_up);
  /// Sets whether its process was killed. Returns the previous value.
  bool set_killed(const std::string& name, bool killed);

  // -- plans and rosters

  /// Architecture, placement and lives; the rest is the caller's.
  PartPlan plan() const;
  /// Children, placement, and those of the `actors` that may be asked; the rest is the caller's.
  SystemRoster roster(const std::map<std::string, caf::strong_actor_ptr>& actors) const;

private:
  ComponentStatus status_of(const std::string& name) const;

  const SupervisionTree& tree_;
  const Failover& failover_;
  ArchitectureDescription architecture_;
  std::map<std::string, SupervisedChild> children_;
};

} // namespace castor
