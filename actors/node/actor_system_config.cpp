#include "castor/actors/node/actor_system_config.hpp"

#include "castor/actors/node/counting_policy.hpp"
#include "castor/actors/node/threads.hpp"

#include <caf/io/middleman.hpp>
#include <caf/scheduler/coordinator.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <utility>

namespace castor {

ActorSystemConfig::ActorSystemConfig(bool networked, std::shared_ptr<Activity> activity)
  : CountingConfig(std::move(activity)) {
  if (this->activity())
    load<caf::scheduler::coordinator<CountingPolicy>>();
  // The default policy polls with sleeps, which costs several times the latency.
  set("scheduler.policy", caf::atom("sharing"));
  const auto workers = std::max<std::size_t>(2, std::thread::hardware_concurrency());
  set("scheduler.max-threads", workers);
  // Its clock, its network, and some to spare.
  if (auto problem = why_no_threads(workers + 4); !problem.empty())
    throw std::runtime_error(problem);
  if (networked) {
    load<caf::io::middleman>();
    set("middleman.workers", 0);
  }
}

} // namespace castor
