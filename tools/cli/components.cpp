#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/runtime/plugin.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

std::string keyword(ComponentKind kind) {
  switch (kind) {
    case ComponentKind::working_memory:
      return "working memory (WM)";
    case ComponentKind::task_manager:
      return "task manager (TM)";
    case ComponentKind::managed:
      return "managed (MG)";
    case ComponentKind::unmanaged:
      return "unmanaged (UM)";
    case ComponentKind::standalone:
      return "stand-alone (COMPONENT)";
  }
  return {};
}

void print_option(const OptionBase& x) {
  fmt::print("    --{:<18} {}  [{}; {}]\n", x.name(), x.help(), x.kind(),
             x.text().empty() ? "empty" : x.text());
}

void print_head(const std::string& name, ComponentKind kind, const std::string& help) {
  fmt::print("{}  -  {}\n  {}\n", name, keyword(kind), help);
}

/// What every component understands: the options of a class that adds none.
std::vector<std::string> common_options() {
  class Plain : public SubarchitectureComponent {};
  Plain plain;
  fmt::print("Options of every component:\n");
  std::vector<std::string> names;
  for (auto* option : plain.options().all()) {
    print_option(*option);
    names.push_back(option->name());
  }
  return names;
}

template <class Options>
void print_json(const std::string& name, ComponentKind kind, const std::string& help,
                const Options& options) {
  auto all = nlohmann::ordered_json::array();
  for (auto* x : options)
    all.push_back(
      {{"name", x->name()}, {"kind", x->kind()}, {"default", x->text()}, {"help", x->help()}});
  print(nlohmann::ordered_json{
          {"class", name}, {"kind", to_string(kind)}, {"help", help}, {"options", all}}
          .dump() +
        '\n');
}

int components_as_json() {
  load_bundled_plugins();
  WorkingMemoryClass wm;
  print_json(wm.name, ComponentKind::working_memory, wm.help, wm.options.all());
  for (auto* x : Registry::instance().all())
    print_json(x->name, x->kind, x->help, x->make()->options().all());
  return success;
}

int components() {
  load_bundled_plugins();
  auto common = common_options();
  fmt::print("\n");
  WorkingMemoryClass wm;
  print_head(wm.name, ComponentKind::working_memory, wm.help);
  for (auto* option : wm.options.all())
    print_option(*option);
  for (auto* x : Registry::instance().all()) {
    fmt::print("\n");
    print_head(x->name, x->kind, x->help);
    auto component = x->make();
    for (auto* option : component->options().all())
      if (std::find(common.begin(), common.end(), option->name()) == common.end())
        print_option(*option);
  }
  return success;
}

} // namespace

void add_components(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
    "components", "list every component class with its options and their defaults");
  auto json = std::make_shared<bool>(false);
  add_json_flag(*command, *json);
  command->footer("Examples: castor components\n"
                  "          castor components --plugin ./libgreeter.so --json");
  command->callback(
    [&chosen, json] { chosen = [json] { return *json ? components_as_json() : components(); }; });
}

} // namespace castor::cli
