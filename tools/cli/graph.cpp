#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/graph_picture.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/inspection_text.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/rasterise.hpp"
#include "castor/tools/cli/running_system.hpp"
#include "castor/tools/cli/writable.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <fstream>
#include <memory>
#include <string>

namespace castor::cli {

namespace {

struct GraphArguments {
  std::string system;
  bool json = false;
  std::string svg;
  std::string png;
};

int graph(const GraphArguments& arguments) {
  auto system = choose_system(arguments.system);
  // What cannot be written is refused before anything is asked for.
  std::ofstream svg;
  std::ofstream png;
  if (!arguments.svg.empty())
    svg = create(arguments.svg);
  if (!arguments.png.empty())
    png = create(arguments.png);
  auto report = ask_for_one(system, {{"do", "ps"}});
  auto accesses = ask_for_all(system, {{"do", "graph"}});
  bool draws = svg.is_open() || png.is_open();
  if (draws) {
    auto picture = usage_as_svg(report, accesses);
    if (svg.is_open())
      svg << picture;
    if (png.is_open())
      png << as_png(picture, 2);
  }
  if (arguments.json)
    for (auto& x : accesses)
      print(x.dump() + '\n');
  else if (!draws)
    print(usage_as_dot(report, accesses));
  return success;
}

} // namespace

void add_graph(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<GraphArguments>();
  auto* command = inspection_command(
    app, "graph", "draw which components write and read which types, as observed so far",
    arguments->system);
  command->add_option("--svg", arguments->svg, "draw it into this file, as an SVG picture")
    ->type_name("FILE")
    ->check(check_output_file);
  command->add_option("--png", arguments->png, "draw it into this file, as a PNG picture")
    ->type_name("FILE")
    ->check(check_output_file);
  add_json_flag(*command, arguments->json);
  command->footer(
    "Without an option, prints the graph in the language of Graphviz, with the types as nodes.\n"
    "In pictures, subarchitectures are boxes with their working memory and components; solid "
    "arrows\nare writes, dashed ones reads and events, with the types of the entries.\n"
    "Examples: castor graph --svg system.svg\n"
    "          castor graph --png system.png --system playmate\n"
    "          castor graph | dot -Tpdf > system.pdf");
  on_call(*command, chosen, arguments, graph);
}

} // namespace castor::cli
