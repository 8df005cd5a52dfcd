#pragma once

#include "castor/actors/component/record.hpp"
#include "castor/wm/caf.hpp"

#include <chrono>
#include <memory>
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

private:
  struct Watched {
    std::shared_ptr<const ComponentRecord> component;
    bool reported = false;
  };

  std::vector<Watched> watched_;
};

/// The keeper of one process: looks after the components that live in it. It says when one of them
/// has not come back from its own code within its budget.
caf::behavior keeper(caf::event_based_actor* self,
                     std::vector<std::shared_ptr<const ComponentRecord>> components);

} // namespace castor
