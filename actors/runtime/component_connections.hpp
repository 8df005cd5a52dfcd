#pragma once

#include "castor/actors/component/connections.hpp"
#include "castor/actors/component/push_flow.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/mailbox.hpp"
#include "castor/actors/runtime/operations_client.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/runtime/user_code.hpp"
#include "castor/base/caf.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/events/receipts.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <caf/mailbox_element.hpp>

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

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

/// A component's push and pull connections, at either end. Used on the component's own thread only.
class ComponentConnections final : public Connections {
public:
  struct Parts {
    PumpedActor& actor;
    ComponentContext& context;
    OperationsClient& client;
    UserCode& code;
  };

  explicit ComponentConnections(const Parts& parts);
  ComponentConnections(const ComponentConnections&) = delete;
  ComponentConnections& operator=(const ComponentConnections&) = delete;

  void provide(const TypeDescriptorPtr& type, std::function<Value()> make) override;
  void push(const Value& x) override;

  /// Both throw ProviderDown if the provider has ended and is not back within the component's
  /// deadline.
  Value pull(const std::string& provider, const TypeDescriptorPtr& type) override;
  void subscribe(const std::string& provider, const TypeDescriptorPtr& type,
                 std::function<void(const Value&)> callback) override;

  // -- what arrives

  /// A subscriber has taken pushes: sends it waiting ones.
  void taken(const caf::strong_actor_ptr& subscriber, const PushesTaken& x);

  /// A subscriber has ended.
  void forget(const caf::actor_addr& subscriber);

  /// Handles the message if it concerns connections; otherwise returns false.
  bool handle(caf::mailbox_element& x);

  /// Drops all connections.
  void clear();

private:
  struct Subscriber {
    caf::actor actor;
    std::string name;
    PushFlow flow;
  };

  struct Provision {
    std::function<Value()> make;
    std::vector<Subscriber> subscribers;
  };

  struct Reception {
    TypeDescriptorPtr type;
    caf::actor provider;
    std::vector<std::function<void(const Value&)>> callbacks;
    Receipts receipts;
  };

  /// The neighbours have changed: subscribes again to providers that were started again.
  void renew_subscriptions();
  /// Records a value that is handed out.
  void record(bool pushed, const Value& x);
  void handle_hand_out(caf::mailbox_element& x, const HandOut& order);
  void handle_pull(caf::mailbox_element& x, const PullRequest& request);
  void handle_push_request(caf::mailbox_element& x, const PushRequest& request);
  void handle_push(const caf::mailbox_element& x, const Pushed& pushed);
  void send(const Subscriber& to, Value x);
  /// Null if it is down. Throws ConnectionError if the system has no such component.
  caf::actor find_provider(const std::string& name) const;
  /// Waits for another provider than the one that is `gone`; `task` completes "cannot ..." in
  /// errors.
  caf::actor await_provider(const std::string& name, const caf::actor_addr& gone,
                            const std::string& task,
                            std::chrono::steady_clock::time_point until) const;
  PushRequest push_request(const TypeDescriptorPtr& type) const;

  class ReplySlot;

  struct Answer {
    caf::actor provider;
    Value value;
  };

  /// Sends a request to the provider; if that ends before it has answered, to its successor.
  template <class Request>
  Answer ask(const std::string& provider, const Request& request, const std::string& task);

  Parts parts_;
  /// By type.
  std::map<std::string, Provision> provisions_;
  /// By provider and type.
  std::map<std::pair<std::string, std::string>, Reception> receptions_;
};

} // namespace castor
