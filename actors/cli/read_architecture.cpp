#include "castor/actors/cli/read_architecture.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/cli/bundled_file.hpp"
#include "castor/actors/cli/output.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <cstdio>

namespace castor::cli {

void add_architecture_arguments(CLI::App& command, ArchitectureArguments& arguments) {
  command
    .add_option("FILE", arguments.file,
                "the .cast file of the system; configs/vision.cast and the like come with Castor")
    ->required();
  command
    .add_option("--set", arguments.variables,
                "define a variable before the file is read (repeatable)")
    ->type_name("NAME=VALUE")
    ->expected(1)
    ->take_all()
    ->check([](const std::string& x) {
      return x.find('=') == x.npos || x.front() == '=' ? "write --set NAME=VALUE, not " + x
                                                       : std::string{};
    });
}

std::map<std::string, std::string> variables_of(const ArchitectureArguments& arguments) {
  std::map<std::string, std::string> result;
  for (auto& x : arguments.variables) {
    auto equals = x.find('=');
    result[x.substr(0, equals)] = x.substr(equals + 1);
  }
  return result;
}

std::optional<ArchitectureDescription> read_architecture(const ArchitectureArguments& arguments,
                                                         bool expand) {
  cast::ParseOptions options;
  options.variables = variables_of(arguments);
  auto result = cast::parse_file(file_or_bundled(arguments.file), options);
  print(result.diagnostics);
  if (expand)
    for (auto& line : result.expansions)
      std::puts(line.c_str());
  return std::move(result.architecture);
}

} // namespace castor::cli
