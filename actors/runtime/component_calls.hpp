#pragma once

#include "castor/actors/component/call_types.hpp"
#include "castor/actors/component/calls.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/component_operations.hpp"
#include "castor/actors/runtime/inbox.hpp"
#include "castor/actors/runtime/operations_client.hpp"
#include "castor/actors/runtime/served_calls.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/values/timestamp.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace castor {

class SubarchitectureComponent;
struct ChangeEvent;

/// The calls over working memory that one component makes and serves.
class ComponentCalls final : public Calls {
public:
  struct Parts {
    ComponentContext& context;
    OperationsClient& client;
    ComponentOperations& operations;
    Inbox& inbox;
  };

  ComponentCalls(SubarchitectureComponent& component, const Parts& parts)
    : component_(component), parts_(parts) {}

  Value call(const std::string& subarchitecture, const Value& request,
             const TypeDescriptor& reply_type, const CallOptions& options) override;
  void serve(const TypeDescriptor& request_type, const TypeDescriptor& reply_type,
             Handler handler) override;
  bool is_cancelled() const override { return current_ && served_.is_over(*current_); }

private:
  /// A call of this component that is under way.
  struct Open {
    Timestamp since{0};
    bool taken = false;
    bool settled = false;
    bool server_ended = false;
  };

  struct Made {
    Address call;
    Address request;
  };

  void listen_to(const std::string& subarchitecture);
  void note_progress(const ChangeEvent& event);
  void make(const Made& made, const std::string& subarchitecture, const Value& request,
            const TypeDescriptor& reply_type);
  void cancel(const Made& made);
  /// The reply, or nothing if the server went away.
  std::optional<Value> await_reply(const std::string& subarchitecture, const Made& made,
                                   const Value& request, const Open& open,
                                   std::chrono::steady_clock::time_point until);
  Failure not_served(Failure failure, const std::string& subarchitecture,
                     const std::string& request_type, const Open& open);
  /// Address of the entry whose owner the call waits for; nothing if several components could serve
  /// it.
  std::optional<Address> obstacle(const std::string& subarchitecture, const Made& made,
                                  const std::string& request_type, const Open& open);

  void listen_for_ends();
  void take(const Address& call, const Handler& handler);
  /// Takes a call; null if it is gone or another server has taken it.
  std::shared_ptr<const Call> claim(const Address& call);
  void answer(const Address& call_at, const Call& call, const Handler& handler);
  void clean_up_later();
  void clean_up();
  Address progress_of(const Address& call) const;

  SubarchitectureComponent& component_;
  Parts parts_;

  std::map<std::string, Open> open_;
  std::set<std::string> listened_to_;

  bool serving_ = false;
  std::optional<Address> current_;
  ServedCalls served_;
};

} // namespace castor
