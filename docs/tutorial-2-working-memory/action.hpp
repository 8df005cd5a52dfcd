#pragma once

#include "cup.hpp"

#include <castor/actors/component/entry_pointer.hpp>

#include <cstdint>
#include <optional>
#include <string>

// What can be asked of a manipulator.

struct PickAndPlaceCmd {
  castor::EntryPointer<Cup> object;
  std::string place;
};
CASTOR_REFLECT(PickAndPlaceCmd, object, place)

struct WaveCmd {
  std::int64_t times = 1;
};
CASTOR_REFLECT(WaveCmd, times)

// How any of it is asked for.

enum class ActionStatus : std::uint8_t { proposed, executing, complete };
CASTOR_REFLECT_ENUM(ActionStatus, proposed, executing, complete)

struct Action {
  /// The specific entry.
  castor::AnyEntryPointer action;
  ActionStatus status = ActionStatus::proposed;
  /// Once it is complete.
  std::optional<bool> succeeded = {};
};
CASTOR_REFLECT(Action, action, status, succeeded)

/// The reply, where a command is called.
struct ActionResult {
  bool succeeded = false;
};
CASTOR_REFLECT(ActionResult, succeeded)
