#pragma once

#include "castor/wm/entries/address.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace castor {

/// Longest time that a command holds, unless its effector says otherwise.
inline constexpr std::chrono::milliseconds standard_command_duration{500};

/// What an effector demands of the commands of one type.
struct CommandTerms {
  /// How long a command holds, counted from when it was sent. After that, without another command,
  /// the effector takes its safe state. Commanders may ask for less.
  std::chrono::microseconds valid_for = standard_command_duration;
  /// The commander has to hold a lease of this entry; nothing if anybody may command.
  std::optional<Address> lease = std::nullopt;
  /// Name of the only component that may command; nothing if any component may.
  std::optional<std::string> commander = std::nullopt;
};

} // namespace castor
