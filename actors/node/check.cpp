#include "castor/actors/node/check.hpp"

#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/plugin.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace castor {

namespace {

using Diagnostics = std::vector<cast::Diagnostic>;

void add(Diagnostics& out, const ComponentDescription& x, std::string message,
         std::string remedy = {}) {
  out.push_back(
    {cast::Severity::error, x.where, x.line, {}, std::move(message), std::move(remedy)});
}

/// The word for a kind on a component line.
std::string keyword(ComponentKind kind) {
  switch (kind) {
    case ComponentKind::working_memory:
      return "WM";
    case ComponentKind::task_manager:
      return "TM";
    case ComponentKind::managed:
      return "MG";
    case ComponentKind::unmanaged:
      return "UM";
    case ComponentKind::standalone:
      return "COMPONENT";
  }
  return {};
}

bool is_this_machine(const std::string& host) {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return host.empty() || host == "localhost" || host == "127.0.0.1" || host == "::1" ||
         host == name.data();
}

void check_options(Diagnostics& out, const ComponentDescription& x, OptionList& options) {
  for (auto& setting : x.options)
    if (auto problem = options.set(setting.name(), setting.value))
      add(out, x, x.class_name + " of " + x.name + ": " + *problem);
}

void check_component(Diagnostics& out, const ComponentDescription& x) {
  if (!is_this_machine(x.host))
    add(out, x, x.name + " is to run on the host " + x.host + ", which is not this machine",
        "systems run in one process so far: name no host, or localhost");
  if (x.kind == ComponentKind::working_memory) {
    WorkingMemoryClass wm;
    if (x.class_name != wm.name)
      add(out, x, "there is no working memory class " + x.class_name,
          std::string{"write CPP WM "} + wm.name);
    else
      check_options(out, x, wm.options);
    return;
  }
  auto lookup = find_class(x.class_name);
  if (!lookup.found) {
    add(out, x, lookup.problem);
    return;
  }
  if (lookup.found->kind != x.kind) {
    add(out, x,
        x.class_name + " is not for a " + keyword(x.kind) + " line: it is made for " +
          keyword(lookup.found->kind));
    return;
  }
  auto component = lookup.found->make();
  check_options(out, x, component->options());
}

} // namespace

std::vector<cast::Diagnostic> check_classes(const ArchitectureDescription& architecture) {
  Diagnostics out;
  for (auto& subarchitecture : architecture.subarchitectures) {
    check_component(out, subarchitecture.working_memory);
    check_component(out, subarchitecture.task_manager);
    for (auto& x : subarchitecture.components)
      check_component(out, x);
  }
  for (auto& x : architecture.standalone)
    check_component(out, x);
  return out;
}

} // namespace castor
