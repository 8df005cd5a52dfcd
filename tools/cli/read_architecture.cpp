#include "castor/tools/cli/read_architecture.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/tools/cli/bundled_file.hpp"
#include "castor/tools/cli/output.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace castor::cli {

void add_architecture_arguments(CLI::App& command, ArchitectureArguments& arguments) {
  command
    .add_option("FILE", arguments.file,
                "the .cast file of the system; configs/vision.cast and the like come with Castor")
    ->required();
  add_set_option(command, arguments);
}

void add_set_option(CLI::App& command, ArchitectureArguments& arguments) {
  command
    .add_option("--set", arguments.variables,
                "define a variable before the file is read (repeatable)")
    ->type_name("NAME=VALUE")
    ->check([](const std::string& x) {
      return x.find('=') == x.npos || x.front() == '=' ? "write --set NAME=VALUE, not " + x
                                                       : std::string{};
    });
}

std::map<std::string, std::string> variables_of(const ArchitectureArguments& arguments) {
  std::map<std::string, std::string> result;
  for (auto& x : arguments.variables) {
    auto equals = x.find('=');
    auto name = x.substr(0, equals);
    if (!result.emplace(name, x.substr(equals + 1)).second)
      throw std::runtime_error("--set gives the variable " + name +
                               " a value twice; leave one of them out");
  }
  return result;
}

namespace {

cast::ParseOptions options_of(const ArchitectureArguments& arguments) {
  cast::ParseOptions result;
  result.variables = variables_of(arguments);
  result.offered_variables = arguments.offered;
  return result;
}

/// The subarchitectures that a file takes to be there: without lines for a working memory and a
/// task manager, or only named in access rules, and not misspelt there.
std::set<std::string, std::less<>> taken_to_run(const ArchitectureDescription& understood) {
  std::set<std::string, std::less<>> result;
  std::vector<std::string_view> own;
  for (auto& x : understood.subarchitectures) {
    own.push_back(x.name);
    if (x.working_memory.name.empty() && x.task_manager.name.empty())
      result.insert(x.name);
  }
  for (auto& rule : understood.access_rules)
    for (auto& x : {rule.writer, rule.owner})
      if (x != "*" && std::ranges::count(own, x) == 0 && nearest(x, own).empty())
        result.insert(x);
  return result;
}

/// A remark on a file that would have no errors where such subarchitectures run.
std::optional<Diagnostic> as_addition(const ArchitectureArguments& arguments,
                                      const ArchitectureDescription& understood) {
  auto options = options_of(arguments);
  options.running_subarchitectures = taken_to_run(understood);
  auto& needed = options.running_subarchitectures;
  if (needed.empty() || !cast::parse_file(file_or_bundled(arguments.file), options).ok())
    return std::nullopt;
  return Diagnostic{
    Severity::note,
    SourceLocation{arguments.file, 0},
    {},
    {},
    fmt::format("the file has lines for a system that runs, with {}", fmt::join(needed, ", ")),
    "join them to it with `castor add " + arguments.file + "`"};
}

} // namespace

cast::ParseResult parse_architecture(const ArchitectureArguments& arguments) {
  return cast::parse_file(file_or_bundled(arguments.file), options_of(arguments));
}

namespace {

/// "did you mean 'vision.cast'?", of the .cast files beside one that is not there; empty for none.
std::string file_meant(const std::string& file) {
  namespace fs = std::filesystem;
  const fs::path path{file};
  std::error_code error;
  if (fs::exists(path, error))
    return {};
  auto folder = path.parent_path();
  std::vector<std::string> names;
  for (fs::directory_iterator i{folder.empty() ? fs::path{"."} : folder, error}, end;
       !error && i != end && names.size() < most_candidates; i.increment(error))
    if (i->path().extension() == ".cast")
      names.push_back((folder / i->path().filename()).string());
  std::ranges::sort(names);
  return did_you_mean(file, {names.begin(), names.end()});
}

} // namespace

std::vector<Diagnostic> findings_in(cast::ParseResult& parsed,
                                    const ArchitectureArguments& arguments, Classes classes) {
  auto addition =
    parsed.ok() ? std::nullopt : as_addition(arguments, parsed.understood.architecture);
  auto result = all_findings(parsed, classes);
  if (addition)
    result.push_back(*std::move(addition));
  if (result.size() == 1 && result.front().remedy.empty())
    result.front().remedy = file_meant(arguments.file);
  return result;
}

std::optional<ArchitectureDescription> read_architecture(const ArchitectureArguments& arguments) {
  auto parsed = parse_architecture(arguments);
  print(findings_in(parsed, arguments, Classes::on_this_machine));
  return std::move(parsed.architecture);
}

} // namespace castor::cli
