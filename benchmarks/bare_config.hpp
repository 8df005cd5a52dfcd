#pragma once

#include "castor/base/caf.hpp"

#include <algorithm>
#include <thread>

namespace castor::benchmark {

/// Settings of the bare framework, to compare with: those that Castor runs with.
struct BareConfig : caf::actor_system_config {
  BareConfig() {
    set("scheduler.policy", caf::atom("sharing"));
    set("scheduler.max-threads", std::max<std::size_t>(2, std::thread::hardware_concurrency()));
    set("middleman.workers", 0);
  }
};

} // namespace castor::benchmark
