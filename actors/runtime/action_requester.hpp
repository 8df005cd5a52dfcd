#pragma once

#include "castor/actors/component/actions.hpp"
#include "castor/actors/runtime/action_parts.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace castor {

class SubarchitectureComponent;
struct WaitEdge;

/// The actions that one component has asked for.
class ActionRequester {
public:
  ActionRequester(SubarchitectureComponent& component, const ActionParts& parts)
    : component_(component), parts_(parts) {}

  Address request(const std::string& subarchitecture, const Value& what,
                  const ActionOptions& options);
  Action state(const Address& address);
  bool is_over(const Address& address);
  Action wait(const Address& address, std::optional<std::chrono::nanoseconds> timeout);
  bool wish(const Address& address, ActionWish wish);
  /// Does not throw: destructors call it.
  void release(const Address& address) noexcept;

private:
  struct Requested {
    /// As it was last read.
    Action state;
    bool is_over = false;
    /// Nobody here is interested in it any more.
    bool is_released = false;
    Timestamp since{0};
  };

  void listen();
  /// Throws UnknownSubarchitectureException.
  void check_known(const std::string& subarchitecture);
  void note_end(const Address& address);
  void try_release(const Address& address);
  void remove_entries(const Address& address);
  Failure not_over(Failure failure, const Action& action) const;
  /// What the component waits for, if an executor has accepted the action.
  std::optional<WaitEdge> wait_edge(const Address& address, WaitNumber number, Timestamp since);

  SubarchitectureComponent& component_;
  ActionParts parts_;
  bool listens_ = false;
  /// Subarchitectures that there are.
  std::set<std::string> known_;
  /// By the id of the action.
  std::map<std::string, Requested> requested_;
};

} // namespace castor
