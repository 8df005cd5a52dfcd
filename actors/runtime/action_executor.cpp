#include "castor/actors/runtime/action_executor.hpp"

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/runtime/action_execution.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/component_operations.hpp"
#include "castor/actors/runtime/inbox.hpp"
#include "castor/actors/runtime/neighbours.hpp"
#include "castor/actors/runtime/operations_client.hpp"
#include "castor/base/at_exit.hpp"
#include "castor/base/log.hpp"
#include "castor/base/plain_words.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

namespace {

constexpr std::string_view priority_field = "priority";

bool has_priorities(const TypeDescriptor& type) {
  try {
    return is_single(find_field(type, priority_field).type->kind);
  } catch (const FieldError&) {
    return false;
  }
}

} // namespace

const std::string& ActionExecutor::name() const {
  return parts_.context.identity().name;
}

const std::string& ActionExecutor::subarchitecture() const {
  return parts_.context.identity().subarchitecture;
}

// -- what is offered

void ActionExecutor::offer(const TypeDescriptor& type, ActionOffer offer,
                           Actions::Handler handler) {
  listen();
  auto& type_name = type.name();
  component_.add(
    ActionRegistration{name(), type_name, offer.preconditions, offer.can_pause, offer.can_cancel},
    EntryLife{.ephemeral = true});
  actions_.offer(type_name, offer.alongside);
  offered_[type_name] = {std::move(offer), std::move(handler), has_priorities(type)};
  parts_.operations.add_listener(
    added<Action>().anywhere().where(field(&Action::subarchitecture) == subarchitecture() &&
                                     field(&Action::what, &AnyEntryPointer::type) == type_name),
    [this, type_name](const ChangeEvent& event) {
      propose(event.address, type_name);
      work_later();
    });
  auto deletions = changes_by(Operation::remove).anywhere();
  deletions.type = type_name;
  parts_.operations.add_listener(
    deletions, [this](const ChangeEvent& event) { note_deletion(event.address); });
  // Some may have been waiting for somebody like this component.
  scan({type_name});
  work_later();
}

void ActionExecutor::listen() {
  if (std::exchange(listens_, true))
    return;
  parts_.operations.add_listener(
    changed<Action>().anywhere().where(field(&Action::subarchitecture) == subarchitecture() &&
                                       field(&Action::executor) == name()),
    [this](const ChangeEvent& event) { note_change(event); });
  parts_.context.on_neighbours([this](const Neighbours& before) {
    for (auto& lost : lost_working_memories(before, parts_.context.neighbours()))
      if (actions_.memory_lost(lost))
        wake_handler();
    // Of the entries that a working memory restores from its journal no event tells.
    parts_.inbox.put(Inbox::Task{"a look for actions", [this] {
                                   std::set<std::string> types;
                                   for (auto& [type, offered] : offered_)
                                     types.insert(type);
                                   write_pending_results();
                                   resolve_doubtful();
                                   scan(types);
                                   execute_next();
                                 }});
  });
}

void ActionExecutor::note_change(const ChangeEvent& event) {
  if (event.operation == Operation::remove)
    note_deletion(event.address);
  else if (event.source != name() && actions_.changed(event.address))
    wake_handler();
}

void ActionExecutor::note_deletion(const Address& entry) {
  if (actions_.deleted(entry))
    wake_handler();
}

void ActionExecutor::wake_handler() {
  parts_.inbox.put(Inbox::Task{"news of an action", [] {}});
}

void ActionExecutor::work_later() {
  parts_.inbox.put(Inbox::Task{"an action", [this] { execute_next(); }});
}

// -- what was asked for before

void ActionExecutor::scan(const std::set<std::string>& types) {
  // A copy: the neighbours may change while the component waits for an answer.
  auto working_memories = parts_.context.neighbours().working_memories;
  for (auto& [subarchitecture, working_memory] : working_memories)
    try {
      scan(subarchitecture, types);
    } catch (const WorkingMemoryException& e) {
      if (subarchitecture == this->subarchitecture())
        throw;
      log_runtime(LogLevel::debug, parts_.context.identity().full_name(), e.what());
    }
}

void ActionExecutor::scan(const std::string& where, const std::set<std::string>& types) {
  auto found =
    component_.read_where_in<Action>(where, field(&Action::subarchitecture) == subarchitecture() &&
                                              !(field(&Action::status) == ActionStatus::over));
  for (auto i = found.rbegin(); i != found.rend(); ++i) {
    if (types.count((*i)->what.type) > 0)
      take_up(i->address, **i);
  }
}

void ActionExecutor::take_up(const Address& address, const Action& action) {
  if (action.status == ActionStatus::proposed)
    propose(address, action.what.type);
  else if (action.executor == name() && !actions_.is_under_way(address) &&
           pending_results_.count(address) == 0)
    write_result(address, failed_by_end(action));
}

void ActionExecutor::resolve_doubtful() {
  for (auto& address : std::exchange(doubtful_, {}))
    try {
      take_up(address, *component_.read<Action>(address));
    } catch (const DoesNotExistOnWM&) {
      // Nobody wants it any more.
    } catch (const WorkingMemoryException& e) {
      if (e.address().subarchitecture == subarchitecture())
        throw;
      doubtful_.insert(address);
    }
}

void ActionExecutor::write_pending_results() {
  for (auto& [address, result] : std::exchange(pending_results_, {}))
    write_result(address, result);
}

void ActionExecutor::write_result(const Address& address, const Action& result) {
  try {
    auto there = component_.read<Action>(address);
    if (there->status != ActionStatus::over)
      component_.write(
        WriteBatch{}.overwrite(address, result, life_of_outcome).without_last_will());
  } catch (const ConsistencyException&) {
    pending_results_[address] = result;
  } catch (const DoesNotExistOnWM&) {
    // Nobody wants to know any more.
  } catch (const WorkingMemoryException& e) {
    if (e.address().subarchitecture == subarchitecture())
      throw;
    pending_results_[address] = result;
  }
}

// -- execution

void ActionExecutor::propose(const Address& address, const std::string& type) {
  actions_.propose(address, type);
  if (offered_.at(type).has_priorities)
    unranked_.push_back(address);
}

void ActionExecutor::prefer_high_priorities() {
  for (auto& address : std::exchange(unranked_, {}))
    if (has_high_priority(address))
      actions_.prefer(address);
}

bool ActionExecutor::has_high_priority(const Address& address) {
  try {
    auto action = component_.read<Action>(address);
    auto what = component_.read_entry(action->what.address)->value;
    auto place = find_field(what.type(), priority_field);
    return what.field(place.path) == FieldValue{"high"};
  } catch (const DoesNotExistOnWM&) {
    // Cancelled meanwhile.
  } catch (const FieldError&) {
    // The requester declares the type differently: the action will fail.
  } catch (const WorkingMemoryException& e) {
    if (e.address().subarchitecture == subarchitecture())
      throw;
    log_runtime(LogLevel::info, parts_.context.identity().full_name(), e.what());
  }
  return false;
}

void ActionExecutor::execute_next() {
  write_pending_results();
  resolve_doubtful();
  prefer_high_priorities();
  while (auto candidate = actions_.begin_next()) {
    execute(*candidate);
    prefer_high_priorities();
  }
}

void ActionExecutor::execute(const ExecutedActions::Candidate& candidate) {
  auto& address = candidate.action;
  AtExit finish{[&] { actions_.finish(address); }};
  auto action = accept(candidate);
  if (!action)
    return;
  actions_.set_specific_entry(address, action->what.address);
  ActionExecution execution{component_, parts_, actions_, address, *std::move(action)};
  auto result = handle(offered_.at(candidate.type), execution);
  if (!execution.finish(result))
    pending_results_[address] = with_result(execution.state(), result);
}

std::optional<Action> ActionExecutor::accept(const ExecutedActions::Candidate& candidate) {
  auto& address = candidate.action;
  auto& offer = offered_.at(candidate.type).offer;
  try {
    auto action = *component_.read<Action>(address);
    if (action.status != ActionStatus::proposed)
      return std::nullopt;
    action.status = ActionStatus::accepted;
    action.executor = name();
    action.can_pause = offer.can_pause;
    action.can_cancel = offer.can_cancel;
    component_.write(
      WriteBatch{}.overwrite(address, action).last_will(failed_by_end(action), life_of_outcome));
    return action;
  } catch (const DoesNotExistOnWM&) {
    // Cancelled before it was accepted.
  } catch (const ConsistencyException&) {
    // Another executor was faster.
  } catch (const WorkingMemoryException& e) {
    if (e.address().subarchitecture == subarchitecture())
      throw;
    doubtful_.insert(address);
    log_runtime(LogLevel::info, parts_.context.identity().full_name(), e.what());
  }
  return std::nullopt;
}

ActionResult ActionExecutor::handle(const Offered& offered, ActionExecution& execution) {
  Value what;
  try {
    what = component_.read_entry(execution.state().what.address)->value;
  } catch (const DoesNotExistOnWM&) {
    return ActionResult::cancelled("its requester had ended before it began");
  } catch (const WorkingMemoryException& e) {
    return ActionResult::failed(e.what());
  }
  ActionResult result;
  try {
    execution.begin();
    parts_.client.note_execution(what.type_name(), execution.address());
    result = offered.handler(execution, what);
  } catch (const std::exception& e) {
    result = ActionResult::failed(plain_words(e));
  }
  if (execution.state().continues)
    expire_specific_entry(execution.state(), what);
  return result;
}

void ActionExecutor::expire_specific_entry(const Action& action, const Value& what) {
  try {
    component_.write(WriteBatch{}.overwrite_value(action.what.address, what, life_of_outcome));
  } catch (const WorkingMemoryException& e) {
    log_runtime(LogLevel::debug, parts_.context.identity().full_name(), e.what());
  }
}

} // namespace castor
