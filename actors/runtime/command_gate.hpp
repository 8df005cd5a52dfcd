#pragma once

#include "castor/actors/component/command_terms.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

/// Why an effector takes its safe state.
enum class SafeStateCause : std::uint8_t {
  /// The last command held until now.
  expired,
  /// The commander has ended, or its process is lost.
  commander_ended,
  /// The commander's lease has ended.
  lease_ended,
  /// The working memory has not said lately whose the lease is.
  lease_unconfirmed,
  /// The effector itself stops, or has failed.
  effector_ends,
};

/// For messages: "the last command has expired".
std::string_view to_string(SafeStateCause x);

/// Decides which commands of one type an effector obeys, and when it takes its safe state. Without
/// actors; time is passed in.
///
/// If the terms demand a lease, a command is obeyed only if the working memory has said that the
/// commander's token is that of the entry's current lease. What it says is believed for
/// `trusted_for`, counted from the question. While a command holds, the question is repeated every
/// `confirmation_period`. So a commander moves nothing for longer than `trusted_for` after the end
/// of its lease, also if the working memory cannot be reached, and nothing at all once another
/// holder was obeyed.
class CommandGate {
public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  static constexpr std::chrono::milliseconds confirmation_period{40};
  static constexpr std::chrono::milliseconds trusted_for{100};

  struct Offer {
    /// Number by which the caller knows the command.
    std::uint64_t ticket = 0;
    ClientPtr commander;
    /// Of the lease that the commander believes it holds; 0 for none.
    LeaseToken token = 0;
    /// By the effector's clock.
    Time sent;
    std::chrono::microseconds valid_for{0};
    Value value;
  };

  struct Decision {
    Offer offer;
    /// Why the command is not obeyed; empty if it is.
    std::string refusal;
  };

  /// The command that the effector obeys now.
  struct InForce {
    ClientPtr commander;
    LeaseToken token = 0;
    Time until;
  };

  /// What the working memory says of the lease.
  struct Confirmation {
    /// When it was asked.
    Time asked;
    /// 0 for no lease.
    LeaseToken token = 0;
    /// Null for no lease.
    ClientPtr holder;
  };

  /// @param effector its name, for messages
  CommandGate(std::string effector, CommandTerms terms);

  const CommandTerms& terms() const { return terms_; }

  /// A command arrived. Call `decide` afterwards until it returns nothing, also after `confirm` and
  /// `cannot_confirm`, and when an alarm is due.
  void offer(Offer x, Time now);
  void confirm(const Confirmation& x);
  /// The working memory cannot be asked.
  void cannot_confirm(std::string why, Time now);

  /// The next command that can be decided, oldest first: the caller obeys it, or answers that it is
  /// refused. From a command that is to be obeyed on, that one is in force.
  std::optional<Decision> decide(Time now);

  /// Whether to ask the working memory now. If so, the question counts as asked.
  bool should_ask(Time now);

  /// The client is gone.
  void forget(const Client& commander);

  /// Whether to take the safe state now, and why. No command is in force then.
  std::optional<SafeStateCause> take_safe_state(Time now);

  /// Ends the command in force; false if there is none.
  bool release();

  /// When `decide`, `should_ask` or `take_safe_state` will next have something to do.
  std::optional<Time> next_alarm() const;

  const std::optional<InForce>& in_force() const { return in_force_; }

private:
  struct Waiting {
    Offer offer;
    Time arrived;
  };

  bool demands_lease() const { return terms_.lease.has_value(); }
  bool is_confirmed(Time now) const;
  bool is_holder(const Offer& x) const;
  std::string entry() const { return to_string(*terms_.lease); }
  Time expiry(const Offer& x) const;
  /// Nothing if it cannot be decided yet; an empty text if it is to be obeyed.
  std::optional<std::string> refusal_of(const Waiting& x, Time now) const;
  std::string refusal_of_age(const Waiting& x, Time now) const;
  std::string refusal_of_token(const Offer& x) const;
  std::string refusal_unconfirmed(const Offer& x, const std::string& why) const;

  const std::string effector_;
  const CommandTerms terms_;
  std::optional<InForce> in_force_;
  std::optional<SafeStateCause> cause_;
  /// Nothing if the working memory was never asked successfully.
  std::optional<Confirmation> confirmed_;
  /// Time of the last question, if it was not answered.
  std::optional<Time> asked_;
  /// Why the working memory could not be asked, and when; no more after an answer.
  std::optional<std::pair<std::string, Time>> obstacle_;
  /// Commands that are not decided, oldest first.
  std::vector<Waiting> waiting_;
};

} // namespace castor
