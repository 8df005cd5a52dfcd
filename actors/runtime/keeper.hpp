#pragma once

#include "castor/actors/runtime/record.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor {

/// A component whose own code has run past its budget, for how long, and what it does.
struct Overrun {
  const ComponentRecord* component;
  std::chrono::milliseconds duration;
  /// Such as "start()".
  std::string activity;
};

/// Finds components whose own code runs past its budget; each is reported once per overrun.
class BudgetWatch {
public:
  explicit BudgetWatch(std::vector<std::shared_ptr<const ComponentRecord>> components);

  std::vector<Overrun> check(ComponentRecord::Clock::time_point now);

  /// Whether the component was within its budget when last looked at.
  static bool is_responsive(const ComponentRecord& x, ComponentRecord::Clock::time_point now) {
    return x.in_user_code_for(now) <= x.budget();
  }

private:
  struct Watched {
    std::shared_ptr<const ComponentRecord> component;
    bool reported = false;
  };

  std::vector<Watched> watched_;
};

/// Says when to give memory of deleted entries back to the system, which the allocator keeps for
/// entries to come: after many deletions, once there are few for a second. It takes a while, and
/// whoever wants memory waits meanwhile.
class DeletionWatch {
public:
  using Clock = std::chrono::steady_clock;

  /// To be called often, with the number of deletions so far; true if memory is to be given back
  /// now.
  bool check(std::uint64_t deletions, Clock::time_point now);

  /// So many deletions are many, and fewer in a second are few.
  static constexpr std::uint64_t many = 10'000;
  static constexpr std::uint64_t few = 1'000;

private:
  std::optional<std::uint64_t> given_back_at_;
  std::uint64_t second_began_at_ = 0;
  Clock::time_point second_began_;
};

struct KeeperParts {
  std::vector<std::shared_ptr<ComponentRecord>> components;
  /// By subarchitecture.
  std::map<std::string, WorkingMemoryActor> working_memories;
  /// Called when one runs past its budget; may be empty.
  std::function<void(const Overrun&)> on_overrun = {};
};

/// The keeper of one process: renews the leases of its components while they return from their own
/// code within their budget, reports those that do not, and gives memory back to the system. It
/// looks four times a second, and every two seconds while no component holds a lease or runs its
/// own code.
caf::behavior keeper(caf::event_based_actor* self, KeeperParts parts);

} // namespace castor
