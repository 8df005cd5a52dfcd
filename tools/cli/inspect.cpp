#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/graph_picture.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/inspection_text.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/rasterise.hpp"
#include "castor/tools/cli/read_architecture.hpp"
#include "castor/tools/cli/running_system.hpp"
#include "castor/tools/cli/tethers.hpp"
#include "castor/tools/cli/timeline.hpp"
#include "castor/tools/cli/writable.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>
#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace castor::cli {

namespace {

struct Arguments {
  std::string system;
  bool json = false;
  bool stats = false;
  bool full = false;
  bool wait = false;
  /// What is looked at: SUBARCHITECTURE[/ID|TYPE].
  std::string where;
  std::vector<std::string> filter;
  std::string name;
  std::string svg;
  std::string png;
  ArchitectureArguments architecture;
};

using ArgumentsPtr = std::shared_ptr<Arguments>;

bool coloured() {
  return isatty(STDOUT_FILENO) != 0;
}

int ps(const Arguments& arguments) {
  std::vector<RunningSystem> systems;
  if (arguments.system.empty())
    systems = running_systems();
  if (systems.empty())
    systems.push_back(choose_system(arguments.system));
  const char* separator = "";
  for (auto& x : systems) {
    auto report = ask_for_one(x, {{"do", "ps"}});
    print(arguments.json ? report.dump() + '\n'
                         : separator + system_as_text(report, arguments.stats));
    separator = "\n";
  }
  return success;
}

/// SUBARCHITECTURE[/ID|TYPE], as a request has it.
Json request_for(const Arguments& arguments, bool values) {
  auto [subarchitecture, what] = split_where(arguments.where);
  Json result{{"do", "wm"},
              {"subarchitecture", subarchitecture},
              {"values", values},
              {"full", arguments.full}};
  if (!what.empty())
    result["what"] = what;
  return result;
}

/// The types are known, or the system would have refused the request.
void say_if_empty(const std::vector<Json>& entries, const Arguments& arguments) {
  if (entries.empty())
    fmt::print(stderr, "there are no entries of {}\n", arguments.where);
}

void print_entries(const std::vector<Json>& entries, const Arguments& arguments) {
  if (!arguments.json) {
    print(entries_as_text(entries));
    return;
  }
  for (auto& x : entries)
    print(x.dump() + '\n');
}

int list_entries(const Arguments& arguments) {
  auto system = choose_system(arguments.system);
  if (!arguments.where.empty()) {
    auto entries = ask_for_all(system, request_for(arguments, false));
    say_if_empty(entries, arguments);
    print_entries(entries, arguments);
    return success;
  }
  std::vector<Json> entries;
  auto report = ask_for_one(system, {{"do", "ps"}});
  for (auto& wm : report["working_memories"])
    for (auto& x : ask_for_all(system, {{"do", "wm"}, {"subarchitecture", wm["subarchitecture"]}}))
      entries.push_back(x);
  print_entries(entries, arguments);
  return success;
}

int get_entries(const Arguments& arguments) {
  auto system = choose_system(arguments.system);
  auto entries = ask_for_all(system, request_for(arguments, true));
  say_if_empty(entries, arguments);
  for (auto& x : entries)
    print((arguments.json ? x.dump() : x["value"].dump(2)) + '\n');
  return success;
}

/// What binding has, and what that is tethered to.
std::vector<Json> tethered_entries(const RunningSystem& system) {
  auto report = ask_for_one(system, {{"do", "ps"}});
  auto& working_memories = report["working_memories"];
  std::vector<Json> result;
  bool there_is_binding = false;
  auto read = [&](const Json& subarchitecture, const std::string& what) {
    for (auto& x : ask_for_all(
           system,
           {{"do", "wm"}, {"subarchitecture", subarchitecture}, {"what", what}, {"values", true}}))
      result.push_back(x);
  };
  for (auto& wm : working_memories)
    for (auto& [type, count] : wm["entries_by_type"].items())
      if (is_of_binding(type)) {
        there_is_binding = true;
        read(wm["subarchitecture"], type);
      }
  if (!there_is_binding)
    throw std::runtime_error("there is no binding in this system: no working memory has an entry "
                             "of the type BindingProxy, BindingUnion or BinderStatus");
  auto wanted = tethered_subarchitectures(result);
  for (auto& wm : working_memories)
    if (wanted.contains(wm["subarchitecture"]))
      read(wm["subarchitecture"], "");
  return result;
}

std::string why_nothing_is_tethered(const std::string& where, const std::vector<Json>& entries) {
  if (where.empty())
    return "binding has no unions yet";
  auto types = tethered_types(entries);
  if (types.empty())
    return "no proxy is tethered to anything";
  return fmt::format("no proxy is tethered to {}; proxies are tethered to entries of {}", where,
                     fmt::join(types, ", "));
}

int show_tethers(const Arguments& arguments) {
  auto system = choose_system(arguments.system);
  auto entries = tethered_entries(system);
  std::vector<Json> roots;
  if (arguments.where.empty())
    roots = unions_among(entries);
  else
    roots = ask_for_all(system, request_for(arguments, true));
  auto trees = follow_tethers(roots, entries);
  if (trees.empty())
    throw std::runtime_error(why_nothing_is_tethered(arguments.where, entries));
  if (!arguments.json) {
    print(tethers_as_text(trees));
    return success;
  }
  for (auto& x : trees)
    print(x.dump() + '\n');
  return success;
}

int follow(const Arguments& arguments, const Json& request) {
  auto system = choose_system(arguments.system);
  if (!arguments.json)
    print(timeline_head(coloured()) + '\n');
  ask(system, request, [&](const Json& x) {
    print(arguments.json ? x.dump() + '\n' : change_as_text(x, coloured()));
  });
  return success;
}

int watch_entries(const Arguments& arguments) {
  auto request = request_for(arguments, true);
  request["do"] = "events";
  request["wait"] = arguments.wait;
  request["filter"] = "in " + request["subarchitecture"].get<std::string>();
  return follow(arguments, request);
}

int events(const Arguments& arguments) {
  return follow(arguments, {{"do", "events"},
                            {"filter", fmt::format("{}", fmt::join(arguments.filter, " "))},
                            {"wait", arguments.wait}});
}

int graph(const Arguments& arguments) {
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

int change(const Arguments& arguments, const Json& request, const char* verb) {
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

int add(const Arguments& arguments) {
  std::error_code error;
  const auto directory = std::filesystem::current_path(error);
  if (error)
    throw std::runtime_error("the folder of this process cannot be used: " + error.message() +
                             "; go to one that is there");
  Json variables = Json::object();
  for (auto& [name, value] : variables_of(arguments.architecture))
    variables[name] = value;
  return change(arguments,
                {{"do", "add"},
                 {"file", (directory / arguments.architecture.file).string()},
                 {"directory", directory.string()},
                 {"variables", variables}},
                "added");
}

int remove(const Arguments& arguments) {
  return change(arguments, {{"do", "remove"}, {"name", arguments.name}}, "removed");
}

CLI::App* command(CLI::App& app, const std::string& name, const std::string& help,
                  const ArgumentsPtr& arguments) {
  return inspection_command(app, name, help, arguments->system);
}

void add_json_flag(CLI::App& command, const ArgumentsPtr& arguments) {
  cli::add_json_flag(command, arguments->json);
}

void add_wait_flag(CLI::App& command, const ArgumentsPtr& arguments) {
  command.add_flag("--wait", arguments->wait,
                   "also for types, components and subarchitectures that are not there yet: do not "
                   "check whether the system knows the names");
}

template <class F>
void on_call(CLI::App& command, Action& chosen, const ArgumentsPtr& arguments, F f) {
  command.callback([&chosen, arguments, f] { chosen = [arguments, f] { return f(*arguments); }; });
}

CLI::App* entry_command(CLI::App& wm, const std::string& name, const std::string& help,
                        const ArgumentsPtr& arguments) {
  auto* result = command(wm, name, help, arguments);
  result->add_option("WHERE", arguments->where, "the subarchitecture, and perhaps an id or a type")
    ->type_name("SUBARCHITECTURE[/ID|TYPE]");
  add_json_flag(*result, arguments);
  return result;
}

void add_full_flag(CLI::App& command, const ArgumentsPtr& arguments) {
  command.add_flag("--full", arguments->full, "show byte fields, however long, as base64 text");
}

void add_wm(CLI::App& app, Action& chosen) {
  auto* wm =
    app.add_subcommand("wm", "look into the working memories of a running system, and change them");
  wm->require_subcommand(1);
  auto arguments = std::make_shared<Arguments>();
  auto* ls = entry_command(*wm, "ls", "list entries", arguments);
  on_call(*ls, chosen, arguments, list_entries);
  auto* get = entry_command(*wm, "get", "print the values of entries", arguments);
  get->get_option("WHERE")->required();
  add_full_flag(*get, arguments);
  on_call(*get, chosen, arguments, get_entries);
  auto* watch =
    entry_command(*wm, "watch", "print changes with the new values, as they happen", arguments);
  watch->get_option("WHERE")->required();
  add_full_flag(*watch, arguments);
  add_wait_flag(*watch, arguments);
  on_call(*watch, chosen, arguments, watch_entries);
  auto* tether = entry_command(
    *wm, "tether", "show what binding's unions are made of, or what binding makes of entries",
    arguments);
  on_call(*tether, chosen, arguments, show_tethers);
  tether->footer("From a union over its proxies to the entries that they stand for, and from such "
                 "an entry to its proxies and\nto the unions that they are in; from every union "
                 "if WHERE is left out.");
  add_wm_writes(*wm, chosen);
  wm->footer("Examples: castor wm ls\n"
             "          castor wm get vision/SceneObject\n"
             "          castor wm types SceneObject\n"
             "          castor wm add kitchen Order '{\"dish\": \"soup\", \"table\": 4}'\n"
             "          castor wm overwrite kitchen/order7 --merge '{\"table\": 5}'\n"
             "          castor wm delete kitchen/order7\n"
             "          castor wm watch vision/0:3 --json\n"
             "          castor wm tether vision/0:3");
}

} // namespace

void add_inspection(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<Arguments>();
  auto* ps_command =
    command(app, "ps", "show the systems that run: nodes, components, working memories", arguments);
  add_json_flag(*ps_command, arguments);
  ps_command->add_flag("--stats", arguments->stats,
                       "count what became of change events, and what every link has carried");
  ps_command->footer("Load is the part of a processor that was used, on average since the start; "
                     "busy is for how long a component has had something to do without a pause.\n"
                     "Example: castor ps --stats");
  on_call(*ps_command, chosen, arguments, ps);

  add_wm(app, chosen);

  arguments = std::make_shared<Arguments>();
  auto* events_command =
    command(app, "events", "print the changes in a running system, as they happen", arguments);
  events_command
    ->add_option("FILTER", arguments->filter,
                 "[added|overwritten|deleted|changed] [TYPE] [in SUBARCHITECTURE] "
                 "[from COMPONENT] [at ID] [changing FIELD,...] [where CONDITION]")
    ->type_name("");
  add_json_flag(*events_command, arguments);
  add_wait_flag(*events_command, arguments);
  events_command->footer(
    "Examples: castor events\n"
    "          castor events overwritten SceneObject in vision changing color\n"
    "          castor events added ROI where 'area > 400'\n"
    "Events are filtered where they arise. A reader that is too slow gets them merged.");
  on_call(*events_command, chosen, arguments, events);

  arguments = std::make_shared<Arguments>();
  auto* graph_command =
    command(app, "graph", "draw who writes and reads what, as observed so far", arguments);
  graph_command->add_option("--svg", arguments->svg, "draw it into this file, as an SVG picture")
    ->type_name("FILE")
    ->check(check_output_file);
  graph_command->add_option("--png", arguments->png, "draw it into this file, as a PNG picture")
    ->type_name("FILE")
    ->check(check_output_file);
  add_json_flag(*graph_command, arguments);
  graph_command->footer(
    "Without an option, prints the graph in the language of Graphviz, with the types as nodes.\n"
    "In pictures, subarchitectures are boxes with their working memory and components; solid "
    "arrows\nare writes, dashed ones reads and events, with the types of the entries.\n"
    "Examples: castor graph --svg system.svg\n"
    "          castor graph --png system.png --system playmate\n"
    "          castor graph | dot -Tpdf > system.pdf");
  on_call(*graph_command, chosen, arguments, graph);

  arguments = std::make_shared<Arguments>();
  auto* add_command =
    command(app, "add", "join what a .cast file describes to a running system", arguments);
  add_architecture_arguments(*add_command, arguments->architecture);
  add_command->footer(
    "The file has whole subarchitectures, or lines for subarchitectures that run: these have "
    "neither a WM nor a TM line.\nIf anything stands in the way, the system stays as it was.\n"
    "Example: castor add touch.cast --system playmate");
  add_json_flag(*add_command, arguments);
  on_call(*add_command, chosen, arguments, add);

  arguments = std::make_shared<Arguments>();
  auto* remove_command =
    command(app, "remove", "stop a component or a subarchitecture of a running system", arguments);
  remove_command->add_option("NAME", arguments->name, "of the component or the subarchitecture")
    ->required();
  add_json_flag(*remove_command, arguments);
  remove_command->footer("Examples: castor remove recogniser\n"
                         "          castor remove speech");
  on_call(*remove_command, chosen, arguments, remove);
}

} // namespace castor::cli
