#pragma once

#include "castor/actors/component/actions.hpp"
#include "castor/wm/entries/address.hpp"

#include <chrono>
#include <optional>
#include <utility>

namespace castor {

/// An action that a component has asked for. Destroying the handle cancels the action, and deletes
/// its entries once it is over. One that continues goes on, and its entries stay for ten minutes. A
/// handle is used by the component that made it, and does not outlive it.
class ActionHandle {
public:
  ActionHandle() = default;
  ActionHandle(Actions& actions, Address address)
    : actions_(&actions), address_(std::move(address)) {}
  ActionHandle(ActionHandle&& other) noexcept
    : actions_(std::exchange(other.actions_, nullptr)), address_(std::move(other.address_)) {}
  ActionHandle& operator=(ActionHandle&& other) noexcept {
    std::swap(actions_, other.actions_);
    std::swap(address_, other.address_);
    return *this;
  }
  ~ActionHandle() {
    if (actions_)
      actions_->release(address_);
  }

  /// Whether there is an action.
  explicit operator bool() const { return actions_ != nullptr; }

  /// Address of the `Action`.
  const Address& address() const { return address_; }

  /// The action as it stands. Of one whose entry was deleted, the last state, with the outcome
  /// `failed`.
  Action state() const { return actions_->state(address_); }
  ActionStatus status() const { return state().status; }
  double progress() const { return state().progress; }

  /// Without an operation on working memory.
  bool is_over() const { return actions_->is_over(address_); }

  /// Waits until the action is over. No events are delivered meanwhile, as in a call. Throws
  /// DeadlineException after the timeout, if there is one, and the action goes on;
  /// DeadlockException if the executor waits for this component.
  Action wait(std::optional<std::chrono::nanoseconds> timeout = {}) const {
    return actions_->wait(address_, timeout);
  }

  /// Each is false if the action is over, or if its executor does not do that. Otherwise the
  /// executor is told; one that nobody has accepted is over at once when it is cancelled.
  bool cancel() const { return actions_->wish(address_, ActionWish::cancel); }
  bool pause() const { return actions_->wish(address_, ActionWish::pause); }
  bool resume() const { return actions_->wish(address_, ActionWish::proceed); }

private:
  Actions* actions_ = nullptr;
  Address address_;
};

} // namespace castor
