#include "castor/actors/system/supervisor_client.hpp"

#include "castor/base/log.hpp"

#include <caf/event_based_actor.hpp>

#include <chrono>
#include <future>
#include <memory>
#include <utility>

namespace castor {

namespace {

/// How often the main thread looks up from waiting for an answer.
constexpr std::chrono::milliseconds poll_interval{50};

} // namespace

std::vector<std::string> names_of(const ArchitectureDescription& x) {
  std::vector<std::string> result;
  for_each_component(x, [&](auto& y) {
    if (!y.name.empty())
      result.push_back(y.name);
  });
  return result;
}

void SupervisorClient::begin(SupervisorParts parts) {
  auto spawned = system_.spawn(supervisor, std::move(parts));
  std::lock_guard guard{mutex_};
  supervisor_ = spawned;
}

void SupervisorClient::end() {
  caf::anon_send_exit(supervisor_, caf::exit_reason::user_shutdown);
  await_ends(system_, {supervisor_});
  std::lock_guard guard{mutex_};
  supervisor_ = nullptr;
}

template <class Answer, class Question>
std::optional<Answer> SupervisorClient::ask(const Question& question, bool interruptible,
                                            const std::function<void()>& on_answer) {
  auto answer = std::make_shared<std::promise<std::optional<Answer>>>();
  auto future = answer->get_future();
  system_.spawn([answer, question, on_answer, to = supervisor_](caf::event_based_actor* self) {
    self->request(to, caf::infinite, question)
      .then(
        [answer, on_answer](const Answer& x) {
          if (on_answer)
            on_answer();
          answer->set_value(x);
        },
        [answer](const caf::error&) { answer->set_value(std::nullopt); });
  });
  while (future.wait_for(poll_interval) != std::future_status::ready)
    if (interruptible && options_.interrupted && options_.interrupted())
      return std::nullopt;
  return future.get();
}

void SupervisorClient::deploy(const ArchitectureDescription& architecture,
                              const Placement& placement) {
  auto deployed = ask<Deployed>(Deploy{architecture, placement}, false);
  if (deployed && !deployed->problems.empty())
    throw SystemError{std::move(deployed->problems)};
}

std::optional<std::vector<Diagnostic>>
SupervisorClient::start(const std::vector<std::string>& names,
                        const std::function<void()>& on_started) {
  auto started = ask<ComponentsStarted>(StartComponents{names}, true, on_started);
  if (!started)
    return std::nullopt;
  return std::move(started->problems);
}

std::vector<std::string> SupervisorClient::stop(const std::vector<std::string>& names) {
  auto outcome = ask<ComponentsStopped>(StopComponents{names}, false);
  if (!outcome)
    return {};
  stuck_.insert(stuck_.end(), outcome->stuck.begin(), outcome->stuck.end());
  return std::move(outcome->stopped);
}

void SupervisorClient::stop_and_log(const std::vector<std::string>& names) {
  std::string list;
  for (auto& name : stop(names))
    list += (list.empty() ? "" : ", ") + name;
  if (!list.empty())
    log_runtime(LogLevel::info, "stopped, in this order: " + list);
}

} // namespace castor
