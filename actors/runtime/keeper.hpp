#pragma once

#include "castor/actors/runtime/record.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// A component whose own code has run past its budget, and for how long.
struct Overrun {
  const ComponentRecord* component;
  std::chrono::milliseconds duration;
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

struct KeeperParts {
  std::vector<std::shared_ptr<ComponentRecord>> components;
  /// By subarchitecture.
  std::map<std::string, WorkingMemoryActor> working_memories;
  /// Called when one runs past its budget; may be empty.
  std::function<void(const Overrun&)> on_overrun = {};
};

/// The keeper of one process: renews the leases of its components while they return from their own
/// code within their budget, and reports those that do not.
caf::behavior keeper(caf::event_based_actor* self, KeeperParts parts);

} // namespace castor
