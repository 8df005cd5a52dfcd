#include "castor/actors/runtime/action_requester.hpp"

#include "castor/actors/component/component.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/runtime/action_execution.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/component_operations.hpp"
#include "castor/actors/runtime/inbox.hpp"
#include "castor/actors/runtime/injected_faults.hpp"
#include "castor/actors/runtime/operations_client.hpp"
#include "castor/base/log.hpp"
#include "castor/wm/leases/deadlock_probe.hpp"

#include <utility>

namespace castor {

Address ActionRequester::request(const std::string& subarchitecture, const Value& what,
                                 const ActionOptions& options) {
  listen();
  check_known(subarchitecture);
  auto address = component_.here(component_.new_id());
  auto what_address = component_.here(component_.new_id());
  Action action;
  action.what = {what_address, what.type_name()};
  action.subarchitecture = subarchitecture;
  action.requester = parts_.context.identity().name;
  action.cause = options.cause;
  action.continues = options.continues;
  WriteBatch batch;
  batch.add_value(what_address, what,
                  {.ephemeral = !options.continues, .writable_by_all = options.continues});
  batch.add(address, action, life_of_action);
  if (!options.continues)
    batch.last_will(
      with_result(action, ActionResult::cancelled("its requester, " + action.requester +
                                                  ", ended before anybody accepted it")),
      life_of_outcome);
  // It may be heard of before the write has returned.
  auto& requested = requested_[address.id];
  requested = {action, false, false, parts_.context.now()};
  try {
    component_.write(batch);
  } catch (...) {
    requested_.erase(address.id);
    throw;
  }
  return address;
}

void ActionRequester::listen() {
  if (std::exchange(listens_, true))
    return;
  auto own = field(&Action::requester) == parts_.context.identity().name;
  auto note = [this](const ChangeEvent& event) { note_end(event.address); };
  // An event that is coalesced stands for an overwrite, too, whatever its operation is.
  parts_.operations.add_listener(
    changed<Action>().where(own && field(&Action::status) == ActionStatus::over), note);
  parts_.operations.add_listener(deleted<Action>().where(own), note);
}

void ActionRequester::check_known(const std::string& subarchitecture) {
  if (known_.count(subarchitecture) > 0)
    return;
  try {
    component_.exists({subarchitecture, "action"});
  } catch (const PermissionException&) {
    // It may not read there, and need not.
  } catch (const WorkingMemoryLostException& e) {
    if (subarchitecture == component_.subarchitecture())
      throw;
    // Those who execute the action will be back.
  }
  known_.insert(subarchitecture);
}

void ActionRequester::note_end(const Address& address) {
  auto i = requested_.find(address.id);
  if (i == requested_.end())
    return;
  i->second.is_over = true;
  // Who waits for it is to look.
  parts_.inbox.put(Inbox::Task{"the end of an action", [this, address] {
                                 const auto ended = requested_.find(address.id);
                                 if (ended != requested_.end() && ended->second.is_released)
                                   remove_entries(address);
                               }});
}

Action ActionRequester::state(const Address& address) {
  auto& requested = requested_.at(address.id);
  try {
    requested.state = *component_.read<Action>(address);
  } catch (const DoesNotExistOnWM&) {
    if (requested.state.status != ActionStatus::over)
      requested.state =
        with_result(requested.state, ActionResult::failed("its entry was deleted before its end"));
  }
  if (requested.state.status == ActionStatus::over)
    requested.is_over = true;
  return requested.state;
}

bool ActionRequester::is_over(const Address& address) {
  parts_.client.is_running(); // files what has arrived
  return requested_.at(address.id).is_over;
}

Action ActionRequester::wait(const Address& address,
                             std::optional<std::chrono::nanoseconds> timeout) {
  auto& requested = requested_.at(address.id);
  auto patience = timeout.value_or(std::chrono::hours{24 * 365});
  auto failure = parts_.client.wait_until([&] { return requested.is_over; },
                                          ComponentContext::Clock::now() + patience,
                                          [&, number = parts_.client.patience({}).number] {
                                            return wait_edge(address, number, requested.since);
                                          });
  if (failure && failure->kind == FailureKind::no_answer)
    throw_failure(not_over(*failure, state(address)));
  if (failure)
    throw_failure(*failure);
  return state(address);
}

std::optional<WaitEdge> ActionRequester::wait_edge(const Address& address, WaitNumber number,
                                                   Timestamp since) {
  auto action = state(address);
  // Until it is accepted, anybody might execute it.
  if (action.executor.empty() || action.status == ActionStatus::over)
    return std::nullopt;
  WaitEdge result;
  result.kind = WaitEdge::Kind::owner;
  result.waiter = parts_.context.client();
  result.number = number;
  result.since = since;
  result.address = address;
  result.what = "waits for its action " + action.what.type;
  return result;
}

Failure ActionRequester::not_over(Failure failure, const Action& action) const {
  auto& what = action.what.type;
  auto& subarchitecture = action.subarchitecture;
  failure.address = {subarchitecture, {}};
  failure.message =
    "the action " + what + " of " + parts_.context.identity().full_name() +
    " is not over in time: " +
    (action.executor.empty()
       ? "no component of " + subarchitecture +
           " has accepted it. Does one of them call on_action<" + what + ">()?"
       : action.executor + " of " + subarchitecture + " executes it. Wait longer, or cancel it");
  return failure;
}

bool ActionRequester::wish(const Address& address, ActionWish wish) {
  for (;;) {
    auto action = state(address);
    auto is_proposed = action.status == ActionStatus::proposed;
    if (action.status == ActionStatus::over ||
        (!is_proposed && wish == ActionWish::cancel && !action.can_cancel) ||
        (!is_proposed && wish != ActionWish::cancel && !action.can_pause))
      return false;
    if (action.wish == wish)
      return true;
    action.wish = wish;
    try {
      if (is_proposed && wish == ActionWish::cancel)
        component_.write(
          WriteBatch{}
            .overwrite(address,
                       with_result(action, ActionResult::cancelled(
                                             "its requester cancelled it before it was accepted")),
                       life_of_outcome)
            .without_last_will());
      else
        component_.overwrite(address, action);
      return true;
    } catch (const ConsistencyException&) {
      // Its executor was faster.
    } catch (const DoesNotExistOnWM&) {
      return false;
    }
  }
}

// -- ends

void ActionRequester::release(const Address& address) noexcept {
  auto name = parts_.context.identity().full_name();
  try {
    try_release(address);
  } catch (const WorkingMemoryException& e) {
    log_runtime(LogLevel::debug, name, e.what());
  } catch (const ComponentStopped&) {
    // The next operation will say so. What the component owns goes with it.
  } catch (const InjectedCrash&) {
    // It comes again where it can be thrown.
  } catch (const std::exception& e) {
    log_runtime(LogLevel::warning, name, e.what());
  }
}

void ActionRequester::try_release(const Address& address) {
  auto i = requested_.find(address.id);
  if (i == requested_.end() || !parts_.client.is_running())
    return;
  auto& [state, is_over, is_released, since] = i->second;
  if (state.continues) {
    requested_.erase(i);
    return;
  }
  if (!is_over)
    wish(address, ActionWish::cancel);
  if (is_over)
    remove_entries(address);
  else
    is_released = true;
}

void ActionRequester::remove_entries(const Address& address) {
  auto requested = requested_.extract(address.id);
  if (!requested)
    return;
  for (auto& x : {address, requested.mapped().state.what.address})
    try {
      component_.delete_entry(x);
    } catch (const DoesNotExistOnWM&) {
      // Somebody else has tidied up.
    }
}

} // namespace castor
