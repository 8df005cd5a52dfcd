#include "castor/actors/component/connections.hpp"

#include "castor/actors/cast/suggestion.hpp"
#include "castor/actors/component/shell.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <string_view>

namespace castor {

// -- of one that provides

void Connections::provide(const TypeDescriptorPtr& type, std::function<Value()> make) {
  provisions_[type->name()].make = std::move(make);
}

void Connections::push(const Value& x) {
  // What was taken meanwhile makes room, also for a component that never waits.
  shell_.file_arrived();
  auto& subscribers = provisions_[x.type_name()].subscribers;
  // What nobody gets to see is not recorded.
  if (!subscribers.empty())
    record(true, x);
  for (auto& to : subscribers) {
    auto dropped = to.flow.dropped();
    if (auto now = to.flow.push(x)) {
      send(to, *std::move(now));
    } else if (to.flow.dropped() > dropped) {
      ++shell_.counters().pushes_dropped;
      if (dropped == 0)
        note(
          LogLevel::warning, shell_.identity().full_name(),
          fmt::format("{} does not keep up with the {}s that are pushed: of more than {} that it "
                      "has not taken, the oldest are dropped. Its --push-limit can be raised",
                      to.name, x.type_name(), to.flow.limit()));
    }
  }
}

void Connections::send(const Subscriber& to, Value x) {
  shell_.send(to.actor, Pushed{shell_.identity().name, std::move(x)});
}

void Connections::taken(const caf::strong_actor_ptr& subscriber, const PushesTaken& x) {
  auto provision = provisions_.find(x.type);
  if (provision == provisions_.end())
    return;
  for (auto& to : provision->second.subscribers) {
    if (to.actor != subscriber)
      continue;
    to.flow.acknowledge(x.count);
    while (auto next = to.flow.next())
      send(to, *std::move(next));
  }
}

void Connections::forget(const caf::actor_addr& subscriber) {
  for (auto& [type, provision] : provisions_)
    std::erase_if(provision.subscribers, [&](auto& x) { return x.actor == subscriber; });
}

void Connections::work_off_pull(caf::mailbox_element& x, const PullRequest& request) {
  auto& self = shell_.identity().name;
  auto i = provisions_.find(request.type->name());
  Outcome<Value> outcome;
  if (i == provisions_.end() || !i->second.make) {
    std::string offered;
    for (auto& [type, provision] : provisions_)
      offered += (offered.empty() ? "" : ", ") + type;
    outcome = Failure{FailureKind::wrong_type,
                      self + " provides " + (offered.empty() ? "nothing" : offered),
                      {self, {}}};
  } else {
    try {
      shell_.user_code("providing a " + i->first, [&] { outcome = i->second.make(); });
      record(false, *outcome);
    } catch (const std::exception& e) {
      // Who pulls must learn of it too.
      outcome = Failure{FailureKind::no_answer, e.what(), {self, {}}};
      shell_.respond(x, caf::make_message(std::move(outcome)));
      throw;
    }
  }
  shell_.respond(x, caf::make_message(std::move(outcome)));
}

void Connections::record(bool pushed, const Value& x) {
  if (auto& recorder = shell_.services().pushes)
    recorder->record(shell_.identity().name, pushed, x);
}

void Connections::work_off_hand_out(caf::mailbox_element& x, const HandOut& order) {
  provide(order.value.type_ptr(), [value = order.value] { return value; });
  if (order.push)
    push(order.value);
  shell_.respond(x, caf::make_message(Acknowledged{}));
}

void Connections::work_off_push_request(caf::mailbox_element& x, const PushRequest& request) {
  if (!x.sender)
    return;
  auto actor = caf::actor_cast<caf::actor>(x.sender);
  shell_.monitor(actor);
  provisions_[request.type->name()].subscribers.push_back(
    {actor, request.subscriber, PushFlow{request.limit}});
  shell_.respond(x, caf::make_message(Outcome<Value>{Value{}}));
}

// -- of one that receives

caf::actor Connections::find_provider(const std::string& name) const {
  auto& providers = shell_.neighbours().providers;
  auto i = providers.find(name);
  if (i != providers.end())
    return i->second;
  std::vector<std::string_view> names;
  for (auto& [known, actor] : providers)
    names.push_back(known);
  auto guess = cast::did_you_mean(name, names);
  throw ConnectionError(
    "there is no stand-alone component " + name + "; " +
    (guess.empty() ? "add a COMPONENT line for it to the system's .cast file" : guess));
}

Outcome<Value> Connections::ask(const std::string& provider, std::uint64_t id) {
  shell_.open_slot(id);
  return shell_.finish<Value>(id, {provider, {}});
}

Value Connections::pull(const std::string& provider, const TypeDescriptorPtr& type) {
  auto actor = find_provider(provider);
  auto id = shell_.request(actor, caf::infinite, PullRequest{type}).id().integer_value();
  auto outcome = ask(provider, id);
  if (!outcome)
    throw ConnectionError("cannot pull a " + type->name() + " from " + provider + ": " +
                          outcome.failure().message);
  return *std::move(outcome);
}

void Connections::subscribe(const std::string& provider, const TypeDescriptorPtr& type,
                            std::function<void(const Value&)> callback) {
  auto limit = shell_.push_limit();
  auto known = receptions_.find({provider, type->name()});
  if (known == receptions_.end()) {
    auto actor = find_provider(provider);
    auto id = shell_.request(actor, caf::infinite, push_request(type)).id().integer_value();
    auto outcome = ask(provider, id);
    if (!outcome)
      throw ConnectionError("cannot receive pushes of " + type->name() + " from " + provider +
                            ": " + outcome.failure().message);
    known =
      receptions_
        .emplace(std::pair{provider, type->name()}, Reception{type, actor, {}, Receipts{limit}})
        .first;
  }
  known->second.callbacks.push_back(std::move(callback));
}

PushRequest Connections::push_request(const TypeDescriptorPtr& type) const {
  return {type, shell_.push_limit(), shell_.identity().full_name()};
}

void Connections::meet() {
  auto& providers = shell_.neighbours().providers;
  for (auto& [key, reception] : receptions_) {
    auto i = providers.find(key.first);
    if (i == providers.end() || i->second == reception.provider)
      continue;
    reception.provider = i->second;
    reception.receipts = Receipts{shell_.push_limit()};
    shell_.send(reception.provider, push_request(reception.type));
  }
}

void Connections::work_off_push(const caf::mailbox_element& x, const Pushed& pushed) {
  auto i = receptions_.find({pushed.provider, pushed.value.type_name()});
  if (i == receptions_.end())
    return;
  auto& reception = i->second;
  if (auto count = reception.receipts.take())
    shell_.send(caf::actor_cast<caf::actor>(x.sender), PushesTaken{i->first.second, count});
  // A callback may add others, for later pushes.
  auto callbacks = reception.callbacks.size();
  for (std::size_t n = 0; n < callbacks; ++n) {
    auto callback = reception.callbacks[n];
    shell_.user_code("the callback for a " + i->first.second + " of " + pushed.provider, [&] {
      shell_.begin_callback();
      callback(pushed.value);
    });
  }
}

// --

bool Connections::work_off(caf::mailbox_element& x) {
  auto& content = x.content();
  if (content.match_elements<PullRequest>())
    work_off_pull(x, content.get_as<PullRequest>(0));
  else if (content.match_elements<PushRequest>())
    work_off_push_request(x, content.get_as<PushRequest>(0));
  else if (content.match_elements<Pushed>())
    work_off_push(x, content.get_as<Pushed>(0));
  else if (content.match_elements<HandOut>())
    work_off_hand_out(x, content.get_as<HandOut>(0));
  else
    return false;
  return true;
}

void Connections::clear() {
  provisions_.clear();
  receptions_.clear();
}

} // namespace castor
