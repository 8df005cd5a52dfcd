#include "castor/actors/node/check.hpp"
#include "castor/actors/cast/json.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/base/text.hpp"
#include "castor/tools/cli/bundled_file.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/read_architecture.hpp"
#include "castor/tools/cli/read_plan.hpp"
#include "castor/tools/cli/read_workload.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>

namespace castor::cli {

namespace {

struct CheckArguments {
  ArchitectureArguments architecture;
  std::string plan;
  std::string workload;
  int spread = 0;
  bool expand = false;
  bool json = false;
};

std::size_t count_components(const ArchitectureDescription& x) {
  auto result = x.standalone.size();
  for (auto& subarchitecture : x.subarchitectures)
    result += subarchitecture.components.size();
  return result;
}

int check(const CheckArguments& arguments) {
  auto parsed = parse_architecture(arguments.architecture);
  auto& architecture = parsed.architecture;
  auto findings = findings_in(parsed, arguments.architecture, Classes::all);
  bool is_good = architecture.has_value();
  if (architecture) {
    auto problems = check_architecture(*architecture);
    is_good = problems.empty();
    std::move(problems.begin(), problems.end(), std::back_inserter(findings));
    sort_by_line(findings);
  }
  print(findings);
  if (arguments.expand)
    for (auto& line : parsed.expansions)
      std::puts(printable(line).c_str());
  if (!architecture)
    return 1;
  if (arguments.spread > 0)
    spread(*architecture, arguments.spread);
  if (!arguments.plan.empty())
    is_good = read_plan(arguments.plan, targets_in(*architecture)).has_value() && is_good;
  if (!arguments.workload.empty())
    is_good =
      read_workload(file_or_bundled(arguments.workload), *architecture).has_value() && is_good;
  if (arguments.json)
    fmt::print("{}\n", nlohmann::ordered_json::parse(to_json(*architecture)).dump());
  if (!is_good)
    return 1;
  if (!arguments.json && !arguments.expand)
    fmt::print("{}: {} subarchitectures, {} components, no errors\n", arguments.architecture.file,
               architecture->subarchitectures.size(), count_components(*architecture));
  return 0;
}

} // namespace

void add_check(CLI::App& app, Action& chosen) {
  auto* command =
    app.add_subcommand("check", "report the errors of a .cast file without running it");
  auto arguments = std::make_shared<CheckArguments>();
  add_architecture_arguments(*command, arguments->architecture);
  command->add_option("--plan", arguments->plan, "check a fault plan against the system, too")
    ->type_name("FILE");
  command->add_option("--workload", arguments->workload, "check a workload against the system, too")
    ->type_name("FILE");
  command
    ->add_option("--spread", arguments->spread,
                 "as for `castor run`: the plan's nodes are node1 and so on")
    ->type_name("N")
    ->check(CLI::Range(1, 100));
  command->add_flag("--expand", arguments->expand,
                    "print the file's #EXPAND comments with their variables replaced");
  command->add_flag("--json", arguments->json, "print the parsed architecture");
  command->footer(
    "Every error is printed, not only the first.\n"
    "Exit status: 0 if there is no error, 1 if there is any, 2 if the command line is wrong.\n"
    "Example: castor check configs/vision.cast --set source=scene:scenes/blue-square.scene");
  on_call(*command, chosen, arguments, check);
}

} // namespace castor::cli
