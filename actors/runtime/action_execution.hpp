#pragma once

#include "castor/actors/component/actions.hpp"
#include "castor/actors/runtime/action_parts.hpp"
#include "castor/actors/runtime/executed_actions.hpp"
#include "castor/wm/entries/address.hpp"

#include <chrono>
#include <functional>
#include <utility>

namespace castor {

class SubarchitectureComponent;

/// The action, over with this result.
Action with_result(Action action, const ActionResult& result);

/// What the entry of an accepted action says once its executor has ended.
Action failed_by_end(Action action);

/// An action that a component executes. Keeps the entry's state; what others write there is read
/// when the executor asks.
class ActionExecution final : public ActionInProgress {
public:
  ActionExecution(SubarchitectureComponent& component, const ActionParts& parts,
                  ExecutedActions& actions, Address address, Action accepted)
    : component_(component), parts_(parts), actions_(actions), address_(std::move(address)),
      state_(std::move(accepted)) {}

  const Address& address() const override { return address_; }
  void progress(double part) override;
  bool cancelled() override;
  bool wait_while_paused() override;
  bool sleep_for(std::chrono::nanoseconds duration) override;
  bool wait_until(const std::function<bool()>& done, std::chrono::nanoseconds at_most) override;

  const Action& state() const { return state_; }

  void begin();

  /// Writes the result. False if that has to be tried again, once the action's working memory is
  /// back.
  bool finish(const ActionResult& result);

private:
  /// Delivers events until then, until it is done, or until the action is to end or the wish is
  /// another one. False if the action is to end.
  bool wait(Timestamp until, ActionWish wish, const std::function<bool()>& is_done = never_done);
  static bool never_done() { return false; }
  /// Reads the entry if somebody else has written it.
  void refresh();
  void read_again();
  /// Whether the action is to end; as of the last `refresh`.
  bool must_end() const;
  /// Writes what `change` makes of the state, unless somebody else has ended the action.
  void update(const std::function<void(Action&)>& change);

  SubarchitectureComponent& component_;
  ActionParts parts_;
  ExecutedActions& actions_;
  Address address_;
  /// As it was last read or written.
  Action state_;
  /// The wish that the handler knows of: a write may have found a newer one.
  ActionWish followed_wish_ = ActionWish::proceed;
  bool is_deleted_ = false;
};

} // namespace castor
