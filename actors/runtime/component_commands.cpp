#include "castor/actors/runtime/component_commands.hpp"

#include "castor/actors/component/stand_in.hpp"
#include "castor/base/log.hpp"
#include "castor/base/plain_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

namespace castor {

namespace {

/// An effector's clock, as its commanders are told it.
Timestamp reading(ComponentCommands::Clock::time_point x) {
  return std::chrono::duration_cast<Timestamp>(x.time_since_epoch());
}

ComponentCommands::Clock::time_point from_reading(Timestamp x) {
  return ComponentCommands::Clock::time_point{x};
}

std::string command_of(const std::string& type) {
  return "the command " + type;
}

} // namespace

ComponentCommands::ComponentCommands(const Parts& parts) : parts_(parts) {
  if (auto& log = parts.context.services().operations)
    recorder_.emplace(*log, parts.context.client());
}

// -- effector

void ComponentCommands::obey(CommandHandler handler) {
  if (handler.terms.valid_for <= Timestamp{0} || handler.terms.valid_for > longest_command_time)
    throw std::invalid_argument("commands of the type " + handler.type->name() +
                                " have to be valid for more than 0 s and less than 100 years");
  auto type = handler.type->name();
  CommandGate gate{parts_.context.identity().name, handler.terms};
  if (!obediences_.emplace(type, Obedience{std::move(handler), std::move(gate), {}}).second)
    throw std::logic_error("on_command<" + type + "> was called twice");
}

bool ComponentCommands::handle(caf::mailbox_element& x) {
  auto& content = x.content();
  if (content.match_elements<CommandMessage>())
    handle_command(x, content.get_as<CommandMessage>(0));
  else if (content.match_elements<CommandTermsQuery>())
    handle_terms_query(x, content.get_as<CommandTermsQuery>(0));
  else
    return false;
  return true;
}

void ComponentCommands::handle_terms_query(caf::mailbox_element& x,
                                           const CommandTermsQuery& query) {
  auto& self = parts_.context.identity().name;
  auto i = obediences_.find(query.type->name());
  Outcome<CommandTermsReply> result;
  if (i != obediences_.end()) {
    result = CommandTermsReply{i->second.gate.terms(), reading(parts_.context.time_point())};
  } else if (is_stand_in(parts_.context.identity())) {
    result = CommandTermsReply{CommandTerms{}, reading(parts_.context.time_point())};
  } else {
    std::string types;
    for (auto& [type, obedience] : obediences_)
      types += (types.empty() ? "" : ", ") + type;
    result =
      Failure{FailureKind::wrong_type,
              self + " obeys " + (types.empty() ? "no commands" : "commands of the type " + types),
              {self, {}}};
  }
  parts_.actor.respond(x, caf::make_message(std::move(result)));
}

void ComponentCommands::handle_command(caf::mailbox_element& x, const CommandMessage& message) {
  const Requester requester{x.sender, x.mid, message.number};
  if (is_stand_in(parts_.context.identity()))
    return reply(requester, message.value.type_name(), CommandResult::obeyed, {});
  auto i = obediences_.find(message.value.type_name());
  if (i == obediences_.end() || message.value.type() != *i->second.handler.type)
    return reply(requester, message.value.type_name(), CommandResult::refused,
                 parts_.context.identity().name + " obeys no commands of this type");
  if (x.sender) {
    auto commander = caf::actor_cast<caf::actor>(x.sender);
    if (commanders_.emplace(commander.address(), message.commander).second)
      parts_.actor.monitor(commander);
  }
  auto& obedience = i->second;
  auto ticket = ++last_ticket_;
  obedience.requesters.emplace(ticket, requester);
  obedience.gate.offer({ticket, message.commander, message.token, from_reading(message.sent),
                        message.valid_for, message.value},
                       parts_.context.time_point());
  decide(obedience);
}

void ComponentCommands::decide(Obedience& obedience) {
  while (auto x = obedience.gate.decide(parts_.context.time_point())) {
    if (x->refusal.empty())
      carry_out(obedience, x->offer);
    else
      reply(obedience, x->offer.ticket, CommandResult::refused, std::move(x->refusal));
  }
}

void ComponentCommands::carry_out(Obedience& obedience, const CommandGate::Offer& x) {
  publish();
  auto& lease = obedience.gate.terms().lease;
  if (recorder_)
    recorder_->obeys(x.value.type_name(), *x.commander, x.token, lease ? &*lease : nullptr);
  try {
    parts_.code.run_callback(command_of(x.value.type_name()) + " of " + to_string(*x.commander),
                             [&] { obedience.handler.obey(x.value); });
  } catch (const std::exception& e) {
    // The commander must learn of it too.
    reply(obedience, x.ticket, CommandResult::failed, plain_words(e));
    throw;
  }
  reply(obedience, x.ticket, CommandResult::obeyed, {});
}

void ComponentCommands::reply(Obedience& obedience, std::uint64_t ticket, CommandResult result,
                              std::string reason) {
  if (auto x = obedience.requesters.extract(ticket))
    reply(x.mapped(), obedience.handler.type->name(), result, std::move(reason));
}

void ComponentCommands::reply(const Requester& to, const std::string& type, CommandResult result,
                              std::string reason) {
  CommandDone done{parts_.context.identity().name,      type, to.number, result, std::move(reason),
                   reading(parts_.context.time_point())};
  if (to.request.is_request())
    parts_.actor.respond(to.actor, to.request,
                         caf::make_message(Outcome<CommandDone>{std::move(done)}));
  else if (to.actor)
    parts_.actor.send(caf::actor_cast<caf::actor>(to.actor), std::move(done));
}

void ComponentCommands::confirm_lease(Obedience& obedience) {
  auto now = parts_.context.time_point();
  auto& entry = *obedience.gate.terms().lease;
  auto& memories = parts_.context.neighbours().working_memories;
  auto memory = memories.find(entry.subarchitecture);
  if (memory == memories.end())
    return obedience.gate.cannot_confirm(
      "there is no working memory " + entry.subarchitecture + " now", now);
  auto id =
    parts_.actor.request(memory->second, caf::infinite, LockQuery{entry}).id().integer_value();
  auto note = [this, type = obedience.handler.type->name(), now,
               name = entry.subarchitecture](caf::mailbox_element& x) {
    auto& content = x.content();
    Outcome<LockStatus> status = Failure{
      FailureKind::working_memory_lost, "the working memory of " + name + " has ended", {name, {}}};
    if (content.match_elements<Outcome<LockStatus>>())
      status = content.get_as<Outcome<LockStatus>>(0);
    answers_.push_back({type, now, std::move(status)});
  };
  parts_.actor.on_reply(id, std::move(note));
}

void ComponentCommands::work() {
  if (obediences_.empty())
    return;
  while (!answers_.empty()) {
    auto [type, asked, status] = std::move(answers_.front());
    answers_.pop_front();
    auto& obedience = obediences_.at(type);
    if (status)
      obedience.gate.confirm({asked, status->token, status->holder});
    else
      obedience.gate.cannot_confirm(status.failure().message, parts_.context.time_point());
  }
  for (auto& [type, obedience] : obediences_) {
    decide(obedience);
    if (auto cause = obedience.gate.take_safe_state(parts_.context.time_point()))
      take_safe_state(obedience, *cause);
    if (obedience.gate.should_ask(parts_.context.time_point()))
      confirm_lease(obedience);
    decide(obedience);
  }
}

ComponentCommands::Clock::time_point ComponentCommands::next_alarm() const {
  if (!answers_.empty())
    return parts_.context.time_point();
  auto result = Clock::time_point::max();
  for (auto& [type, obedience] : obediences_)
    if (auto x = obedience.gate.next_alarm())
      result = std::min(result, *x);
  return result;
}

void ComponentCommands::take_safe_state(Obedience& obedience, SafeStateCause cause) {
  publish();
  log_runtime(cause == SafeStateCause::lease_unconfirmed ? LogLevel::warning : LogLevel::debug,
              parts_.context.identity().full_name(),
              fmt::format("takes the safe state of {}: {}", obedience.handler.type->name(),
                          to_string(cause)));
  parts_.code.run_callback("the safe state of " + obedience.handler.type->name(),
                           obedience.handler.take_safe_state);
  if (recorder_)
    recorder_->rests(obedience.handler.type->name());
}

void ComponentCommands::take_safe_states() {
  for (auto& [type, obedience] : obediences_)
    if (obedience.gate.release())
      take_safe_state(obedience, SafeStateCause::effector_ends);
}

void ComponentCommands::publish() {
  std::string result;
  for (auto& [type, obedience] : obediences_) {
    auto& x = obedience.gate.in_force();
    if (x)
      result += (result.empty() ? "" : ", ") + to_string(*x->commander);
  }
  parts_.context.record().set_obeyed(std::move(result));
}

void ComponentCommands::forget(const caf::actor_addr& commander) {
  auto i = commanders_.find(commander);
  if (i == commanders_.end())
    return;
  for (auto& [type, obedience] : obediences_) {
    obedience.gate.forget(*i->second);
    std::erase_if(obedience.requesters, [&](auto& x) { return x.second.actor == commander; });
  }
  commanders_.erase(i);
}

// -- commander

ComponentCommands::Effector& ComponentCommands::connect(const std::string& name,
                                                        const TypeDescriptorPtr& type) {
  auto& result = effectors_[{name, type->name()}];
  if (result.actor && result.actor == parts_.providers.find(name))
    return result;
  auto [actor, reply] = parts_.providers.ask<CommandTermsReply>(name, CommandTermsQuery{type},
                                                                "send a " + type->name() + " to");
  result = Effector{};
  result.actor = std::move(actor);
  result.terms = std::move(reply.terms);
  result.clock.synchronise(reply.clock, parts_.context.time_point());
  return result;
}

CommandMessage
ComponentCommands::make_message(Effector& effector, Clock::time_point given, const Value& x,
                                std::optional<std::chrono::microseconds> valid_for) const {
  if (valid_for && *valid_for <= Timestamp{0})
    throw std::invalid_argument("a command has to be valid for more than 0 s");
  auto& lease = effector.terms.lease;
  CommandMessage result;
  result.value = x;
  result.commander = parts_.context.client();
  result.token = lease ? parts_.context.leases().token(*lease) : 0;
  result.sent = effector.clock.at(given);
  result.valid_for =
    std::min(valid_for.value_or(effector.terms.valid_for), effector.terms.valid_for);
  result.number = ++effector.last_number;
  return result;
}

void ComponentCommands::command(const std::string& effector, const Value& x,
                                std::optional<std::chrono::microseconds> valid_for) {
  auto& to = connect(effector, x.type_ptr());
  auto done = parts_.providers.ask_once<CommandDone>(
    effector, to.actor, make_message(to, parts_.context.time_point(), x, valid_for),
    "send a " + x.type_name() + " to");
  to.clock.synchronise(done.clock, parts_.context.time_point());
  if (done.result == CommandResult::refused)
    throw CommandRefused(done.reason);
  if (done.result == CommandResult::failed)
    throw ConnectionError(effector + " failed with " + command_of(x.type_name()) + ": " +
                          done.reason);
}

void ComponentCommands::stream(const std::string& effector, const Value& x,
                               std::optional<std::chrono::microseconds> valid_for) {
  parts_.actor.file_arrived();
  // What was right before the effector was started again need not be right after.
  const auto given = parts_.context.time_point();
  auto& to = connect(effector, x.type_ptr());
  auto message = make_message(to, given, x, valid_for);
  if (to.under_way == 0) {
    to.under_way = message.number;
    parts_.actor.send(to.actor, std::move(message));
  } else {
    to.waiting = std::move(message);
  }
  if (auto refusal = std::exchange(to.refusal, {}); !refusal.empty())
    throw CommandRefused(refusal);
}

void ComponentCommands::done(const CommandDone& x) {
  auto i = effectors_.find({x.effector, x.type});
  if (i == effectors_.end() || i->second.under_way != x.number)
    return;
  auto& from = i->second;
  from.clock.synchronise(x.clock, parts_.context.time_point());
  from.under_way = 0;
  if (x.result != CommandResult::obeyed)
    from.refusal = x.reason;
  if (auto next = std::exchange(from.waiting, std::nullopt)) {
    from.under_way = next->number;
    parts_.actor.send(from.actor, *std::move(next));
  }
}

void ComponentCommands::clear() {
  obediences_.clear();
  answers_.clear();
  commanders_.clear();
  effectors_.clear();
}

} // namespace castor
