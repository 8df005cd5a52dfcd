#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/read_architecture.hpp"
#include "castor/tools/cli/running_system.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace castor::cli {

namespace {

struct ReconfigureArguments {
  std::string system;
  bool json = false;
  /// Of `add`.
  ArchitectureArguments architecture;
  /// Of `remove`.
  std::string name;
};

/// "2 components on localhost: ear, recogniser; the subarchitecture speech"
std::string members_as_text(const Json& x) {
  std::map<std::string, std::vector<std::string>> by_node;
  for (auto& y : x["components"])
    by_node[y["node"].get<std::string>()].push_back(y["name"].get<std::string>());
  std::vector<std::string> parts;
  for (auto& [node, names] : by_node)
    parts.push_back(fmt::format("{} component{} on {}: {}", names.size(),
                                names.size() == 1 ? "" : "s", node, fmt::join(names, ", ")));
  for (auto& y : x["subarchitectures"])
    parts.push_back("the subarchitecture " + y.get<std::string>());
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, "; "));
}

int change_system(const ReconfigureArguments& arguments, const Json& request, const char* verb) {
  auto system = choose_system(arguments.system);
  int status = success;
  bool done = false;
  ask(system, request, [&](const Json& x) {
    for (auto* key : {"remarks", "findings"})
      if (x.contains(key))
        std::fputs(x[key].get<std::string>().c_str(), stderr);
    if (x.contains("findings"))
      status = bad_input;
    if (!x.contains("done"))
      return;
    done = true;
    print(arguments.json ? x.dump() + '\n' : fmt::format("{} {}\n", verb, members_as_text(x)));
  });
  if (status == success && !done)
    throw std::runtime_error(system.name + " has ended before it answered");
  return status;
}

int add_parts(const ReconfigureArguments& arguments) {
  std::error_code error;
  const auto directory = std::filesystem::current_path(error);
  if (error)
    throw std::runtime_error("the folder of this process cannot be used: " + error.message() +
                             "; go to one that is there");
  Json variables = Json::object();
  for (auto& [name, value] : variables_of(arguments.architecture))
    variables[name] = value;
  return change_system(arguments,
                       {{"do", "add"},
                        {"file", (directory / arguments.architecture.file).string()},
                        {"directory", directory.string()},
                        {"variables", variables}},
                       "added");
}

int remove_part(const ReconfigureArguments& arguments) {
  return change_system(arguments, {{"do", "remove"}, {"name", arguments.name}}, "removed");
}

} // namespace

void add_add(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<ReconfigureArguments>();
  auto* command = inspection_command(
    app, "add", "add the components of a .cast file to a running system", arguments->system);
  add_architecture_arguments(*command, arguments->architecture);
  command->footer(
    "The file has whole subarchitectures, or lines for subarchitectures that run: these have "
    "neither a WM nor a TM line.\nIf anything prevents that, the system is not changed.\n"
    "Example: castor add touch.cast --system playmate");
  add_json_flag(*command, arguments->json);
  on_call(*command, chosen, arguments, add_parts);
}

void add_remove(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<ReconfigureArguments>();
  auto* command = inspection_command(
    app, "remove", "stop a component or a subarchitecture of a running system", arguments->system);
  command->add_option("NAME", arguments->name, "of the component or the subarchitecture")
    ->required();
  add_json_flag(*command, arguments->json);
  command->footer("Examples: castor remove recogniser\n"
                  "          castor remove speech");
  on_call(*command, chosen, arguments, remove_part);
}

} // namespace castor::cli
