#include "castor/actors/node/check.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/runtime/plugin.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace castor {

namespace {

using Diagnostics = std::vector<Diagnostic>;

void add(Diagnostics& out, const ComponentDescription& x, std::string message,
         std::string remedy = {}) {
  out.push_back({Severity::error, x.where, x.line, {}, std::move(message), std::move(remedy)});
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

constexpr std::size_t most_listed = 20;

/// What to do about a name that is not known.
std::string remedy_for(const Diagnostics& out, std::string_view name,
                       const std::set<std::string, std::less<>>& known, std::string_view kind,
                       std::string otherwise) {
  if (known.empty() || out.size() >= most_explained)
    return otherwise;
  auto guess = did_you_mean(name, {known.begin(), known.end()});
  if (!guess.empty())
    return guess;
  return otherwise + "; the " + std::string{kind} + " are: " + list_of(known, most_listed);
}

/// An option names something that the system has to have.
void check_reference(Diagnostics& out, const ComponentDescription& x, const OptionBase& option,
                     const SystemNames& names) {
  if (option.reference() == Reference::none)
    return;
  auto name = option.text();
  if (name.empty() || names.is_incomplete || names.doubtful.contains(name))
    return;
  bool is_default = !x.option(option.name());
  // Subarchitectures may be left out of a system, and the others do without.
  if (is_default && option.reference() == Reference::subarchitecture)
    return;
  auto says = x.class_name + " of " + x.name + ": --" + option.name() +
              (is_default ? ", by default " + in_quotes(name) + ", " : " " + in_quotes(name) + ' ');
  switch (option.reference()) {
    case Reference::none:
      return;
    case Reference::subarchitecture:
      if (!names.subarchitectures.contains(name))
        add(out, x, says + "names a subarchitecture that the system does not have",
            remedy_for(out, name, names.subarchitectures, "subarchitectures",
                       "give --" + option.name() + " the name of one that it has"));
      return;
    case Reference::standalone:
      if (names.standalone.contains(name))
        return;
      if (names.in_subarchitectures.contains(name))
        add(out, x, says + "names a component that is not stand-alone",
            "only components of COMPONENT lines can be pulled from");
      else
        add(out, x, says + "names a stand-alone component that the system does not have",
            remedy_for(out, name, names.standalone, "stand-alone components",
                       "add the line: COMPONENT CPP " + name + " Class"));
      return;
    case Reference::component:
      if (names.standalone.contains(name) || names.in_subarchitectures.contains(name))
        return;
      auto all = names.standalone;
      all.insert(names.in_subarchitectures.begin(), names.in_subarchitectures.end());
      add(out, x, says + "names a component that the system does not have",
          remedy_for(out, name, all, "components",
                     "give --" + option.name() + " the name of one that it has"));
      return;
  }
}

void check_options(Diagnostics& out, const ComponentDescription& x, OptionList& options,
                   const SystemNames& names) {
  for (auto& setting : x.options) {
    // An environment variable that is not set, as the parser has reported.
    if (setting.value.starts_with('$'))
      continue;
    if (auto problem = options.set(setting.name(), setting.value))
      add(out, x, x.class_name + " of " + x.name + ": " + *problem);
  }
  for (auto* option : options.all())
    check_reference(out, x, *option, names);
}

/// Without those that a file with errors lacks.
template <class F>
void for_each_described(const ArchitectureDescription& architecture, F&& f) {
  for_each_component(architecture, [&](const ComponentDescription& x) {
    if (!x.class_name.empty())
      f(x);
  });
}

} // namespace

void SystemNames::add(const ArchitectureDescription& architecture) {
  doubtful.insert(architecture.left_out.begin(), architecture.left_out.end());
  subarchitectures.emplace(health_subarchitecture);
  for (auto& x : architecture.subarchitectures) {
    subarchitectures.insert(x.name);
    for (auto& y : x.components)
      in_subarchitectures.insert(y.name);
  }
  for (auto& x : architecture.standalone)
    standalone.insert(x.name);
}

namespace {

/// Makes a component, has it looked at, and destroys it. Returns what does not come to an end;
/// empty if everything does.
using Inspect = std::string (*)(const ComponentClass&, const std::function<void(Component&)>& look);

std::string inspect_here(const ComponentClass& x, const std::function<void(Component&)>& look) {
  look(*x.make());
  return {};
}

/// How long a constructor or a destructor may take.
constexpr std::chrono::seconds life_cycle_patience{5};

/// In a thread of its own, which is left behind if it does not come back.
std::string inspect_elsewhere(const ComponentClass& x,
                              const std::function<void(Component&)>& look) {
  struct Steps {
    std::promise<Component*> made;
    std::promise<void> looked_at;
    std::promise<void> destroyed;
  };
  auto steps = std::make_shared<Steps>();
  auto made = steps->made.get_future();
  auto destroyed = steps->destroyed.get_future();
  std::thread thread{[steps, make = x.make] {
    try {
      auto component = make();
      steps->made.set_value(component.get());
      steps->looked_at.get_future().wait();
    } catch (...) {
      steps->made.set_exception(std::current_exception());
    }
    steps->destroyed.set_value();
  }};
  auto seconds = std::to_string(life_cycle_patience.count()) + " s";
  if (made.wait_for(life_cycle_patience) != std::future_status::ready) {
    thread.detach();
    return "the constructor does not return within " + seconds;
  }
  std::exception_ptr problem;
  try {
    look(*made.get());
  } catch (...) {
    problem = std::current_exception();
  }
  steps->looked_at.set_value();
  if (destroyed.wait_for(life_cycle_patience) != std::future_status::ready) {
    thread.detach();
    return "the destructor does not return within " + seconds;
  }
  thread.join();
  if (problem)
    std::rethrow_exception(problem);
  return {};
}

void check_class_with(Inspect inspect, const ComponentDescription& x, const SystemNames& names,
                      Diagnostics& out) {
  if (x.kind == ComponentKind::working_memory) {
    WorkingMemoryClass wm;
    if (x.class_name != wm.name)
      add(out, x, "there is no working memory class " + x.class_name,
          std::string{"write CPP WM "} + wm.name);
    else
      check_options(out, x, wm.options, names);
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
  auto problem = inspect(*lookup.found, [&](Component& component) {
    check_options(out, x, component.options(), names);
  });
  if (!problem.empty())
    add(out, x, x.class_name + " of " + x.name + ": " + problem,
        "constructors declare options, and destructors release resources: neither may wait");
}

} // namespace

void check_class(const ComponentDescription& x, const SystemNames& names, Diagnostics& out) {
  check_class_with(inspect_here, x, names, out);
}

std::vector<Diagnostic> check_architecture(const ArchitectureDescription& architecture) {
  auto out = place(architecture, {}).problems;
  const SystemNames names{architecture};
  for_each_described(architecture,
                     [&](auto& x) { check_class_with(inspect_elsewhere, x, names, out); });
  sort_by_line(out);
  return out;
}

std::vector<Diagnostic> all_findings(cast::ParseResult& result, Classes classes,
                                     SystemNames names) {
  auto out = std::move(result.diagnostics);
  if (result.ok())
    return out;
  auto& understood = result.understood;
  auto placement = place(understood.architecture, {});
  std::move(placement.problems.begin(), placement.problems.end(), std::back_inserter(out));
  names.add(understood.architecture);
  names.doubtful = std::move(understood.doubtful);
  names.is_incomplete = understood.is_incomplete;
  for_each_described(understood.architecture, [&](auto& x) {
    if (classes == Classes::all || !placement.of.contains(x.name))
      check_class_with(inspect_elsewhere, x, names, out);
  });
  sort_by_line(out);
  return out;
}

std::vector<Diagnostic> problems_of(const Placement& placement,
                                    const ArchitectureDescription& architecture) {
  auto out = placement.problems;
  if (out.empty())
    return out;
  const SystemNames names{architecture};
  for_each_described(architecture, [&](auto& x) {
    if (!placement.of.contains(x.name))
      check_class_with(inspect_elsewhere, x, names, out);
  });
  sort_by_line(out);
  return out;
}

} // namespace castor
