#include "castor/actors/cli/commands.hpp"
#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/plugin.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>

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
  command->footer("Example: castor components --plugin ./libgreeter.so");
  command->callback([&chosen] { chosen = components; });
}

} // namespace castor::cli
