#include "castor/tools/cli/completion.hpp"

#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <memory>
#include <set>
#include <string>

namespace castor::cli {

namespace {

int print_script(const CLI::App& app, const std::string& shell) {
  auto program = command_tree(app, "castor");
  auto script = shell == "bash"  ? bash_completion(program)
                : shell == "zsh" ? zsh_completion(program)
                                 : fish_completion(program);
  std::fputs(script.c_str(), stdout);
  return success;
}

std::set<std::string> names_in(const RunningSystem& system, const std::string& kind) {
  std::set<std::string> result;
  if (kind == "systems") {
    result.insert(system.name);
    return result;
  }
  ask(system, {{"do", "ps"}}, [&](const Json& report) {
    for (auto& wm : report["working_memories"]) {
      auto name = wm["subarchitecture"].get<std::string>();
      result.insert(name);
      for (auto& [type, count] : wm["entries_by_type"].items())
        result.insert(name + '/' + type);
    }
  });
  return result;
}

int print_values(const std::string& kind) {
  for (auto& system : running_systems()) {
    try {
      for (auto& name : names_in(system, kind))
        std::printf("%s\n", name.c_str());
    } catch (const std::exception&) {
      // A system that ends at this moment has nothing to offer; a shell has no place for messages.
    }
  }
  return success;
}

} // namespace

void add_completion(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
    "completion", "print the script that lets a shell complete castor's command lines");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "which shell the script is for")
    ->type_name("SHELL")
    ->required()
    ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->footer("The Debian package and `cmake --install` put the scripts where the shells look "
                  "for them. Without "
                  "them, put a line into the file that your shell reads at its start:\n"
                  "Examples: source <(castor completion bash)      # ~/.bashrc\n"
                  "          source <(castor completion zsh)       # ~/.zshrc, after compinit\n"
                  "          castor completion fish | source       # ~/.config/fish/config.fish");
  command->callback(
    [&app, &chosen, shell] { chosen = [&app, shell] { return print_script(app, *shell); }; });

  auto* values = app.add_subcommand(completion_values,
                                    "for the scripts: names of running systems and of their parts");
  values->group("");
  auto kind = std::make_shared<std::string>();
  values->add_option("KIND", *kind)->required()->check(CLI::IsMember({"systems", "places"}));
  on_call(*values, chosen, kind, print_values);
}

} // namespace castor::cli
