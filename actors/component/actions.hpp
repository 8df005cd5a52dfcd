#pragma once

#include "castor/actors/component/action_types.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor {

struct ActionOptions {
  /// Entry that is the reason for the action.
  AnyEntryPointer cause = {};
  /// The action goes on if its requester ends.
  bool continues = false;
};

/// How a component executes a type of actions.
struct ActionOffer {
  /// What has to hold for such an action to succeed, for people and planners.
  std::string preconditions = {};
  bool can_pause = false;
  bool can_cancel = true;
  /// Such an action may begin while the component executes another; it then runs inside the waits
  /// of that one. Otherwise actions wait for their turn.
  bool alongside = false;
};

/// How an action ended, as its executor says.
struct ActionResult {
  ActionOutcome outcome = ActionOutcome::succeeded;
  std::string reason = {};
  std::vector<std::string> became_true = {};
  std::vector<std::string> became_false = {};

  static ActionResult succeeded(std::vector<std::string> became_true = {},
                                std::vector<std::string> became_false = {}) {
    return {ActionOutcome::succeeded, {}, std::move(became_true), std::move(became_false)};
  }
  static ActionResult failed(std::string reason) {
    return {ActionOutcome::failed, std::move(reason)};
  }
  static ActionResult cancelled(std::string reason = "its requester cancelled it") {
    return {ActionOutcome::cancelled, std::move(reason)};
  }
};

/// An action while it is executed, for its executor.
class ActionInProgress {
public:
  virtual ~ActionInProgress() = default;

  virtual const Address& address() const = 0;

  /// The part that is done, from 0 to 1, for all to see.
  virtual void progress(double part) = 0;

  /// Whether the action is to end: its requester has cancelled it or has ended, or this component
  /// is told to stop. False for one that cannot be cancelled, and after the end of a requester
  /// whose action continues.
  virtual bool cancelled() = 0;

  /// While the requester wants a pause, waits, and delivers events meanwhile. False if the action
  /// is to end.
  virtual bool wait_while_paused() = 0;

  /// Waits, and delivers events meanwhile. Ends early if the requester wants something else; false
  /// if the action is to end.
  virtual bool sleep_for(std::chrono::nanoseconds duration) = 0;

  /// Waits until `done` returns true, or for `at_most`, and delivers events meanwhile; else like
  /// `sleep_for`. `done` is asked after each event, after the end of an action that this component
  /// has asked for, and when another thread calls its `waker()`.
  virtual bool wait_until(const std::function<bool()>& done,
                          std::chrono::nanoseconds at_most = std::chrono::nanoseconds::max()) = 0;
};

/// The actions that one component asks for and executes, without the types of their entries.
class Actions {
public:
  using Handler = std::function<ActionResult(ActionInProgress& action, const Value& what)>;

  virtual ~Actions() = default;

  // -- as requester

  /// Address of the action.
  virtual Address request(const std::string& subarchitecture, const Value& what,
                          const ActionOptions& options) = 0;
  virtual Action state(const Address& action) = 0;
  virtual bool is_over(const Address& action) = 0;
  virtual Action wait(const Address& action, std::optional<std::chrono::nanoseconds> timeout) = 0;
  virtual bool wish(const Address& action, ActionWish wish) = 0;
  /// The requester has no further interest in the action.
  virtual void release(const Address& action) = 0;

  // -- as executor

  virtual void offer(const TypeDescriptor& type, ActionOffer offer, Handler handler) = 0;
};

} // namespace castor
