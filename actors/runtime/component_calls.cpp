#include "castor/actors/runtime/component_calls.hpp"

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/base/plain_words.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace castor {

namespace {

constexpr const char* progress_suffix = ":progress";
constexpr const char* reply_suffix = ":reply";
constexpr EntryLife with_its_writer{.ephemeral = true};
/// Of two servers that take a call the second is refused, even if the first has ended since.
constexpr EntryLife first_claim{.ephemeral = true, .only_once = true};

} // namespace

// -- the calling side

Value ComponentCalls::call(const std::string& subarchitecture, const Value& request,
                           const TypeDescriptor& reply_type, const CallOptions& options) {
  listen_to(subarchitecture);
  auto until = ComponentContext::Clock::now() + options.timeout.value_or(parts_.context.deadline());
  for (int attempt = 0;; ++attempt) {
    Made made{component_.here(component_.new_id()), component_.here(component_.new_id())};
    // Its progress may be heard of before the write that makes it has returned.
    auto& open = open_[made.call.id];
    // The wait is older than all that serving the call may have to wait for.
    open.since = parts_.context.now();
    std::optional<Value> reply;
    try {
      make(made, subarchitecture, request, reply_type);
      reply = await_reply(subarchitecture, made, request, open, until);
    } catch (...) {
      open_.erase(made.call.id);
      cancel(made);
      throw;
    }
    open_.erase(made.call.id);
    cancel(made);
    if (reply)
      return *std::move(reply);
    if (attempt >= options.retries)
      throw CallException{{FailureKind::call_failed,
                           "the component of " + subarchitecture + " that served the " +
                             request.type_name() + " of " + parts_.context.identity().full_name() +
                             " ended while it worked on it. A call that may be served twice can "
                             "be given retries",
                           made.call}};
  }
}

void ComponentCalls::listen_to(const std::string& subarchitecture) {
  if (!listened_to_.insert(subarchitecture).second)
    return;
  parts_.operations.add_listener(changed<CallProgress>()
                                   .in(subarchitecture)
                                   .where(&CallProgress::caller, parts_.context.identity().name),
                                 [this](const ChangeEvent& event) { note_progress(event); });
}

void ComponentCalls::note_progress(const ChangeEvent& event) {
  auto& id = event.address.id;
  auto i = open_.find(id.substr(0, id.rfind(progress_suffix)));
  if (i == open_.end())
    return;
  i->second.taken = true;
  if (event.operation == Operation::remove)
    i->second.settled = i->second.server_ended = true;
  // An ADD that is coalesced stands for the overwrite, too.
  else if (event.operation == Operation::overwrite || event.coalesced)
    i->second.settled = true;
}

void ComponentCalls::make(const Made& made, const std::string& subarchitecture,
                          const Value& request, const TypeDescriptor& reply_type) {
  component_.write(WriteBatch{}
                     .add_value(made.request, request, with_its_writer)
                     .add(made.call,
                          Call{subarchitecture, request.type_name(), reply_type.name(),
                               made.request, parts_.context.identity().name},
                          with_its_writer));
}

void ComponentCalls::cancel(const Made& made) {
  // If the component stops now, its entries go with it.
  if (!parts_.client.is_running())
    return;
  try {
    component_.write(WriteBatch{}.delete_entry(made.call).delete_entry(made.request));
  } catch (const WorkingMemoryException& e) {
    log_runtime(LogLevel::debug, parts_.context.identity().full_name(), e.what());
  } catch (const ComponentStopped&) {
    // The next operation will say so.
  }
}

std::optional<Value> ComponentCalls::await_reply(const std::string& subarchitecture,
                                                 const Made& made, const Value& request,
                                                 const Open& open,
                                                 std::chrono::steady_clock::time_point until) {
  WaitEdge wait;
  wait.kind = WaitEdge::Kind::owner;
  wait.waiter = parts_.context.client();
  wait.number = parts_.client.patience({}).number;
  wait.since = open.since;
  wait.what = "waits for a reply to its " + request.type_name();
  auto failure = parts_.client.wait_until([&] { return open.settled; }, until,
                                          [&]() -> std::optional<WaitEdge> {
                                            auto address = obstacle(subarchitecture, made,
                                                                    request.type_name(), open);
                                            if (!address)
                                              return std::nullopt;
                                            wait.address = *address;
                                            return wait;
                                          });
  if (failure)
    throw_failure(not_served(*failure, subarchitecture, request.type_name(), open));
  if (open.server_ended)
    return std::nullopt;
  try {
    auto progress =
      component_.read<CallProgress>({subarchitecture, made.call.id + progress_suffix});
    if (progress->state == CallState::done)
      return component_.read_entry(progress->reply)->value;
    throw CallException{{FailureKind::call_failed,
                         progress->server + " of " + subarchitecture + " could not serve the " +
                           request.type_name() + " of " + parts_.context.identity().full_name() +
                           ": " + progress->error,
                         made.call}};
  } catch (const DoesNotExistOnWM&) {
    return std::nullopt; // it ended after all, and took its answer along
  }
}

Failure ComponentCalls::not_served(Failure failure, const std::string& subarchitecture,
                                   const std::string& request_type, const Open& open) {
  failure.address = {subarchitecture, {}};
  if (failure.kind == FailureKind::no_answer)
    failure.message =
      parts_.context.identity().full_name() + " got no reply to its " + request_type +
      " in time: " +
      (open.taken ? "a component of " + subarchitecture + " is still at work on it"
                  : "no component of " + subarchitecture +
                      " took it. Does one of them call on_call<" + request_type + ">()?");
  return failure;
}

std::optional<Address> ComponentCalls::obstacle(const std::string& subarchitecture,
                                                const Made& made, const std::string& request_type,
                                                const Open& open) {
  if (open.taken)
    return Address{subarchitecture, made.call.id + progress_suffix};
  // Whoever could take it is in the way, if there is only one.
  std::optional<Address> result;
  for (auto& server : component_.read_all_in<CallServer>(subarchitecture)) {
    if (server->request_type != request_type)
      continue;
    if (result)
      return std::nullopt;
    result = server.address;
  }
  return result;
}

// -- the serving side

void ComponentCalls::serve(const TypeDescriptor& request_type, const TypeDescriptor& reply_type,
                           Handler handler) {
  listen_for_ends();
  auto& subarchitecture = parts_.context.identity().subarchitecture;
  auto mine = field(&Call::subarchitecture) == subarchitecture &&
              field(&Call::request_type) == request_type.name();
  component_.add(CallServer{parts_.context.identity().name, request_type.name(), reply_type.name()},
                 with_its_writer);
  component_.on_change(added<Call>().anywhere().where(mine),
                       [this, handler](const ChangeEvent& event) { take(event.address, handler); });
  // Some may have been waiting for somebody like this component. The neighbours may change while it
  // waits for an answer.
  auto working_memories = parts_.context.neighbours().working_memories;
  for (auto& [name, working_memory] : working_memories) {
    auto waiting = component_.read_where_in<Call>(name, mine);
    std::for_each(waiting.rbegin(), waiting.rend(),
                  [&](auto& call) { take(call.address, handler); });
  }
}

void ComponentCalls::listen_for_ends() {
  if (std::exchange(serving_, true))
    return;
  auto gone = deleted<Call>().anywhere().where(&Call::subarchitecture,
                                               parts_.context.identity().subarchitecture);
  parts_.operations.add_listener(gone, [this](const ChangeEvent& event) {
    served_.deleted(event.address);
    clean_up_later();
  });
  parts_.context.on_neighbours([this](const Neighbours& before) {
    for (auto& subarchitecture : lost_working_memories(before, parts_.context.neighbours()))
      served_.memory_lost(subarchitecture);
    clean_up_later();
  });
}

void ComponentCalls::take(const Address& call_at, const Handler& handler) {
  if (!served_.begin(call_at))
    return;
  auto call = claim(call_at);
  if (!call)
    return served_.abandon(call_at);
  answer(call_at, *call, handler);
  served_.finish(call_at);
  clean_up();
}

std::shared_ptr<const Call> ComponentCalls::claim(const Address& call_at) {
  try {
    auto call = component_.read<Call>(call_at).object;
    component_.add(
      progress_of(call_at),
      CallProgress{call_at, call->caller, parts_.context.identity().name, CallState::taken, {}, {}},
      first_claim);
    return call;
  } catch (const DoesNotExistOnWM&) {
    // Taken back before it was taken.
  } catch (const AlreadyExistsOnWM&) {
    // Another server was faster.
  } catch (const WorkingMemoryLostException&) {
    // Its caller's, with the call; or the own one, of which the next operation tells.
  }
  return nullptr;
}

void ComponentCalls::answer(const Address& call_at, const Call& call, const Handler& handler) {
  auto outer = std::exchange(current_, call_at);
  CallProgress progress{call_at,         call.caller, parts_.context.identity().name,
                        CallState::done, {},          {}};
  try {
    auto reply = handler(component_.read_entry(call.request)->value);
    progress.reply = component_.here(call_at.id + reply_suffix);
    component_.write(WriteBatch{}
                       .add_value(progress.reply, reply, with_its_writer)
                       .overwrite(progress_of(call_at), progress));
  } catch (const std::exception& e) {
    progress.state = CallState::failed;
    progress.reply = {};
    progress.error = plain_words(e);
    // Operators can delete it.
    if (component_.exists(progress_of(call_at)))
      component_.overwrite(progress_of(call_at), progress);
  }
  current_ = outer;
}

/// Not at once: operations would have to wait for their answers in the middle of other operations.
void ComponentCalls::clean_up_later() {
  parts_.inbox.put(Inbox::Task{"the end of a call", [this] { clean_up(); }});
}

void ComponentCalls::clean_up() {
  for (auto& call_at : served_.take_ended())
    for (auto& address : {progress_of(call_at), component_.here(call_at.id + reply_suffix)})
      if (component_.exists(address))
        component_.delete_entry(address);
}

Address ComponentCalls::progress_of(const Address& call) const {
  return component_.here(call.id + progress_suffix);
}

} // namespace castor
