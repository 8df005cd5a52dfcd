#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/runtime/plugin.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/project_template.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct NewArguments {
  std::string kind;
  std::string name;
  fs::path in = ".";
  bool json = false;
};

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument(why);
}

/// The files of what is to be made; throws std::invalid_argument if it cannot be.
std::vector<ProjectFile> files_of(const NewArguments& arguments, const ProjectName& name) {
  auto files = project_files(arguments.kind, name);
  if (files.empty()) {
    auto kinds = template_kinds();
    auto guess = did_you_mean(arguments.kind, kinds);
    refuse(
      fmt::format("there is no kind '{}'; {}", arguments.kind,
                  guess.empty() ? fmt::format("choose one of {}", fmt::join(kinds, ", ")) : guess));
  }
  load_bundled_plugins();
  for (auto& x : registered_classes(files))
    if (Registry::instance().find(x))
      refuse(fmt::format("'{}' cannot be a name: Castor has a component class {} already",
                         arguments.name, x));
  for (auto& file : files) {
    if (!file.path.ends_with(".cast"))
      continue;
    for (auto& x : cast::parse_string(file.text, file.path).diagnostics)
      if (x.severity == Severity::error)
        refuse(fmt::format("'{}' cannot be a name in a .cast file: {}", arguments.name, x.message));
  }
  return files;
}

void write_files(const fs::path& folder, const std::vector<ProjectFile>& files) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error)))
    refuse(fmt::format("{} is there already: choose another name, or another folder with --in",
                       folder.string()));
  if (!fs::is_directory(folder.parent_path(), error))
    refuse(fmt::format("--in: there is no folder {}", folder.parent_path().string()));
  if (!fs::create_directory(folder, error))
    refuse(fmt::format("cannot create the folder {}: {}", folder.string(), error.message()));
  try {
    for (auto& file : files) {
      auto stream = create(folder / file.path);
      stream << file.text;
      stream.close();
      if (!stream)
        throw std::runtime_error("cannot write " + (folder / file.path).string());
    }
  } catch (const std::exception&) {
    fs::remove_all(folder, error);
    throw;
  }
}

/// Whether `castor` in a shell is this executable.
bool is_in_path(const fs::path& executable) {
  auto* variable = std::getenv("PATH");
  std::istringstream path{variable ? variable : ""};
  std::error_code error;
  for (std::string folder; std::getline(path, folder, ':');)
    if (auto found = fs::path{folder} / "castor"; fs::exists(found, error))
      return fs::equivalent(found, executable, error);
  return false;
}

/// What has to be done before what was made can be built and run; empty if nothing has.
std::string missing_installation() {
  std::error_code error;
  auto executable = fs::read_symlink("/proc/self/exe", error);
  auto bin = executable.parent_path();
  if (bin.filename() != "bin")
    return "scripts/install          in Castor's source tree, or install the packages castor and "
           "castor-dev: what is made here builds against an installed Castor";
  if (!fs::exists(bin.parent_path() / CASTOR_PACKAGE_FOLDER / "castorConfig.cmake", error))
    return "sudo apt-get install castor-dev          components are built with it; scripts/install "
           "in Castor's source tree installs the same";
  return is_in_path(executable) ? std::string{} : fmt::format("export PATH={}:$PATH", bin.string());
}

int make(const NewArguments& arguments) {
  auto name = project_name(arguments.name);
  if (!name.name)
    refuse(name.problem);
  auto files = files_of(arguments, *name.name);
  auto folder = (arguments.in / arguments.name).lexically_normal();
  write_files(fs::absolute(folder), files);

  auto preparation = missing_installation();
  const std::vector<std::string> commands{
    "cd " + folder.string(),
    "cmake -B build",
    "cmake --build build",
    "ctest --test-dir build",
    fmt::format("castor --plugin build/lib{}.so run {}.cast --trace --until-quiet 1s",
                name.name->library, name.name->name),
  };
  if (arguments.json) {
    Json result{
      {"kind", arguments.kind}, {"name", arguments.name}, {"folder", fs::absolute(folder).string()},
      {"files", Json::array()}, {"before", preparation},  {"next", commands}};
    for (auto& file : files)
      result["files"].push_back(file.path);
    fmt::print("{}\n", result.dump());
    return success;
  }
  fmt::print("made {}:\n", folder.string());
  for (auto& file : files)
    fmt::print("  {}\n", file.path);
  fmt::print("\nNext:\n");
  if (!preparation.empty())
    fmt::print("  {}\n", preparation);
  for (auto& command : commands)
    fmt::print("  {}\n", command);
  return success;
}

} // namespace

void add_new(CLI::App& app, Action& chosen) {
  auto* command =
    app.add_subcommand("new", "create a project with a component, a subarchitecture or a robot");
  auto arguments = std::make_shared<NewArguments>();
  command->add_option("KIND", arguments->kind, "what to make")
    ->required()
    ->type_name("component|subarchitecture|robot");
  command
    ->add_option("NAME", arguments->name,
                 "what it is called, and the folder too: letters, digits, - and _")
    ->required();
  command->add_option("--in", arguments->in, "where the folder is made; by default here")
    ->type_name("DIR");
  add_json_flag(*command, arguments->json);
  command->footer(
    "component         one component, its entry type, a system and a test\n"
    "subarchitecture   two components that meet on a working memory, with a filter\n"
    "robot             two subarchitectures and a sensor outside of them, with access rules\n"
    "What is made builds, runs and passes its test; the commands for that are printed.\n"
    "Examples: castor new component greeter\n"
    "          castor new robot rover --in ~/robots");
  on_call(*command, chosen, arguments, make);
}

} // namespace castor::cli
