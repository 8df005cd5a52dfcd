#pragma once

#include "castor/actors/component/connections.hpp"
#include "castor/actors/component/push_flow.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/mailbox.hpp"
#include "castor/actors/runtime/provider_client.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/runtime/user_code.hpp"
#include "castor/base/caf.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/events/receipts.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <caf/mailbox_element.hpp>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// A component's push and pull connections, at either end. Used on the component's own thread only.
class ComponentConnections final : public Connections {
public:
  struct Parts {
    PumpedActor& actor;
    ComponentContext& context;
    ProviderClient& providers;
    UserCode& code;
  };

  explicit ComponentConnections(const Parts& parts);
  ComponentConnections(const ComponentConnections&) = delete;
  ComponentConnections& operator=(const ComponentConnections&) = delete;

  void provide(Provision provision) override;
  void push(const Value& x) override;

  /// Both throw ProviderDown if the provider has ended and is not back within the component's
  /// deadline.
  Value pull(const std::string& provider, const TypeDescriptorPtr& type,
             const Value& argument) override;
  void subscribe(const std::string& provider, const TypeDescriptorPtr& type,
                 std::function<void(const Value&)> callback) override;

  // -- what arrives

  /// A subscriber has taken pushes: sends it waiting ones.
  void taken(const caf::strong_actor_ptr& subscriber, const PushesTaken& x);

  /// A subscriber has ended.
  void forget(const caf::actor_addr& subscriber);

  /// As soon as it has arrived, whatever the component does: who subscribes when it starts does not
  /// wait for those that start after it.
  void handle_push_request(caf::mailbox_element& x, const PushRequest& request);

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

  /// What is provided of one type.
  struct Offer {
    /// One for each type of argument.
    std::vector<Provision> provisions;
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
  /// What can be pulled, for messages.
  std::string list_provisions() const;
  /// How a pull is answered, or null. @param argument its type, or null for none
  Provision* find_provision(const std::string& type, const TypeDescriptor* argument);
  void handle_hand_out(caf::mailbox_element& x, const HandOut& order);
  void handle_pull(caf::mailbox_element& x, const PullRequest& request);
  void handle_push(const caf::mailbox_element& x, const Pushed& pushed);
  void send(const Subscriber& to, Value x);
  PushRequest push_request(const TypeDescriptorPtr& type) const;

  Parts parts_;
  /// By type.
  std::map<std::string, Offer> offers_;
  /// By provider and type.
  std::map<std::pair<std::string, std::string>, Reception> receptions_;
};

} // namespace castor
