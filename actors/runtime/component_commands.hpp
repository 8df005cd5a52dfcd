#pragma once

#include "castor/actors/component/commands.hpp"
#include "castor/actors/runtime/command_gate.hpp"
#include "castor/actors/runtime/component_context.hpp"
#include "castor/actors/runtime/effector_clock.hpp"
#include "castor/actors/runtime/mailbox.hpp"
#include "castor/actors/runtime/operation_log.hpp"
#include "castor/actors/runtime/provider_client.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/runtime/user_code.hpp"
#include "castor/base/caf.hpp"

#include <caf/mailbox_element.hpp>

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace castor {

/// A component's commands, at either end: passes those of an effector through a CommandGate for
/// each type, and sends those of a commander. Used on the component's own thread only.
class ComponentCommands final : public Commands {
public:
  using Clock = CommandGate::Clock;

  struct Parts {
    PumpedActor& actor;
    ComponentContext& context;
    ProviderClient& providers;
    UserCode& code;
  };

  explicit ComponentCommands(const Parts& parts);
  ComponentCommands(const ComponentCommands&) = delete;
  ComponentCommands& operator=(const ComponentCommands&) = delete;

  void obey(CommandHandler handler) override;
  void command(const std::string& effector, const Value& x,
               std::optional<std::chrono::microseconds> valid_for) override;
  void stream(const std::string& effector, const Value& x,
              std::optional<std::chrono::microseconds> valid_for) override;

  // -- what arrives

  /// An effector has dealt with a streamed command: sends it the newest.
  void done(const CommandDone& x);

  /// Handles the message if it concerns commands; otherwise returns false.
  bool handle(caf::mailbox_element& x);

  /// A commander has ended.
  void forget(const caf::actor_addr& commander);

  // -- time, for effectors

  /// Does what is due: confirms leases, and calls the component's code to obey or to take its safe
  /// state.
  void work();

  /// When `work` will next have something to do.
  Clock::time_point next_alarm() const;

  /// Takes the safe state for every command in force: the component ends.
  void take_safe_states();

  /// Drops all handles of other actors.
  void clear();

private:
  /// The sender of a command that is not decided yet.
  struct Requester {
    caf::strong_actor_ptr actor;
    caf::message_id request;
    std::uint64_t number = 0;
  };

  /// Commands of one type that this component obeys.
  struct Obedience {
    CommandHandler handler;
    CommandGate gate;
    /// By ticket.
    std::map<std::uint64_t, Requester> requesters;
  };

  /// The answer of a working memory, which waits until the component's own code may run.
  struct LeaseAnswer {
    std::string type;
    Clock::time_point asked;
    Outcome<LockStatus> status;
  };

  /// An effector that this component commands, for one type.
  struct Effector {
    caf::actor actor;
    CommandTerms terms;
    EffectorClock clock;
    std::uint64_t last_number = 0;
    /// Number of the streamed command under way; 0 for none.
    std::uint64_t under_way = 0;
    /// The newest after that.
    std::optional<CommandMessage> waiting;
    /// Why a streamed command was not obeyed; empty if all were.
    std::string refusal;
  };

  // -- effector

  void handle_terms_query(caf::mailbox_element& x, const CommandTermsQuery& query);
  void handle_command(caf::mailbox_element& x, const CommandMessage& message);
  /// Obeys or refuses the commands that can be decided.
  void decide(Obedience& obedience);
  void carry_out(Obedience& obedience, const CommandGate::Offer& x);
  void reply(Obedience& obedience, std::uint64_t ticket, CommandResult result, std::string reason);
  void reply(const Requester& to, const std::string& type, CommandResult result,
             std::string reason);
  void confirm_lease(Obedience& obedience);
  void take_safe_state(Obedience& obedience, SafeStateCause cause);
  /// Shows in the record whom the component obeys.
  void publish();

  // -- commander

  Effector& connect(const std::string& name, const TypeDescriptorPtr& type);
  /// @param given when the component's code gave the command
  CommandMessage make_message(Effector& effector, Clock::time_point given, const Value& x,
                              std::optional<std::chrono::microseconds> valid_for) const;

  Parts parts_;
  /// Set if operations are logged.
  std::optional<OperationRecorder> recorder_;
  /// By type.
  std::map<std::string, Obedience> obediences_;
  std::uint64_t last_ticket_ = 0;
  std::deque<LeaseAnswer> answers_;
  std::map<caf::actor_addr, ClientPtr> commanders_;
  /// By name and type.
  std::map<std::pair<std::string, std::string>, Effector> effectors_;
};

} // namespace castor
