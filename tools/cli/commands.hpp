#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The commands of `castor`, each in a source file of its own.
namespace castor::cli {

/// Executes a parsed command; returns the exit status.
using Action = std::function<int()>;

// Each adds a command to `app`; if the user calls it, `chosen` is set to its action.
/// @param plugins named on the command line
void add_run(CLI::App& app, Action& chosen, const std::vector<std::string>& plugins);
void add_chaos(CLI::App& app, Action& chosen, const std::vector<std::string>& plugins);
void add_simulate(CLI::App& app, Action& chosen);
void add_node(CLI::App& app, Action& chosen);
void add_check(CLI::App& app, Action& chosen);
void add_components(CLI::App& app, Action& chosen);
void add_building(CLI::App& app, Action& chosen);
void add_plan(CLI::App& app, Action& chosen);
void add_new(CLI::App& app, Action& chosen);
// Commands that inspect or change a running system.
void add_ps(CLI::App& app, Action& chosen);
void add_wm(CLI::App& app, Action& chosen);
void add_events(CLI::App& app, Action& chosen);
void add_graph(CLI::App& app, Action& chosen);
void add_add(CLI::App& app, Action& chosen);
void add_remove(CLI::App& app, Action& chosen);
void add_call(CLI::App& app, Action& chosen);
void add_command(CLI::App& app, Action& chosen);
void add_clock(CLI::App& app, Action& chosen);
void add_map(CLI::App& app, Action& chosen);
/// Add `check` and `rooms` to the group `map`.
void add_map_check(CLI::App& group, Action& chosen);
void add_map_rooms(CLI::App& group, Action& chosen);
void add_actions(CLI::App& app, Action& chosen);
void add_doctor(CLI::App& app, Action& chosen);
/// Commands for journals; they need no running system.
void add_journal(CLI::App& app, Action& chosen);
/// Commands that describe all other commands of `app`.
void add_completion(CLI::App& app, Action& chosen);
void add_man(CLI::App& app, Action& chosen);

/// Exit statuses other than those set by components.
enum ExitStatus : int {
  success = 0,
  a_component_failed = 1,
  bad_input = 2,
  /// A run with faults that proves nothing.
  vacuous_run = 4,
};

} // namespace castor::cli
