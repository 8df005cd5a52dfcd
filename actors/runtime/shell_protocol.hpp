#pragma once

#include "castor/actors/component/task.hpp"
#include "castor/base/caf.hpp"
#include "castor/base/injected_fault.hpp"
#include "castor/wm/entries/failure.hpp"
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
CASTOR_LOCAL_MESSAGE(castor::ProposeTask)
CASTOR_LOCAL_MESSAGE(castor::RetractTask)
CASTOR_LOCAL_MESSAGE(castor::CompleteTask)
CASTOR_LOCAL_MESSAGE(castor::TaskDecided)
CASTOR_LOCAL_MESSAGE(castor::PullRequest)
CASTOR_LOCAL_MESSAGE(castor::PushRequest)
CASTOR_LOCAL_MESSAGE(castor::Pushed)
CASTOR_LOCAL_MESSAGE(castor::HandOut)
CASTOR_LOCAL_MESSAGE(castor::PushesTaken)
CASTOR_LOCAL_MESSAGE(castor::Outcome<castor::Value>)
