#include "castor/tools/chaos/fault_targets.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace castor::faults {

namespace {

using Names = std::vector<std::string_view>;

/// Lists longer than that are of no help in a message.
constexpr std::size_t most_listed_targets = 10;

bool has_journal(const ComponentDescription& working_memory) {
  auto mode = working_memory.option("journal");
  return mode != nullptr && mode->value != "off";
}

bool goes_on_without_journal(const ComponentDescription& working_memory) {
  auto failure = working_memory.option("journal-failure");
  return failure != nullptr && failure->value == "continue";
}

bool has(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// Goes through the faults of one statement.
class StatementCheck {
public:
  StatementCheck(const Statement& statement, const FaultTargets& targets,
                 std::vector<Diagnostic>& out)
    : statement_(statement), targets_(targets), out_(out) {
    for (auto& x : targets.components) {
      components_.emplace_back(x.name);
      if (x.isolated)
        isolated_.emplace_back(x.name);
    }
    for (auto& x : targets.subarchitectures)
      subarchitectures_.emplace_back(x.name);
    nodes_.assign(targets.nodes.begin(), targets.nodes.end());
  }

  void run() {
    if (auto after = std::get_if<After>(&statement_.trigger))
      filter(after->filter);
    for (auto& fault : statement_.faults)
      std::visit(*this, fault);
  }

  void operator()(const Kill& x) { process(x.process); }
  void operator()(const Stop& x) { process(x.process); }
  void operator()(const Continue& x) { process(x.process); }

  void operator()(const UseUpDescriptors& x) {
    if (x.process.name != coordinator)
      process(x.process);
  }

  void operator()(const Flood& x) {
    if (x.process.name == coordinator)
      report("the coordinator's process takes no connections", "name a node that does");
    else
      process(x.process);
  }

  void operator()(const Partition& x) {
    for (auto names : {&x.group, &x.from})
      for (auto& name : *names)
        peer(name);
    for (auto& name : x.group)
      if (std::ranges::find(x.from, name) != x.from.end())
        report(in_quotes(name) + " cannot be cut off from itself", "remove it on one side");
  }

  void operator()(const Block& x) {
    auto is_working_memory = [&](auto& y) {
      return y.name == x.component.name && y.kind == ComponentKind::working_memory;
    };
    if (std::ranges::any_of(targets_.components, is_working_memory))
      report("working memory " + in_quotes(x.component.name) + " has no start() or configure()",
             "name a component or a task manager");
    else
      component(x.component);
  }

  void operator()(const FailJournal& x) { journal(x.memory); }
  void operator()(const SlowJournal& x) { journal(x.memory); }
  void operator()(const RemoveJournal& x) { journal(x.memory); }
  void operator()(const ClaimJournal& x) { journal(x.memory); }
  void operator()(const JumpClock& x) { memory(x.memory); }

  template <class T>
  requires requires(const T& x) { x.component; }
  void operator()(const T& x) { component(x.component); }

  template <class T>
  requires requires(const T& x) { x.link; }
  void operator()(const T& x) { link(x.link); }

private:
  void filter(const ChangeFilter& x) {
    if (x.subarchitecture && !x.subarchitecture->empty())
      known("subarchitecture", *x.subarchitecture, subarchitectures_);
    if (!x.source.empty())
      known("component", x.source, components_);
  }

  void component(const ComponentTarget& x) {
    if (!x.is_any()) {
      known("component", x.name, components_);
      return;
    }
    if (!x.subarchitecture.empty() &&
        !known("subarchitecture", x.subarchitecture, subarchitectures_))
      return;
    auto is_one = [&](auto& y) {
      return y.is_any() && (x.subarchitecture.empty() || y.subarchitecture == x.subarchitecture);
    };
    if (std::ranges::none_of(targets_.components, is_one))
      report("there is no component to choose from" +
               (x.subarchitecture.empty() ? "" : " in " + in_quotes(x.subarchitecture)),
             "name a working memory or a task manager if one of these is meant");
  }

  void process(const ProcessTarget& x) {
    if (x.is_any()) {
      if (nodes_.empty())
        report("the system has no node besides the coordinator",
               "place components on other hosts, or spread them over nodes");
      return;
    }
    if (has(nodes_, x.name) || has(isolated_, x.name))
      return;
    if (x.name == coordinator)
      report("the coordinator's process is the one that brings the faults about",
             "place on a node what is to fail, and name the node");
    else if (has(components_, x.name))
      report("component " + in_quotes(x.name) + " has no process of its own",
             "add --isolate to its line, or write crash " + name_in_plan(x.name));
    else
      unknown("node or isolated component", x.name, processes());
  }

  void peer(const std::string& name) {
    auto names = nodes_;
    names.emplace_back(coordinator);
    known("node", name, names);
  }

  void link(const LinkTarget& x) {
    if (x.is_any()) {
      if (nodes_.empty())
        report("the system has no links: it runs in one process",
               "place components on other hosts, or spread them over nodes");
      return;
    }
    peer(x.first);
    peer(x.second);
    if (x.first == x.second)
      report(in_quotes(x.first) + " has no link with itself", "write two different nodes");
  }

  bool memory(const MemoryTarget& x) {
    if (!x.is_any())
      return known("subarchitecture", x.subarchitecture, subarchitectures_);
    if (subarchitectures_.empty())
      report("the system has no working memory", {});
    return !subarchitectures_.empty();
  }

  void journal(const MemoryTarget& x) {
    if (!memory(x))
      return;
    auto is_one = [&](auto& y) {
      return y.has_journal && (x.is_any() || y.name == x.subarchitecture);
    };
    if (std::ranges::none_of(targets_.subarchitectures, is_one))
      report(x.is_any()
               ? std::string{"no working memory has a journal"}
               : "the working memory of " + in_quotes(x.subarchitecture) + " has no journal",
             "add --journal full to its WM line");
  }

  Names processes() const {
    auto result = nodes_;
    result.insert(result.end(), isolated_.begin(), isolated_.end());
    return result;
  }

  bool known(std::string_view what, const std::string& name, const Names& names) {
    auto result = has(names, name);
    if (!result)
      unknown(what, name, names);
    return result;
  }

  void unknown(std::string_view what, const std::string& name, const Names& names) {
    std::string remedy;
    if (out_.size() < most_explained)
      remedy = did_you_mean(name, names);
    if (remedy.empty() && !names.empty() && names.size() <= most_listed_targets)
      remedy = "there are: " + list_of(names, most_listed_targets);
    report("there is no " + std::string{what} + " " + in_quotes(name), std::move(remedy));
  }

  void report(std::string message, std::string remedy) {
    out_.push_back({Severity::error,
                    statement_.where,
                    statement_.line,
                    {},
                    std::move(message),
                    std::move(remedy)});
  }

  const Statement& statement_;
  const FaultTargets& targets_;
  std::vector<Diagnostic>& out_;
  Names components_;
  Names isolated_;
  Names subarchitectures_;
  Names nodes_;
};

} // namespace

std::string FaultTargets::supervisor_of(const std::string& component) const {
  auto i = std::ranges::find(components, component, &Component::name);
  return i == components.end() ? std::string{} : i->subarchitecture;
}

FaultTargets::RestartLimit FaultTargets::limit_of(const std::string& supervisor) const {
  auto i = std::ranges::find(subarchitectures, supervisor, &Subarchitecture::name);
  return i == subarchitectures.end() ? system_limit : i->limit;
}

std::string_view word_for(const FaultTargets& targets, const std::string& component) {
  auto i = std::ranges::find(targets.components, component, &FaultTargets::Component::name);
  if (i == targets.components.end())
    return "component";
  switch (i->kind) {
    case ComponentKind::working_memory:
      return "working memory";
    case ComponentKind::task_manager:
      return "task manager";
    case ComponentKind::standalone:
      return "stand-alone component";
    case ComponentKind::managed:
    case ComponentKind::unmanaged:
      break;
  }
  return i->isolated ? "isolated component" : "component";
}

FaultTargets targets_of(const ArchitectureDescription& architecture,
                        std::vector<std::string> nodes) {
  FaultTargets result;
  auto limit_of = [&](std::string_view who) {
    auto policy = architecture.supervision_of(who);
    return FaultTargets::RestartLimit{policy.restarts, policy.period};
  };
  result.system_limit = limit_of(SupervisionRule::system);
  for_each_component(architecture, [&](const ComponentDescription& x) {
    result.components.push_back({x.name, x.subarchitecture, x.kind, x.is_on("isolate")});
  });
  for (auto& x : architecture.subarchitectures)
    result.subarchitectures.push_back({x.name, has_journal(x.working_memory),
                                       goes_on_without_journal(x.working_memory),
                                       limit_of(x.name)});
  result.nodes = std::move(nodes);
  return result;
}

std::vector<Diagnostic> check_plan(const FaultPlan& plan, const FaultTargets& targets) {
  std::vector<Diagnostic> result;
  for (auto& statement : plan.statements)
    StatementCheck{statement, targets, result}.run();
  return result;
}

} // namespace castor::faults
