#include "castor/actors/runtime/command_gate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace castor {

namespace {

/// "1.53 s"
std::string in_words(CommandGate::Clock::duration x) {
  return fmt::format("{:.3g} s", std::chrono::duration<double>(x).count());
}

} // namespace

std::string_view to_string(SafeStateCause x) {
  switch (x) {
    case SafeStateCause::expired:
      return "the last command has expired";
    case SafeStateCause::commander_ended:
      return "the commander has ended";
    case SafeStateCause::lease_ended:
      return "the commander's lease has ended";
    case SafeStateCause::lease_unconfirmed:
      return "the commander's lease cannot be confirmed";
    case SafeStateCause::effector_ends:
      return "the effector ends";
  }
  return {};
}

CommandGate::CommandGate(std::string effector, CommandTerms terms)
  : effector_(std::move(effector)), terms_(std::move(terms)) {}

CommandGate::Time CommandGate::expiry(const Offer& x) const {
  return x.sent + std::min(x.valid_for, terms_.valid_for);
}

bool CommandGate::is_confirmed(Time now) const {
  return confirmed_ && now < confirmed_->asked + trusted_for;
}

bool CommandGate::is_holder(const Offer& x) const {
  return confirmed_ && confirmed_->holder && x.token == confirmed_->token &&
         *x.commander == *confirmed_->holder;
}

std::string CommandGate::refusal_of_age(const Waiting& x, Time now) const {
  if (expiry(x.offer) > x.arrived)
    return refusal_unconfirmed(x.offer, "no answer in " + in_words(now - x.arrived));
  return fmt::format("the command arrived {} after it was sent, and is valid for {}",
                     in_words(x.arrived - x.offer.sent),
                     in_words(std::min(x.offer.valid_for, terms_.valid_for)));
}

std::string CommandGate::refusal_of_token(const Offer& x) const {
  auto text = fmt::format("{} obeys only the holder of the lease of {}; ", effector_, entry());
  text += x.token == 0
            ? to_string(*x.commander) + " holds none"
            : fmt::format("that of {} (token {}) has ended", to_string(*x.commander), x.token);
  if (confirmed_ && confirmed_->holder)
    text += fmt::format(", now {} holds it (token {})", to_string(*confirmed_->holder),
                        confirmed_->token);
  return text;
}

std::string CommandGate::refusal_unconfirmed(const Offer& x, const std::string& why) const {
  return fmt::format("{} cannot confirm that {} holds the lease of {}: {}", effector_,
                     to_string(*x.commander), entry(), why);
}

std::optional<std::string> CommandGate::refusal_of(const Waiting& x, Time now) const {
  if (expiry(x.offer) <= now)
    return refusal_of_age(x, now);
  if (terms_.commander && x.offer.commander->component != *terms_.commander)
    return fmt::format("{} obeys only {}, not {}: command that one", effector_, *terms_.commander,
                       to_string(*x.offer.commander));
  if (!demands_lease() || (is_confirmed(now) && is_holder(x.offer)))
    return "";
  // Tokens only rise: nobody has to be asked.
  if (x.offer.token == 0 || (confirmed_ && x.offer.token < confirmed_->token))
    return refusal_of_token(x.offer);
  // What was answered to an earlier question says nothing of this command.
  if (is_confirmed(now) && x.arrived <= confirmed_->asked)
    return refusal_of_token(x.offer);
  if (obstacle_ && x.arrived <= obstacle_->second)
    return refusal_unconfirmed(x.offer, obstacle_->first);
  return std::nullopt;
}

void CommandGate::offer(Offer x, Time now) {
  waiting_.push_back({std::move(x), now});
}

void CommandGate::confirm(const Confirmation& x) {
  // Answers may overtake each other.
  if (confirmed_ && x.asked < confirmed_->asked)
    return;
  if (asked_ && *asked_ <= x.asked)
    asked_.reset();
  obstacle_.reset();
  confirmed_ = x;
  if (in_force_ && (!x.holder || in_force_->token != x.token))
    cause_ = SafeStateCause::lease_ended;
}

void CommandGate::cannot_confirm(std::string why, Time now) {
  asked_ = now;
  obstacle_ = {std::move(why), now};
}

std::optional<CommandGate::Decision> CommandGate::decide(Time now) {
  for (auto i = waiting_.begin(); i != waiting_.end(); ++i) {
    auto refusal = refusal_of(*i, now);
    if (!refusal)
      continue;
    Decision result{std::move(i->offer), *std::move(refusal)};
    waiting_.erase(i);
    if (result.refusal.empty()) {
      auto& x = result.offer;
      in_force_ = InForce{x.commander, x.token, expiry(x)};
      cause_.reset();
    }
    return result;
  }
  return std::nullopt;
}

bool CommandGate::should_ask(Time now) {
  if (!demands_lease() || (waiting_.empty() && !in_force_))
    return false;
  // One question at a time, and another if there is no answer.
  if (asked_ && now < *asked_ + confirmation_period)
    return false;
  if (waiting_.empty() && confirmed_ && now < confirmed_->asked + confirmation_period)
    return false;
  asked_ = now;
  return true;
}

void CommandGate::forget(const Client& commander) {
  std::erase_if(waiting_, [&](auto& x) { return *x.offer.commander == commander; });
  if (in_force_ && *in_force_->commander == commander)
    cause_ = SafeStateCause::commander_ended;
}

std::optional<SafeStateCause> CommandGate::take_safe_state(Time now) {
  if (!in_force_)
    return std::nullopt;
  auto cause = cause_;
  if (!cause && now >= in_force_->until)
    cause = SafeStateCause::expired;
  if (!cause && demands_lease() && !is_confirmed(now))
    cause = SafeStateCause::lease_unconfirmed;
  if (cause)
    release();
  return cause;
}

bool CommandGate::release() {
  cause_.reset();
  return std::exchange(in_force_, std::nullopt).has_value();
}

std::optional<CommandGate::Time> CommandGate::next_alarm() const {
  std::optional<Time> result;
  auto consider = [&](Time x) { result = result ? std::min(*result, x) : x; };
  if (in_force_)
    consider(cause_ ? Time{} : in_force_->until);
  if (!demands_lease() || (waiting_.empty() && !in_force_))
    return result;
  for (auto& x : waiting_)
    consider(expiry(x.offer));
  if (in_force_ && confirmed_)
    consider(confirmed_->asked + trusted_for);
  if (asked_)
    consider(*asked_ + confirmation_period);
  else if (!waiting_.empty())
    consider(Time{});
  else if (confirmed_)
    consider(confirmed_->asked + confirmation_period);
  return result;
}

} // namespace castor
