#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The commands of `castor`, each in a source file of its own.
namespace castor::cli {

/// What to do once the command line is read; returns the exit status.
using Action = std::function<int()>;

// Each adds a command to `app`; if the user calls for it, `chosen` is what to do.
/// `plugins` are those that the command line has named.
void add_run(CLI::App& app, Action& chosen, const std::vector<std::string>& plugins);
void add_chaos(CLI::App& app, Action& chosen, const std::vector<std::string>& plugins);
void add_simulate(CLI::App& app, Action& chosen);
void add_node(CLI::App& app, Action& chosen);
void add_check(CLI::App& app, Action& chosen);
void add_components(CLI::App& app, Action& chosen);
void add_new(CLI::App& app, Action& chosen);
// Those that look at a running system, and those that change it.
void add_ps(CLI::App& app, Action& chosen);
void add_wm(CLI::App& app, Action& chosen);
void add_events(CLI::App& app, Action& chosen);
void add_graph(CLI::App& app, Action& chosen);
void add_add(CLI::App& app, Action& chosen);
void add_remove(CLI::App& app, Action& chosen);
void add_call(CLI::App& app, Action& chosen);
void add_doctor(CLI::App& app, Action& chosen);
/// Those that look at journals, whether a system runs or not.
void add_journal(CLI::App& app, Action& chosen);
/// Those that tell of all the others, which `app` has when they are called.
void add_completion(CLI::App& app, Action& chosen);
void add_man(CLI::App& app, Action& chosen);

/// Exit statuses besides those that a component ends a system with.
enum ExitStatus : int {
  success = 0,
  a_component_failed = 1,
  bad_input = 2,
  /// A run under faults that shows nothing.
  vacuous_run = 4,
};

} // namespace castor::cli
