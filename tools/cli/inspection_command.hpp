#pragma once

#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <memory>
#include <string>
#include <utility>

#include <nlohmann/json_fwd.hpp>

/// What all commands that ask a running system share.
namespace castor::cli {

// Commands of `castor wm`.
void add_wm_tether(CLI::App& wm, Action& chosen);
/// Those that change entries.
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
/// The same with values. @param full with all bytes of byte fields
nlohmann::ordered_json values_request(const std::string& where, bool full = false);

/// Prints change events as they come, until the system ends; returns the exit status.
int print_changes(const RunningSystem& system, const nlohmann::ordered_json& request, bool json);

/// To standard output; in a pipe too, the reader sees it when it comes.
void print(const std::string& x);

/// SUBARCHITECTURE and what stands behind the slash, which may be nothing.
std::pair<std::string, std::string> split_where(const std::string& where);

/// JSON that was given as an argument, "-" for standard input. Throws std::runtime_error, which
/// says where the mistake is.
nlohmann::ordered_json read_json(const std::string& argument);

} // namespace castor::cli
