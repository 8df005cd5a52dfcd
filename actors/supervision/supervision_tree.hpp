#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/supervision_policy.hpp"
#include "castor/actors/component/restart_type.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace castor {

/// Decision on a failure.
struct SupervisionDecision {
  enum class Kind : std::uint8_t {
    /// The component stays down; the others go on.
    leave,
    restart,
    /// A limit of restarts is exceeded: the system is to end.
    give_up,
  };

  Kind kind = Kind::leave;
  /// Components to stop first if they run, in the reverse of this order.
  std::vector<std::string> stop = {};
  /// In the order of their start.
  std::vector<std::string> start = {};
  /// How long to wait before that.
  Timestamp delay{0};
  /// The subarchitecture that failed as a whole, because its components did so too often; empty if
  /// none did.
  std::string escalated = {};
  /// Reason of the escalation, for the log.
  std::string reason = {};
};

/// The supervisors of a system: one for each subarchitecture, whose children are its working
/// memory, task manager and components, and above them that of the system, whose children are the
/// subarchitectures and the stand-alone components. Pure: the time and the seed of random numbers
/// are passed in.
///
/// The failure of a working memory restarts all of its subarchitecture, whose components know its
/// entries; that of a task manager restarts the managed components, whose tasks it knew.
class SupervisionTree {
public:
  /// `seed` is that of the jitter.
  explicit SupervisionTree(std::uint64_t seed = 0) : random_(seed) {}

  /// Takes the children and the rules from the architecture. The past failures of children that
  /// stay are kept. Without `restarts` nothing is started again.
  void set(const ArchitectureDescription& architecture, bool restarts = true);

  /// A child has failed.
  SupervisionDecision failed(const std::string& component, Timestamp now);

  /// A child has failed because another one was down, which is supervised itself: it is started
  /// again as any other, with growing delays, but this does not count against the limit of
  /// restarts.
  SupervisionDecision failed_without(const std::string& component, Timestamp now);

  /// A child has ended of itself, with its work done.
  SupervisionDecision ended(const std::string& component, Timestamp now);

  RestartType restart_type(const std::string& component) const;

  /// Those that go down with any of these, in the order of their start.
  std::vector<std::string> with_dependents(const std::vector<std::string>& components) const;

  /// In the order of their start.
  const std::vector<std::string>& order() const { return order_; }

private:
  struct Child {
    RestartType restart = RestartType::permanent;
    ComponentKind kind = ComponentKind::managed;
    /// Empty for a stand-alone component, which the system supervises itself.
    std::string subarchitecture;
    /// Of the recent past.
    std::deque<Timestamp> failures;
  };

  struct Supervisor {
    SupervisionPolicy policy;
    /// In the order of their start.
    std::vector<std::string> children;
    /// Of the recent past.
    std::deque<Timestamp> restarts;
  };

  /// Whether one more restart is within the supervisor's limit.
  static bool may_restart(Supervisor& x, Timestamp now);
  SupervisionDecision restart_child(const std::string& component, Timestamp now);
  /// Restarts it with its siblings, within the limits of its supervisor.
  SupervisionDecision restart_with_siblings(const std::string& component, Timestamp now);
  SupervisionDecision escalate(const std::string& subarchitecture, const std::string& because,
                               Timestamp now);
  /// Of a supervisor's children, those that go down with one of them.
  std::vector<std::string> affected(const Supervisor& supervisor, const std::string& child) const;
  /// Components that these children of the system consist of.
  std::vector<std::string> components_of(const std::vector<std::string>& children) const;
  Timestamp delay_of(const SupervisionPolicy& policy, std::deque<Timestamp>& failures,
                     Timestamp now);

  std::map<std::string, Child> children_;
  std::map<std::string, Supervisor> subarchitectures_;
  Supervisor system_;
  /// Failures of whole subarchitectures.
  std::map<std::string, std::deque<Timestamp>> escalations_;
  std::vector<std::string> order_;
  std::minstd_rand random_;
};

} // namespace castor
