#pragma once

#include "castor/actors/component/command_terms.hpp"
#include "castor/actors/component/task.hpp"
#include "castor/base/caf.hpp"
#include "castor/base/injected_fault.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/values/timestamp.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <cstdint>
#include <string>

/// Messages to a component, besides those of working memories.
namespace castor {

enum class Phase : std::uint8_t { configure, start, run };

/// Enter the next phase; answered with PhaseDone, except for Phase::run.
struct EnterPhase {
  Phase phase = Phase::configure;
  caf::actor phase_controller;
};

/// To the phase controller: the component has configured itself or has started, or failed to.
struct PhaseDone {
  std::uint32_t component = 0;
  Phase phase = Phase::configure;
  /// Empty if all went well.
  std::string failure;
};

/// A fault to inject into a component.
struct ComponentFault {
  enum class Kind : std::uint8_t {
    /// The component ends at its next call of the runtime, an isolated one with its process.
    crash,
    /// A callback throws.
    failure,
    /// Its next callback takes `by`.
    hang,
    /// Its next configure() or start() takes `by`; of a running component, that is after its next
    /// restart.
    blocked_configure,
    blocked_start,
    /// Every callback takes longer, by `by`.
    slowness,
  };

  Kind kind = Kind::crash;
  /// For `failure`: number of the callback that throws, counted from now, from 1.
  std::uint32_t callback = 1;
  /// For `hang`, `blocked_configure`, `blocked_start` and `slowness`: duration of the delay.
  Timestamp by{0};
  /// How long slowness lasts.
  Timestamp duration{0};
  FaultTicket ticket = {};
};

/// To a component: look again at what you wait for.
struct LookAgain {};

/// To a task manager.
struct ProposeTask {
  TaskProposal proposal;
};
struct RetractTask {
  TaskId id;
};
struct CompleteTask {
  TaskId id;
  TaskOutcome outcome = TaskOutcome::success;
};

/// To a stand-alone component: answered with its newest value of the type.
struct PullRequest {
  TypeDescriptorPtr type;
  /// What exactly is asked for; may be empty.
  Value argument;
};

/// To a stand-alone component: send the sender every value of the type that is pushed, with at most
/// `limit` not taken.
struct PushRequest {
  TypeDescriptorPtr type;
  std::uint32_t limit = 0;
  /// Full name of the subscriber.
  std::string subscriber;
};

/// From a stand-alone component.
struct Pushed {
  std::string provider;
  Value value;
};

/// Bound of the clocks of effectors, and of how long commands hold.
inline constexpr Timestamp longest_command_time = std::chrono::hours{24 * 365 * 100};

/// To a stand-alone component: what does it demand of commands of the type? Answered with
/// CommandTermsReply.
struct CommandTermsQuery {
  TypeDescriptorPtr type;
};

struct CommandTermsReply {
  CommandTerms terms;
  /// Time by the effector's clock.
  Timestamp clock{0};
};

/// To a stand-alone component: answered with Outcome<CommandDone>, or with a CommandDone if it is
/// no request.
struct CommandMessage {
  Value value;
  ClientPtr commander;
  /// Of the lease that the commander believes it holds; 0 for none.
  LeaseToken token = 0;
  /// By the effector's clock, rather too early than too late.
  Timestamp sent{0};
  /// How long it holds from then on.
  Timestamp valid_for{0};
  /// Of the commander's commands; increases.
  std::uint64_t number = 0;
};

enum class CommandResult : std::uint8_t { obeyed, refused, failed };

/// From a stand-alone component.
struct CommandDone {
  /// Its name, and the type of the command.
  std::string effector;
  std::string type;
  std::uint64_t number = 0;
  CommandResult result = CommandResult::obeyed;
  /// Why, unless it was obeyed.
  std::string reason;
  /// Time by the effector's clock.
  Timestamp clock{0};
};

/// To a stand-alone component that stands in for a recorded one: hand this out from now on.
/// Answered with Acknowledged.
struct HandOut {
  Value value;
  /// Whether subscribers get it, too; otherwise only those who pull.
  bool push = false;
};

/// To a stand-alone component: `count` more pushes of the type were taken.
struct PushesTaken {
  std::string type;
  std::uint32_t count = 0;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::EnterPhase)
CASTOR_LOCAL_MESSAGE(castor::PhaseDone)
CASTOR_LOCAL_MESSAGE(castor::ComponentFault)
CASTOR_LOCAL_MESSAGE(castor::LookAgain)
CASTOR_LOCAL_MESSAGE(castor::ProposeTask)
CASTOR_LOCAL_MESSAGE(castor::RetractTask)
CASTOR_LOCAL_MESSAGE(castor::CompleteTask)
CASTOR_LOCAL_MESSAGE(castor::TaskDecided)
CASTOR_LOCAL_MESSAGE(castor::PullRequest)
CASTOR_LOCAL_MESSAGE(castor::PushRequest)
CASTOR_LOCAL_MESSAGE(castor::Pushed)
CASTOR_LOCAL_MESSAGE(castor::HandOut)
CASTOR_LOCAL_MESSAGE(castor::PushesTaken)
CASTOR_LOCAL_MESSAGE(castor::CommandTermsQuery)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::CommandTermsReply>)
CASTOR_LOCAL_MESSAGE(castor::CommandMessage)
CASTOR_LOCAL_MESSAGE(castor::CommandDone)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::CommandDone>)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::Value>)
