#include "castor/actors/runtime/crash_report.hpp"
#include "castor/actors/runtime/plugin.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/base/plain_words.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/signals.hpp"
#include "castor/tools/cli/standard_descriptors.hpp"
#include "castor/tools/cli/usage_errors.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  using namespace castor;
  cli::open_standard_descriptors();
  cli::end_with_output();
  // A file that may not grow any further is an error of whoever writes it, as a full disk is.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app{
    "Castor runs information-processing architectures for robots: components that meet on "
    "shared working memories, as a .cast file describes them."};
  app.require_subcommand(1);
  app.set_version_flag("--version", "castor " CASTOR_VERSION);
  app.get_formatter()->column_width(34);
  app.footer("`castor COMMAND --help` describes each command.");
  app.fallthrough();
  std::vector<std::string> plugins;
  app.add_option("--plugin", plugins, "load component classes from a shared library (repeatable)")
    ->type_name("FILE")
    ->check(why_no_plugin);
  guard_log_lines([]() -> std::shared_ptr<void> { return std::make_shared<cli::ProgressPause>(); });
  report_crashes();
  cli::Action action;
  cli::add_run(app, action, plugins);
  cli::add_node(app, action);
  cli::add_chaos(app, action, plugins);
  cli::add_simulate(app, action);
  cli::add_ps(app, action);
  cli::add_wm(app, action);
  cli::add_events(app, action);
  cli::add_graph(app, action);
  cli::add_add(app, action);
  cli::add_remove(app, action);
  cli::add_call(app, action);
  cli::add_command(app, action);
  cli::add_clock(app, action);
  cli::add_map(app, action);
  cli::add_actions(app, action);
  cli::add_journal(app, action);
  cli::add_check(app, action);
  cli::add_components(app, action);
  cli::add_building(app, action);
  cli::add_plan(app, action);
  cli::add_new(app, action);
  cli::add_doctor(app, action);
  cli::add_completion(app, action);
  cli::add_man(app, action);
  cli::take_one_value_each(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0)
      return app.exit(e);
    std::fprintf(stderr, "%s\n", cli::explain(app, e).c_str());
    return cli::bad_input;
  }
  if (auto problem = load_plugins(plugins)) {
    std::fprintf(stderr, "%s\n", problem->c_str());
    return cli::bad_input;
  }
  try {
    return cli::finish_output(action());
  } catch (const SystemError& e) {
    cli::print(e.diagnostics());
    return cli::bad_input;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "castor: %s\n", plain_words(e).c_str());
    return cli::bad_input;
  }
}
