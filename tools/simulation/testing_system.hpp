#pragma once

#include <caf/actor_system.hpp>
#include <caf/actor_system_config.hpp>
#include <caf/atom.hpp>
#include <caf/expected.hpp>
#include <caf/scheduler/test_coordinator.hpp>
#include <caf/scoped_actor.hpp>

#include <cstddef>
#include <utility>

namespace castor::simulation {

/// An actor system on CAF's test coordinator: actors run and time passes only under control of the
/// test.
class TestingSystem {
private:
  struct Config : caf::actor_system_config {
    Config() { set("scheduler.policy", caf::atom("testing")); }
  };

  Config config_;

public:
  /// Runs one of the ready actors, by index.
  void run_one(std::size_t job) {
    std::swap(scheduler.jobs.front(), scheduler.jobs[job]);
    scheduler.run_once();
  }

  /// Runs all actors until there is an answer.
  template <class Reply, class Actor, class Request>
  caf::expected<Reply> answer_of(const Actor& to, const Request& request) {
    caf::expected<Reply> result{caf::error{}};
    auto handle = outsider->request(to, caf::infinite, request);
    scheduler.run();
    handle.receive([&](const Reply& x) { result = x; }, [&](const caf::error& e) { result = e; });
    return result;
  }

  caf::actor_system system{config_};
  caf::scheduler::test_coordinator& scheduler =
    dynamic_cast<caf::scheduler::test_coordinator&>(system.scheduler());
  caf::scoped_actor outsider{system};
};

} // namespace castor::simulation
