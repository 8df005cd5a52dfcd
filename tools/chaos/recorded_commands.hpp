#pragma once

#include "castor/tools/chaos/recorded_operations.hpp"
#include "castor/wm/entries/address.hpp"

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

/// The commands that effectors have logged (castor/actors/runtime/operation_log.hpp), and a check
/// of their right to be obeyed.
namespace castor::faults {

/// A command that an effector has obeyed.
struct ObeyedCommand {
  std::string effector;
  std::string type;
  linearizability::Tick at = 0;
  Life commander;
  linearizability::Token token = 0;
  /// The entry whose lease the effector demands; nothing if anybody may command.
  std::optional<Address> lease;
};

/// Reads the file of one process.
void read_commands(std::istream& in, std::vector<ObeyedCommand>& to);

/// Reads all files of a folder. Incomplete lines of killed processes are left out.
std::vector<ObeyedCommand> read_commands(const std::filesystem::path& folder);

/// Whether each command was obeyed with a valid token: that of a lease which its commander was
/// granted, and which nobody else had been granted for longer than effectors trust a confirmation
/// (`CommandGate::trusted_for`); and never after a command with a newer token.
Judgement judge_commands(std::vector<ObeyedCommand> commands, const Recording& recording);

} // namespace castor::faults
