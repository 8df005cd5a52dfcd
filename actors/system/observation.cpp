#include "castor/actors/system/observation.hpp"

#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/system/observer.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <utility>

namespace castor {

Observation::Observation(caf::actor_system& system, const SystemOptions& options,
                         const ArchitectureDescription& architecture, RosterFeed& roster,
                         StatusCollector& status)
  : system_(system), options_(options), architecture_(architecture), roster_(roster),
    status_(status) {
  if (options_.on_task)
    make_observer();
}

void Observation::make_observer() {
  if (observer_)
    return;
  // Simulated time waits for those in the pool: what is reported is then always the same.
  observer_ = options_.clock.pace ? system_.spawn(observer, std::cref(options_))
                                  : system_.spawn<caf::detached>(observer, std::cref(options_));
}

void Observation::update() {
  std::map<std::string, LogLevel> logged;
  for (auto& x : architecture_.subarchitectures) {
    WorkingMemoryClass wm_class{x.working_memory};
    if (wm_class.log || wm_class.debug)
      logged[x.name] = wm_class.debug ? LogLevel::trace : LogLevel::debug;
  }
  if (!options_.on_change && !options_.on_entry && options_.watched.empty() && logged.empty())
    return;
  make_observer();
  roster_.set_observer(observer_, std::move(logged));
  await_observer();
  // Its subscriptions are in force once the working memories have answered anything sent after
  // them.
  status_.working_memories();
}

void Observation::await_observer() {
  self_->request(observer_, caf::infinite, FlushObserver{})
    .receive([](bool) {}, [](const caf::error&) {});
}

void Observation::catch_up() {
  if (!observer_)
    return;
  // They have sent by then what they had to tell.
  status_.working_memories();
  await_observer();
}

void Observation::flush() {
  if (!observer_)
    return;
  auto until = std::chrono::steady_clock::now() + options_.stop_patience;
  std::uint64_t last = 0;
  std::uint64_t sent = 0;
  do {
    last = sent;
    await_observer();
    sent = status_.sum_of(&WorkingMemoryStatus::delivered);
  } while (sent != last && std::chrono::steady_clock::now() < until);
}

void Observation::end() {
  caf::anon_send_exit(observer_, caf::exit_reason::user_shutdown);
}

} // namespace castor
