#include "castor/actors/runtime/component_connections.hpp"

#include "castor/actors/component/option.hpp"
#include "castor/base/log.hpp"
#include "castor/base/plain_words.hpp"
#include "castor/base/suggestion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <string_view>

namespace castor {

/// Where the reply to a request arrives; gives it back at the end of its life.
class ComponentConnections::ReplySlot {
public:
  ReplySlot(PumpedActor& actor, std::uint64_t id) : actor_(actor), id_(id) {
    actor_.open_slot(id_);
  }
  ReplySlot(const ReplySlot&) = delete;
  ReplySlot& operator=(const ReplySlot&) = delete;
  ~ReplySlot() { actor_.close_slot(id_); }

  /// Null until it has arrived.
  const caf::mailbox_element_ptr& reply() const { return actor_.slot(id_); }

private:
  PumpedActor& actor_;
  std::uint64_t id_;
};

ComponentConnections::ComponentConnections(const Parts& parts) : parts_(parts) {
  parts_.context.on_neighbours([this](const Neighbours&) { renew_subscriptions(); });
}

// -- of one that provides

void ComponentConnections::provide(const TypeDescriptorPtr& type, std::function<Value()> make) {
  provisions_[type->name()].make = std::move(make);
}

void ComponentConnections::push(const Value& x) {
  // What was taken meanwhile makes room, also for a component that never waits.
  parts_.actor.file_arrived();
  auto& subscribers = provisions_[x.type_name()].subscribers;
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

void ComponentConnections::forget(const caf::actor_addr& subscriber) {
  for (auto& [type, provision] : provisions_)
    std::erase_if(provision.subscribers, [&](auto& x) { return x.actor == subscriber; });
}

void ComponentConnections::handle_pull(caf::mailbox_element& x, const PullRequest& request) {
  auto& self = parts_.context.identity().name;
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
      parts_.code.run("providing a " + i->first, [&] { outcome = i->second.make(); });
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
  provide(order.value.type_ptr(), [value = order.value] { return value; });
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
  provisions_[request.type->name()].subscribers.push_back(
    {actor, request.subscriber, PushFlow{request.limit}});
  parts_.actor.respond(x, caf::make_message(Outcome<Value>{Value{}}));
}

// -- of one that receives

caf::actor ComponentConnections::find_provider(const std::string& name) const {
  auto& neighbours = parts_.context.neighbours();
  if (auto i = neighbours.providers.find(name); i != neighbours.providers.end())
    return i->second;
  if (neighbours.known_providers.contains(name))
    return nullptr;
  std::vector<std::string_view> names;
  for (auto& [known, restarts] : neighbours.known_providers)
    names.push_back(known);
  auto guess = did_you_mean(name, names);
  throw ConnectionError(
    "there is no stand-alone component " + name + "; " +
    (guess.empty() ? "add a COMPONENT line for it to the system's .cast file" : guess));
}

caf::actor ComponentConnections::await_provider(const std::string& name,
                                                const caf::actor_addr& gone,
                                                const std::string& task,
                                                ComponentContext::Clock::time_point until) const {
  auto cannot = [&] { return "cannot " + task + " " + name + ": "; };
  auto& known = parts_.context.neighbours().known_providers;
  if (auto i = known.find(name); gone && i != known.end() && !i->second)
    throw ConnectionError(cannot() + "it has ended with no result, and is not started again");
  caf::actor result;
  auto failure = parts_.client.wait_until(
    [&] {
      result = find_provider(name);
      return result && result.address() != gone;
    },
    until, {});
  if (!failure)
    return result;
  if (failure->kind != FailureKind::no_answer)
    throw ConnectionError(cannot() + failure->message);
  throw ProviderDown(name, cannot() + name + " is down, and was not started again within " +
                             detail::print_option(parts_.context.deadline()) +
                             ". The --deadline of " + parts_.context.identity().full_name() +
                             " can be raised");
}

template <class Request>
ComponentConnections::Answer ComponentConnections::ask(const std::string& provider,
                                                       const Request& request,
                                                       const std::string& task) {
  auto until = ComponentContext::Clock::now() + parts_.context.deadline();
  for (caf::actor_addr gone;;) {
    auto actor = await_provider(provider, gone, task, until);
    const ReplySlot slot{parts_.actor,
                         parts_.actor.request(actor, caf::infinite, request).id().integer_value()};
    // If its process is lost, nobody answers.
    auto failure = parts_.client.wait_until(
      [&] { return slot.reply() || find_provider(provider) != actor; }, until, {});
    auto cannot = [&] { return "cannot " + task + " " + provider + ": "; };
    if (const auto& reply = slot.reply()) {
      auto& content = reply->content();
      bool has_ended = content.match_elements<caf::error>() &&
                       content.get_as<caf::error>(0) == caf::sec::request_receiver_down;
      if (!has_ended) {
        auto outcome = parts_.client.take<Outcome<Value>>(*reply, {provider, {}});
        if (!outcome)
          throw ConnectionError(cannot() + outcome.failure().message);
        return {std::move(actor), *std::move(outcome)};
      }
    } else if (failure) {
      throw ConnectionError(cannot() +
                            (failure->kind == FailureKind::no_answer
                               ? parts_.context.identity().full_name() + " got no answer within " +
                                   detail::print_option(parts_.context.deadline()) +
                                   ". Its --deadline can be raised"
                               : failure->message));
    }
    gone = actor.address();
  }
}

Value ComponentConnections::pull(const std::string& provider, const TypeDescriptorPtr& type) {
  return ask(provider, PullRequest{type}, "pull a " + type->name() + " from").value;
}

void ComponentConnections::subscribe(const std::string& provider, const TypeDescriptorPtr& type,
                                     std::function<void(const Value&)> callback) {
  auto known = receptions_.find({provider, type->name()});
  if (known == receptions_.end()) {
    auto limit = parts_.context.push_limit();
    auto actor =
      ask(provider, push_request(type), "receive pushes of " + type->name() + " from").provider;
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
  else if (content.match_elements<PushRequest>())
    handle_push_request(x, content.get_as<PushRequest>(0));
  else if (content.match_elements<Pushed>())
    handle_push(x, content.get_as<Pushed>(0));
  else if (content.match_elements<HandOut>())
    handle_hand_out(x, content.get_as<HandOut>(0));
  else
    return false;
  return true;
}

void ComponentConnections::clear() {
  provisions_.clear();
  receptions_.clear();
}

} // namespace castor
