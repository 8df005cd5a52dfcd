#pragma once

#include "castor/actors/component/connections.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/mailbox.hpp"
#include "castor/actors/runtime/operations_client.hpp"
#include "castor/base/caf.hpp"
#include "castor/wm/entries/failure.hpp"

#include <caf/mailbox_element.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace castor {

/// A stand-alone component is down, and was not back in time. If this ends the component that
/// waited for it, the end does not count as a failure of that component.
class ProviderDown : public ConnectionError {
public:
  ProviderDown(std::string provider, const std::string& what)
    : ConnectionError(what), provider_(std::move(provider)) {}

  const std::string& provider() const { return provider_; }

private:
  std::string provider_;
};

/// Sends a component's requests to stand-alone components, found by name, and waits for those that
/// are being started again. `task` in what follows completes "cannot ..." in errors.
class ProviderClient {
public:
  struct Parts {
    PumpedActor& actor;
    ComponentContext& context;
    OperationsClient& client;
  };

  explicit ProviderClient(const Parts& parts) : parts_(parts) {}

  /// Null if it is down. Throws ConnectionError if the system has no such component.
  caf::actor find(const std::string& name) const;

  template <class Reply>
  struct Answer {
    caf::actor provider;
    Reply reply;
  };

  /// The reply to a request that does no harm if it is made twice: if the provider ends before it
  /// has answered, its successor is asked. Throws ConnectionError, and ProviderDown if it is not
  /// back within the component's deadline.
  template <class Reply, class Request>
  Answer<Reply> ask(const std::string& name, const Request& request, const std::string& task) {
    auto until = deadline();
    for (caf::actor_addr gone;;) {
      auto provider = await(name, gone, task, until);
      if (auto reply = send(name, provider, caf::make_message(request), task, until))
        return {std::move(provider), take<Reply>(*reply, name, task)};
      gone = provider.address();
    }
  }

  /// The reply to a request that is made once. Throws ConnectionError, also if that provider ends
  /// before it has answered.
  template <class Reply, class Request>
  Reply ask_once(const std::string& name, const caf::actor& provider, const Request& request,
                 const std::string& task) {
    if (auto reply = send(name, provider, caf::make_message(request), task, deadline()))
      return take<Reply>(*reply, name, task);
    throw ConnectionError("cannot " + task + " " + name + ": it ended before it answered");
  }

private:
  using Clock = ComponentContext::Clock;

  Clock::time_point deadline() const { return Clock::now() + parts_.context.deadline(); }

  /// Waits for another provider than the one that is `gone`.
  caf::actor await(const std::string& name, const caf::actor_addr& gone, const std::string& task,
                   Clock::time_point until) const;

  /// Waits for the reply; null if the provider has ended before.
  caf::mailbox_element_ptr send(const std::string& name, const caf::actor& provider,
                                const caf::message& request, const std::string& task,
                                Clock::time_point until) const;

  /// What to do if this component, which starts, may wait for one that starts after it; empty if it
  /// runs already.
  std::string remedy_at_start(const std::string& provider) const;

  template <class Reply>
  Reply take(caf::mailbox_element& x, const std::string& name, const std::string& task) const {
    auto outcome = parts_.client.take<Outcome<Reply>>(x, {name, {}});
    if (!outcome)
      throw ConnectionError("cannot " + task + " " + name + ": " + outcome.failure().message);
    return *std::move(outcome);
  }

  Parts parts_;
};

} // namespace castor
