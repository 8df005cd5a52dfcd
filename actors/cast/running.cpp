#include "castor/actors/cast/running.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/wm/entries/client.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace castor::cast {

namespace {

Diagnostic error_at(const ComponentDescription& x, std::string message, std::string remedy) {
  return {Severity::error, x.where, x.line, {}, std::move(message), std::move(remedy)};
}

/// Whether the lines of a subarchitecture that runs can be added to it.
void check_addition(const SubarchitectureDescription& added, std::vector<Diagnostic>& problems) {
  for (auto* x : {&added.working_memory, &added.task_manager})
    if (!x->name.empty())
      problems.push_back(error_at(*x,
                                  "the subarchitecture " + added.name + " runs and has its " +
                                    std::string{to_string(x->kind)},
                                  "leave the line out, or give the subarchitecture another name"));
}

void check_names(const ArchitectureDescription& running, const ArchitectureDescription& added,
                 std::vector<Diagnostic>& problems) {
  for_each_component(added, [&](auto& x) {
    // Of those that the language names, the subarchitecture was checked.
    bool has_name =
      x.kind != ComponentKind::working_memory && x.kind != ComponentKind::task_manager;
    if (has_name && running.component(x.name))
      problems.push_back(
        error_at(x, "there is a component " + x.name + " in the running system",
                 "give it another name, or remove the other with `castor remove " + x.name + "`"));
  });
}

void check_hosts(const ArchitectureDescription& running, const ArchitectureDescription& added,
                 std::vector<Diagnostic>& problems) {
  for (auto& [name, definition] : added.host_names) {
    auto known = running.host_names.find(name);
    if (known != running.host_names.end() && known->second != definition)
      problems.push_back({Severity::error,
                          SourceLocation{added.file, 0},
                          {},
                          {},
                          "in the running system, " + name + " is the host " + known->second +
                            ", here it is " + definition,
                          "use another name for the host"});
  }
}

SubarchitectureDescription* find(ArchitectureDescription& architecture, const std::string& name) {
  auto i = std::find_if(architecture.subarchitectures.begin(), architecture.subarchitectures.end(),
                        [&](auto& x) { return x.name == name; });
  return i == architecture.subarchitectures.end() ? nullptr : &*i;
}

Removal remove_subarchitecture(ArchitectureDescription& running, const std::string& name) {
  Removal result;
  auto& x = *find(running, name);
  for (auto i = x.components.rbegin(); i != x.components.rend(); ++i)
    result.components.push_back(i->name);
  result.components.push_back(x.task_manager.name);
  std::erase_if(running.subarchitectures, [&](auto& y) { return y.name == name; });
  // Without their last rule operators might write everywhere.
  std::erase_if(running.access_rules, [&](auto& y) {
    return y.writer == name || (y.owner == name && y.writer != operators);
  });
  std::erase_if(running.read_rules,
                [&](auto& y) { return y.owner == name || (y.owner == "*" && y.reader == name); });
  for (auto& rule : running.read_rules)
    // Without its last reader everybody might read there.
    if (rule.reader == name)
      rule.reader = rule.owner;
  std::erase_if(running.supervision, [&](auto& y) { return y.who == name; });
  std::erase_if(running.failover, [&](auto& y) { return y.who == name; });
  return result;
}

} // namespace

std::vector<Diagnostic> join(ArchitectureDescription& running, ArchitectureDescription added,
                             std::size_t& next_number) {
  std::vector<Diagnostic> problems;
  for (auto& x : added.subarchitectures)
    if (find(running, x.name))
      check_addition(x, problems);
  check_names(running, added, problems);
  check_hosts(running, added, problems);
  if (!problems.empty())
    return problems;
  for_each_component(added, [&](ComponentDescription& x) {
    if (!x.name.empty())
      x.number = next_number++;
  });
  for (auto& x : added.subarchitectures) {
    if (auto* known = find(running, x.name))
      std::move(x.components.begin(), x.components.end(), std::back_inserter(known->components));
    else
      running.subarchitectures.push_back(std::move(x));
  }
  std::move(added.standalone.begin(), added.standalone.end(),
            std::back_inserter(running.standalone));
  std::move(added.access_rules.begin(), added.access_rules.end(),
            std::back_inserter(running.access_rules));
  // How the system itself and what runs in it are supervised was said when it was started.
  std::erase_if(added.supervision, [&](auto& x) {
    return std::any_of(running.supervision.begin(), running.supervision.end(),
                       [&](auto& y) { return y.who == x.who; });
  });
  std::move(added.supervision.begin(), added.supervision.end(),
            std::back_inserter(running.supervision));
  std::move(added.failover.begin(), added.failover.end(), std::back_inserter(running.failover));
  running.host_names.merge(added.host_names);
  return problems;
}

Removal remove(ArchitectureDescription& running, const std::string& name) {
  if (find(running, name))
    return remove_subarchitecture(running, name);
  Removal result;
  auto* component = running.component(name);
  if (!component) {
    std::vector<std::string_view> names;
    for_each_component(running, [&](auto& x) { names.push_back(x.name); });
    for (auto& x : running.subarchitectures)
      names.push_back(x.name);
    auto guess = did_you_mean(name, names);
    result.problem = "the running system has neither a component nor a subarchitecture " + name +
                     (guess.empty() ? "" : "; " + guess);
    return result;
  }
  if (component->kind == ComponentKind::working_memory ||
      component->kind == ComponentKind::task_manager) {
    result.problem = "a subarchitecture cannot do without its " +
                     std::string{to_string(component->kind)} + ": remove " +
                     component->subarchitecture + " as a whole";
    return result;
  }
  result.components.push_back(name);
  auto is_it = [&](auto& x) { return x.name == name; };
  for (auto& x : running.subarchitectures)
    std::erase_if(x.components, is_it);
  std::erase_if(running.standalone, is_it);
  std::erase_if(running.failover, [&](auto& x) { return x.who == name; });
  return result;
}

} // namespace castor::cast
