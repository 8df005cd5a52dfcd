#pragma once

#include "castor/tools/cli/commands.hpp"

#include <string>
#include <utility>

#include <nlohmann/json.hpp>

/// What all commands that ask a running system share.
namespace castor::cli {

/// Commands of `castor wm` that change entries.
void add_wm_writes(CLI::App& wm, Action& chosen);
void add_call(CLI::App& app, Action& chosen);
void add_doctor(CLI::App& app, Action& chosen);

/// A command with the option --system, which is stored in `system`.
CLI::App* inspection_command(CLI::App& app, const std::string& name, const std::string& help,
                             std::string& system);

void add_json_flag(CLI::App& command, bool& json);

/// To standard output; in a pipe too, the reader sees it when it comes.
void print(const std::string& x);

/// SUBARCHITECTURE and what stands behind the slash, which may be nothing.
std::pair<std::string, std::string> split_where(const std::string& where);

/// JSON that was given as an argument, "-" for standard input. Throws std::runtime_error, which
/// says where the mistake is.
nlohmann::ordered_json read_json(const std::string& argument);

} // namespace castor::cli
