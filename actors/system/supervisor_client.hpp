#pragma once

#include "castor/actors/supervision/supervisor.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace castor {

/// Names of all components that have one, working memories and task managers included.
std::vector<std::string> names_of(const ArchitectureDescription& x);

/// The supervisor of a system, for its main thread, which waits for the answers.
class SupervisorClient {
public:
  /// Both have to outlive it.
  SupervisorClient(caf::actor_system& system, const SystemOptions& options)
    : system_(system), options_(options) {}

  void begin(SupervisorParts parts);
  void end();

  /// Deploys the architecture in every process. Throws SystemError.
  void deploy(const ArchitectureDescription& architecture, const Placement& placement);

  /// Configures them all, then starts them all, then lets them run. Nothing if interrupted,
  /// otherwise what is wrong with their configuration; then none of them is started. `on_started`
  /// is called as soon as they have been started, on another thread, whether or not that is the
  /// result.
  std::optional<std::vector<Diagnostic>> start(const std::vector<std::string>& names,
                                               const std::function<void()>& on_started = {});

  /// Returns those that have stopped, in the order of their end.
  std::vector<std::string> stop(const std::vector<std::string>& names);
  /// The same, and logs them.
  void stop_and_log(const std::vector<std::string>& names);

  /// Those that did not stop.
  const std::vector<std::string>& stuck() const { return stuck_; }

  /// Sends the supervisor a message, if it runs. Safe to call from any thread.
  template <class Message>
  void tell(const Message& x) const {
    std::lock_guard guard{mutex_};
    if (supervisor_)
      caf::anon_send(supervisor_, x);
  }

private:
  /// Nothing if the wait for the answer was interrupted.
  template <class Answer, class Question>
  std::optional<Answer> ask(const Question& question, bool interruptible,
                            const std::function<void()>& on_answer = {});

  caf::actor_system& system_;
  const SystemOptions& options_;
  mutable std::mutex mutex_;
  caf::actor supervisor_;
  std::vector<std::string> stuck_;
};

} // namespace castor
