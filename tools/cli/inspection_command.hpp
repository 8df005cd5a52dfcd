#pragma once

#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <memory>
#include <string>
#include <utility>

#include <nlohmann/json_fwd.hpp>

/// Functions shared by all commands that send requests to a running system.
namespace castor::cli {

// Commands of `castor wm`.
void add_wm_tether(CLI::App& wm, Action& chosen);
/// Adds the commands of `castor wm` that change entries.
void add_wm_writes(CLI::App& wm, Action& chosen);

/// A command with the option --system, which is stored in `system`.
CLI::App* inspection_command(CLI::App& app, const std::string& name, const std::string& help,
                             std::string& system);

void add_json_flag(CLI::App& command, bool& json);
void add_wait_flag(CLI::App& command, bool& wait);
/// SUBARCHITECTURE[/ID|TYPE], which may be left out.
void add_where_option(CLI::App& command, std::string& where);

/// The request for entries, without their values; `where` is SUBARCHITECTURE[/ID|TYPE].
nlohmann::ordered_json entries_request(const std::string& where);
/// The same with values.
/// @param full with all bytes of byte fields
nlohmann::ordered_json values_request(const std::string& where, bool full = false);

/// Prints change events as they arrive, until the system ends; returns the exit status.
int print_changes(const RunningSystem& system, const nlohmann::ordered_json& request, bool json);

/// Prints to standard output and flushes it, so that the reader of a pipe sees it at once.
void print(const std::string& x);

/// SUBARCHITECTURE, and the part after the slash, which may be empty.
std::pair<std::string, std::string> split_where(const std::string& where);

/// Parses JSON given as an argument, "-" for standard input. Throws std::runtime_error with the
/// position of the error.
nlohmann::ordered_json read_json(const std::string& argument);

} // namespace castor::cli
