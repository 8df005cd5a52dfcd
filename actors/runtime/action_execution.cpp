#include "castor/actors/runtime/action_execution.hpp"

#include "castor/actors/component/component_runtime.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/operations_client.hpp"
#include "castor/base/log.hpp"

#include <algorithm>
#include <optional>

namespace castor {

Action with_result(Action action, const ActionResult& result) {
  action.status = ActionStatus::over;
  action.outcome = result.outcome;
  action.reason = result.reason;
  action.became_true = result.became_true;
  action.became_false = result.became_false;
  if (result.outcome == ActionOutcome::succeeded)
    action.progress = 1;
  return action;
}

Action failed_by_end(Action action) {
  auto reason = action.executor + " of " + action.subarchitecture + " ended while it executed it";
  auto result = with_result(std::move(action), ActionResult::failed(std::move(reason)));
  result.executor_ended = true;
  return result;
}

void ActionExecution::begin() {
  update([](Action& x) { x.status = ActionStatus::running; });
}

void ActionExecution::progress(double part) {
  update([part](Action& x) { x.progress = std::clamp(part, 0.0, 1.0); });
}

bool ActionExecution::cancelled() {
  if (!parts_.client.is_running())
    return true;
  refresh();
  if (!must_end())
    return false;
  if (state_.status != ActionStatus::cancelling)
    update([](Action& x) { x.status = ActionStatus::cancelling; });
  return true;
}

bool ActionExecution::wait_while_paused() {
  while (!cancelled() && state_.can_pause && state_.wish == ActionWish::pause) {
    if (state_.status != ActionStatus::paused)
      update([](Action& x) { x.status = ActionStatus::paused; });
    // The wish may have changed during the write.
    wait(Timestamp::max(), ActionWish::pause);
  }
  followed_wish_ = state_.wish;
  if (state_.status == ActionStatus::paused)
    update([](Action& x) { x.status = ActionStatus::running; });
  return !cancelled();
}

bool ActionExecution::sleep_for(std::chrono::nanoseconds duration) {
  auto goes_on =
    wait(parts_.runtime.now() + std::chrono::ceil<Timestamp>(duration), followed_wish_);
  followed_wish_ = state_.wish;
  return goes_on;
}

bool ActionExecution::wait_until(const std::function<bool()>& done,
                                 std::chrono::nanoseconds at_most) {
  const auto until = at_most == std::chrono::nanoseconds::max()
                       ? Timestamp::max()
                       : parts_.runtime.now() + std::chrono::ceil<Timestamp>(at_most);
  auto goes_on = wait(until, followed_wish_, done);
  followed_wish_ = state_.wish;
  return goes_on;
}

bool ActionExecution::wait(Timestamp until, ActionWish wish, const std::function<bool()>& is_done) {
  auto& runtime = parts_.runtime;
  auto left = [&] {
    return until == Timestamp::max()
             ? std::nullopt
             : std::optional<std::chrono::nanoseconds>{until - runtime.now()};
  };
  // A delivery, of news on this action or of anything else, is an occasion to look.
  while (!cancelled() && state_.wish == wish && runtime.now() < until && !is_done())
    if (!runtime.deliver(left(), [&] { return actions_.is_changed(address_) || is_done(); }))
      return false;
  return !cancelled();
}

bool ActionExecution::finish(const ActionResult& result) {
  refresh();
  for (;;) {
    if (is_deleted_)
      return true;
    if (state_.status == ActionStatus::over) {
      log_runtime(LogLevel::warning, parts_.context.identity().full_name(),
                  "its action " + to_string(address_) +
                    " was ended by somebody else: " + state_.reason);
      return true;
    }
    auto next = with_result(state_, result);
    try {
      component_.write(WriteBatch{}.overwrite(address_, next, life_of_outcome).without_last_will());
      state_ = std::move(next);
      return true;
    } catch (const ConsistencyException&) {
      read_again();
    } catch (const DoesNotExistOnWM&) {
      return true;
    } catch (const WorkingMemoryException& e) {
      if (e.address().subarchitecture == parts_.context.identity().subarchitecture)
        throw;
      log_runtime(LogLevel::info, parts_.context.identity().full_name(), e.what());
      state_ = std::move(next);
      return false;
    }
  }
}

void ActionExecution::refresh() {
  if (actions_.take_changed(address_))
    read_again();
}

void ActionExecution::read_again() {
  try {
    state_ = *component_.read<Action>(address_);
  } catch (const DoesNotExistOnWM&) {
    is_deleted_ = true;
  } catch (const WorkingMemoryException& e) {
    if (e.address().subarchitecture == parts_.context.identity().subarchitecture)
      throw;
    // Its working memory is lost; who continues does so on its own.
  }
}

bool ActionExecution::must_end() const {
  if (is_deleted_ || state_.status == ActionStatus::over)
    return true;
  auto is_alone = actions_.is_requester_gone(address_) && !state_.continues;
  return state_.can_cancel && (is_alone || state_.wish == ActionWish::cancel);
}

void ActionExecution::update(const std::function<void(Action&)>& change) {
  while (!is_deleted_ && state_.status != ActionStatus::over) {
    auto next = state_;
    change(next);
    try {
      component_.overwrite(address_, next);
      state_ = std::move(next);
      return;
    } catch (const ConsistencyException&) {
      read_again();
    } catch (const DoesNotExistOnWM&) {
      is_deleted_ = true;
    } catch (const WorkingMemoryException& e) {
      if (e.address().subarchitecture == parts_.context.identity().subarchitecture)
        throw;
      // Its working memory is lost. The result is written when it is back.
      state_ = std::move(next);
      return;
    }
  }
}

} // namespace castor
