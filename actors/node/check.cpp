#include "castor/actors/node/check.hpp"

#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/plugin.hpp"

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

void check_options(Diagnostics& out, const ComponentDescription& x, OptionList& options) {
  for (auto& setting : x.options)
    if (auto problem = options.set(setting.name(), setting.value))
      add(out, x, x.class_name + " of " + x.name + ": " + *problem);
}

} // namespace

void check_class(const ComponentDescription& x, Diagnostics& out) {
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

std::vector<cast::Diagnostic> check_classes(const ArchitectureDescription& architecture) {
  Diagnostics out;
  for_each_component(architecture, [&](auto& x) { check_class(x, out); });
  return out;
}

} // namespace castor
