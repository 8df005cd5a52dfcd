#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// The entries of actions. Each action has two: a specific one, of a type of its own, says what is
/// to be done; the generic one, an `Action`, who asked for it, who does it, and how far it is. Both
/// are in the working memory of the requester.
namespace castor {

enum class ActionStatus : std::uint8_t {
  /// No executor has accepted it yet.
  proposed,
  /// An executor has accepted it, and has not begun.
  accepted,
  running,
  paused,
  /// It is to be cancelled, and its executor has noticed.
  cancelling,
  /// The outcome says how it ended.
  over,
};
CASTOR_REFLECT_ENUM(ActionStatus, proposed, accepted, running, paused, cancelling, over)

enum class ActionOutcome : std::uint8_t { none, succeeded, failed, cancelled };
CASTOR_REFLECT_ENUM(ActionOutcome, none, succeeded, failed, cancelled)

/// What the requester wants of an action that it has asked for.
enum class ActionWish : std::uint8_t { proceed, pause, cancel };
CASTOR_REFLECT_ENUM(ActionWish, proceed, pause, cancel)

/// Action that a component has asked for. Its executor is one component of `subarchitecture`, the
/// first to accept it.
struct Action {
  /// The specific entry.
  AnyEntryPointer what;
  std::string subarchitecture;
  std::string requester;
  /// Entry that is the reason for the action, such as a goal; may be unset.
  AnyEntryPointer cause;
  /// Whether the action goes on if its requester ends; otherwise it is cancelled.
  bool continues = false;
  ActionWish wish = ActionWish::proceed;

  ActionStatus status = ActionStatus::proposed;
  /// Part that is done, from 0 to 1.
  double progress = 0;
  /// Empty until one has accepted it.
  std::string executor;
  bool can_pause = false;
  bool can_cancel = true;

  ActionOutcome outcome = ActionOutcome::none;
  /// It failed because its executor ended: asked for again, it may succeed.
  bool executor_ended = false;
  /// Why it failed or was cancelled.
  std::string reason;
  /// Facts that hold since the action, and facts that no longer hold, in the notation of those who
  /// agreed on them.
  std::vector<std::string> became_true;
  std::vector<std::string> became_false;
};
CASTOR_REFLECT(Action, what, subarchitecture, requester, cause, continues, wish, status, progress,
               executor, can_pause, can_cancel, outcome, executor_ended, reason, became_true,
               became_false)

/// Type of actions that a component executes, as long as it lives.
struct ActionRegistration {
  std::string component;
  std::string type;
  /// What has to hold for the action to succeed, for people and planners.
  std::string preconditions;
  bool can_pause = false;
  bool can_cancel = true;
};
CASTOR_REFLECT(ActionRegistration, component, type, preconditions, can_pause, can_cancel)

} // namespace castor
