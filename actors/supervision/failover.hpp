#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/supervision/supervision_tree.hpp"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// Places the children of lost processes: in another process that the architecture names for that,
/// otherwise in the one that takes the place of the lost one, for which they wait. Pure.
class Failover {
public:
  /// Children that wait for the successor of their process.
  struct Awaited {
    /// In the order of their start.
    std::vector<std::string> names;
    /// Decision on their restart if the loss was a failure; otherwise they just move.
    std::optional<SupervisionDecision> decision;
  };

  /// New places of the children of a lost process.
  struct Loss {
    /// Those that another process takes over; they are placed there.
    std::vector<std::string> moved;
    /// Those that no other process takes over now.
    std::vector<std::string> left;
    /// Whether a successor of the process is needed: for those that are `left`, or because others
    /// may have to move there later.
    bool needs_successor = false;
  };

  /// Placement of a new architecture. Hosts and children that were moved meanwhile stay where they
  /// are.
  void set(Placement placement);

  const Placement& placement() const { return placement_; }
  ProcessNumber process_of(const std::string& name) const { return placement_.process_of(name); }

  /// A process is lost, in which these ran, including children that awaited the process.
  Loss lose(ProcessNumber lost, const std::vector<std::string>& names,
            const ArchitectureDescription& architecture,
            const std::function<bool(ProcessNumber)>& is_up);

  /// The successor takes over the hosts of the lost process, and the children that await it.
  void set_successor(ProcessNumber lost, ProcessNumber successor, Awaited awaited);

  /// The process is in reach: returns the children that have awaited it, and clears them.
  std::optional<Awaited> take_awaited(ProcessNumber process);

  /// Marks children that are to be made in other processes than before.
  void begin_move(const std::vector<std::string>& names);

  /// The child is made now. True if it moves with that.
  bool end_move(const std::string& name) { return moving_.erase(name) > 0; }

  /// Whether the child waits for the successor of its process.
  bool is_awaited(const std::string& name) const;

  /// Whether the child is in no process at the moment: it moves, or is awaited.
  bool is_between_processes(const std::string& name) const {
    return moving_.count(name) > 0 || is_awaited(name);
  }

private:
  /// Another process in which the child may run.
  std::optional<ProcessNumber>
  substitute_for(const std::string& name, const ArchitectureDescription& architecture,
                 const std::function<bool(ProcessNumber)>& is_up) const;
  bool is_substitute(ProcessNumber x, const ArchitectureDescription& architecture) const;

  Placement placement_;
  std::set<std::string> moving_;
  /// By the successors of lost processes.
  std::map<ProcessNumber, Awaited> awaited_;
};

} // namespace castor
