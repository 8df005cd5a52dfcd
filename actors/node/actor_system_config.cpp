#include "castor/actors/node/actor_system_config.hpp"

#include <caf/io/middleman.hpp>

#include <algorithm>
#include <cstddef>
#include <thread>

namespace castor {

ActorSystemConfig::ActorSystemConfig(bool networked) {
  // The default policy polls with sleeps, which costs several times the latency.
  set("scheduler.policy", caf::atom("sharing"));
  set("scheduler.max-threads", std::max<std::size_t>(2, std::thread::hardware_concurrency()));
  if (networked) {
    load<caf::io::middleman>();
    set("middleman.workers", 0);
  }
}

} // namespace castor
