#include "castor/actors/runtime/component_connections.hpp"

#include "castor/base/log.hpp"
#include "castor/base/plain_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>

namespace castor {

ComponentConnections::ComponentConnections(const Parts& parts) : parts_(parts) {
  parts_.context.on_neighbours([this](const Neighbours&) { renew_subscriptions(); });
}

// -- of one that provides

void ComponentConnections::provide(Provision provision) {
  auto& provisions = offers_[provision.type->name()].provisions;
  std::erase_if(provisions, [&](auto& x) {
    return !x.argument_type == !provision.argument_type &&
           (!x.argument_type || x.argument_type->name() == provision.argument_type->name());
  });
  provisions.push_back(std::move(provision));
}

void ComponentConnections::push(const Value& x) {
  // What was taken meanwhile makes room, also for a component that never waits.
  parts_.actor.file_arrived();
  auto& subscribers = offers_[x.type_name()].subscribers;
  // What nobody gets to see is not recorded.
  if (!subscribers.empty())
    record(true, x);
  for (auto& to : subscribers) {
    auto dropped = to.flow.dropped();
    if (auto now = to.flow.push(x)) {
      send(to, *std::move(now));
    } else if (to.flow.dropped() > dropped) {
      ++parts_.context.counters().pushes_dropped;
      if (dropped == 0)
        log_runtime(
          LogLevel::warning, parts_.context.identity().full_name(),
          fmt::format("{} does not keep up with the {}s that are pushed: of more than {} that it "
                      "has not taken, the oldest are dropped. Its --push-limit can be raised",
                      to.name, x.type_name(), to.flow.limit()));
    }
  }
}

void ComponentConnections::send(const Subscriber& to, Value x) {
  parts_.actor.send(to.actor, Pushed{parts_.context.identity().name, std::move(x)});
}

void ComponentConnections::taken(const caf::strong_actor_ptr& subscriber, const PushesTaken& x) {
  auto offer = offers_.find(x.type);
  if (offer == offers_.end())
    return;
  for (auto& to : offer->second.subscribers) {
    if (to.actor != subscriber)
      continue;
    to.flow.acknowledge(x.count);
    while (auto next = to.flow.next())
      send(to, *std::move(next));
  }
}

void ComponentConnections::forget(const caf::actor_addr& subscriber) {
  for (auto& [type, offer] : offers_)
    std::erase_if(offer.subscribers, [&](auto& x) { return x.actor == subscriber; });
}

std::string ComponentConnections::list_provisions() const {
  std::string result;
  for (auto& [type, offer] : offers_)
    for (auto& x : offer.provisions)
      result += (result.empty() ? "" : ", ") + type +
                (x.argument_type ? " with an argument " + x.argument_type->name() : "");
  return result.empty() ? "nothing" : result;
}

Provision* ComponentConnections::find_provision(const std::string& type,
                                                const TypeDescriptor* argument) {
  auto offer = offers_.find(type);
  if (offer == offers_.end())
    return nullptr;
  for (auto& x : offer->second.provisions)
    if (argument ? x.argument_type && *x.argument_type == *argument : !x.argument_type)
      return &x;
  return nullptr;
}

void ComponentConnections::handle_pull(caf::mailbox_element& x, const PullRequest& request) {
  auto& self = parts_.context.identity().name;
  auto& argument = request.argument;
  auto* provision =
    find_provision(request.type->name(), argument.has_value() ? &argument.type() : nullptr);
  Outcome<Value> outcome;
  if (!provision) {
    outcome = Failure{FailureKind::wrong_type, self + " provides " + list_provisions(), {self, {}}};
  } else {
    try {
      parts_.code.run("providing a " + request.type->name(),
                      [&] { outcome = provision->make(argument); });
      record(false, *outcome);
    } catch (const std::exception& e) {
      // Who pulls must learn of it too.
      outcome = Failure{FailureKind::no_answer, plain_words(e), {self, {}}};
      parts_.actor.respond(x, caf::make_message(std::move(outcome)));
      throw;
    }
  }
  parts_.actor.respond(x, caf::make_message(std::move(outcome)));
}

void ComponentConnections::record(bool pushed, const Value& x) {
  if (auto& recorder = parts_.context.services().pushes)
    recorder->record(parts_.context.identity().name, pushed, x);
}

void ComponentConnections::handle_hand_out(caf::mailbox_element& x, const HandOut& order) {
  provide({order.value.type_ptr(), nullptr, [value = order.value](const Value&) { return value; }});
  if (order.push)
    push(order.value);
  parts_.actor.respond(x, caf::make_message(Acknowledged{}));
}

void ComponentConnections::handle_push_request(caf::mailbox_element& x,
                                               const PushRequest& request) {
  if (!x.sender)
    return;
  auto actor = caf::actor_cast<caf::actor>(x.sender);
  parts_.actor.monitor(actor);
  offers_[request.type->name()].subscribers.push_back(
    {actor, request.subscriber, PushFlow{request.limit}});
  parts_.actor.respond(x, caf::make_message(Outcome<Value>{Value{}}));
}

// -- of one that receives

Value ComponentConnections::pull(const std::string& provider, const TypeDescriptorPtr& type,
                                 const Value& argument) {
  return parts_.providers
    .ask<Value>(provider, PullRequest{type, argument}, "pull a " + type->name() + " from")
    .reply;
}

void ComponentConnections::subscribe(const std::string& provider, const TypeDescriptorPtr& type,
                                     std::function<void(const Value&)> callback) {
  auto known = receptions_.find({provider, type->name()});
  if (known == receptions_.end()) {
    auto limit = parts_.context.push_limit();
    auto actor =
      parts_.providers
        .ask<Value>(provider, push_request(type), "receive pushes of " + type->name() + " from")
        .provider;
    known =
      receptions_
        .emplace(std::pair{provider, type->name()}, Reception{type, actor, {}, Receipts{limit}})
        .first;
  }
  known->second.callbacks.push_back(std::move(callback));
}

PushRequest ComponentConnections::push_request(const TypeDescriptorPtr& type) const {
  return {type, parts_.context.push_limit(), parts_.context.identity().full_name()};
}

void ComponentConnections::renew_subscriptions() {
  auto& providers = parts_.context.neighbours().providers;
  for (auto& [key, reception] : receptions_) {
    auto i = providers.find(key.first);
    if (i == providers.end() || i->second == reception.provider)
      continue;
    reception.provider = i->second;
    reception.receipts = Receipts{parts_.context.push_limit()};
    parts_.actor.send(reception.provider, push_request(reception.type));
  }
}

void ComponentConnections::handle_push(const caf::mailbox_element& x, const Pushed& pushed) {
  auto i = receptions_.find({pushed.provider, pushed.value.type_name()});
  if (i == receptions_.end())
    return;
  auto& reception = i->second;
  if (auto count = reception.receipts.take())
    parts_.actor.send(caf::actor_cast<caf::actor>(x.sender), PushesTaken{i->first.second, count});
  // A callback may add others, for later pushes.
  auto callbacks = reception.callbacks.size();
  for (std::size_t n = 0; n < callbacks; ++n) {
    auto callback = reception.callbacks[n];
    parts_.code.run_callback("the callback for a " + i->first.second + " of " + pushed.provider,
                             [&] { callback(pushed.value); });
  }
}

// --

bool ComponentConnections::handle(caf::mailbox_element& x) {
  auto& content = x.content();
  if (content.match_elements<PullRequest>())
    handle_pull(x, content.get_as<PullRequest>(0));
  else if (content.match_elements<Pushed>())
    handle_push(x, content.get_as<Pushed>(0));
  else if (content.match_elements<HandOut>())
    handle_hand_out(x, content.get_as<HandOut>(0));
  else
    return false;
  return true;
}

void ComponentConnections::clear() {
  offers_.clear();
  receptions_.clear();
}

} // namespace castor
