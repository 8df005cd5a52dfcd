#include "castor/actors/supervision/supervision_tree.hpp"

#include "castor/actors/supervision/child_options.hpp"
#include "castor/base/duration.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace castor {

namespace {

void forget_before(std::deque<Timestamp>& times, Timestamp start) {
  while (!times.empty() && times.front() < start)
    times.pop_front();
}

std::string limit_of(const SupervisionPolicy& x) {
  return std::to_string(x.restarts) + (x.restarts == 1 ? " restart in " : " restarts in ") +
         to_string(x.period);
}

} // namespace

void SupervisionTree::set(const ArchitectureDescription& architecture, bool restarts) {
  auto known = std::exchange(children_, {});
  auto known_supervisors = std::exchange(subarchitectures_, {});
  order_.clear();
  system_.policy = architecture.supervision_of(SupervisionRule::system);
  system_.children.clear();
  auto add = [&](const ComponentDescription& x, std::vector<std::string>& to) {
    auto& child = children_[x.name];
    child = {restarts ? ChildOptions{x}.restart : RestartType::temporary, x.kind, x.subarchitecture,
             std::move(known[x.name].failures)};
    to.push_back(x.name);
    order_.push_back(x.name);
  };
  // What stands outside the subarchitectures starts first: the others will want to connect to it.
  for (auto& x : architecture.standalone)
    add(x, system_.children);
  for (auto& x : architecture.subarchitectures) {
    auto& supervisor = subarchitectures_[x.name];
    supervisor = {
      architecture.supervision_of(x.name), {}, std::move(known_supervisors[x.name].restarts)};
    system_.children.push_back(x.name);
    add(x.working_memory, supervisor.children);
    add(x.task_manager, supervisor.children);
    // Managed components first, then unmanaged ones.
    for (auto kind : {ComponentKind::managed, ComponentKind::unmanaged})
      for (auto& y : x.components)
        if (y.kind == kind)
          add(y, supervisor.children);
  }
  std::erase_if(escalations_, [&](auto& x) { return subarchitectures_.count(x.first) == 0; });
}

RestartType SupervisionTree::restart_type(const std::string& component) const {
  auto i = children_.find(component);
  return i == children_.end() ? RestartType::temporary : i->second.restart;
}

SupervisionDecision SupervisionTree::failed(const std::string& component, Timestamp now) {
  if (restart_type(component) == RestartType::temporary)
    return {};
  return restart_child(component, now);
}

SupervisionDecision SupervisionTree::failed_without(const std::string& component, Timestamp now) {
  if (restart_type(component) == RestartType::temporary)
    return {};
  return restart_with_siblings(component, now);
}

SupervisionDecision SupervisionTree::ended(const std::string& component, Timestamp now) {
  if (restart_type(component) != RestartType::permanent)
    return {};
  return restart_child(component, now);
}

bool SupervisionTree::may_restart(Supervisor& x, Timestamp now) {
  forget_before(x.restarts, now - x.policy.period);
  if (x.restarts.size() >= x.policy.restarts)
    return false;
  x.restarts.push_back(now);
  return true;
}

SupervisionDecision SupervisionTree::restart_child(const std::string& component, Timestamp now) {
  auto& child = children_.at(component);
  auto& supervisor =
    child.subarchitecture.empty() ? system_ : subarchitectures_.at(child.subarchitecture);
  if (!may_restart(supervisor, now)) {
    auto because = component + " has failed, and " + limit_of(supervisor.policy) +
                   " were allowed in " +
                   (child.subarchitecture.empty() ? "the system" : child.subarchitecture);
    if (child.subarchitecture.empty())
      return {SupervisionDecision::Kind::give_up, {}, {}, {}, {}, because};
    return escalate(child.subarchitecture, because, now);
  }
  return restart_with_siblings(component, now);
}

SupervisionDecision SupervisionTree::restart_with_siblings(const std::string& component,
                                                           Timestamp now) {
  auto& child = children_.at(component);
  auto& supervisor =
    child.subarchitecture.empty() ? system_ : subarchitectures_.at(child.subarchitecture);
  SupervisionDecision result{SupervisionDecision::Kind::restart};
  result.delay = delay_of(supervisor.policy, child.failures, now);
  auto affected_children = affected(supervisor, component);
  result.stop = child.subarchitecture.empty() ? components_of(affected_children)
                                              : with_dependents(affected_children);
  // Those that are never started again are ended all the same.
  std::copy_if(result.stop.begin(), result.stop.end(), std::back_inserter(result.start),
               [&](auto& x) { return restart_type(x) != RestartType::temporary; });
  return result;
}

SupervisionDecision SupervisionTree::escalate(const std::string& subarchitecture,
                                              const std::string& because, Timestamp now) {
  if (!may_restart(system_, now))
    return {SupervisionDecision::Kind::give_up,
            {},
            {},
            {},
            subarchitecture,
            because + "; so " + subarchitecture + " has failed as a whole, and " +
              limit_of(system_.policy) + " were allowed in the system"};
  SupervisionDecision result{SupervisionDecision::Kind::restart};
  result.escalated = subarchitecture;
  result.reason = because;
  result.delay = delay_of(system_.policy, escalations_[subarchitecture], now);
  auto children = affected(system_, subarchitecture);
  result.stop = components_of(children);
  // A supervisor that begins anew knows nothing of the past, and starts all its children.
  result.start = result.stop;
  for (auto& name : children)
    if (auto i = subarchitectures_.find(name); i != subarchitectures_.end()) {
      i->second.restarts.clear();
      for (auto& x : i->second.children)
        children_.at(x).failures.clear();
    }
  return result;
}

std::vector<std::string> SupervisionTree::affected(const Supervisor& supervisor,
                                                   const std::string& child) const {
  auto& all = supervisor.children;
  switch (supervisor.policy.strategy) {
    case RestartStrategy::one_for_one:
      return {child};
    case RestartStrategy::one_for_all:
      return all;
    case RestartStrategy::rest_for_one:
      return {std::find(all.begin(), all.end(), child), all.end()};
  }
  return {child};
}

std::vector<std::string>
SupervisionTree::with_dependents(const std::vector<std::string>& components) const {
  std::set<std::string> wanted{components.begin(), components.end()};
  for (auto& name : components) {
    auto& child = children_.at(name);
    bool all = child.kind == ComponentKind::working_memory;
    if (!all && child.kind != ComponentKind::task_manager)
      continue;
    for (auto& x : subarchitectures_.at(child.subarchitecture).children)
      if (all || children_.at(x).kind == ComponentKind::managed)
        wanted.insert(x);
  }
  std::vector<std::string> result;
  std::copy_if(order_.begin(), order_.end(), std::back_inserter(result),
               [&](auto& x) { return wanted.count(x) > 0; });
  return result;
}

std::vector<std::string>
SupervisionTree::components_of(const std::vector<std::string>& children) const {
  std::vector<std::string> result;
  for (auto& x : children) {
    if (auto i = subarchitectures_.find(x); i != subarchitectures_.end())
      result.insert(result.end(), i->second.children.begin(), i->second.children.end());
    else
      result.push_back(x);
  }
  return result;
}

Timestamp SupervisionTree::delay_of(const SupervisionPolicy& policy,
                                    std::deque<Timestamp>& failures, Timestamp now) {
  forget_before(failures, now - policy.period);
  auto earlier = failures.size();
  failures.push_back(now);
  if (earlier == 0)
    return Timestamp{0};
  Timestamp delay = policy.first_delay;
  for (std::size_t i = 1; i < earlier && delay < policy.longest_delay; ++i)
    delay *= 2;
  delay = std::min<Timestamp>(delay, policy.longest_delay);
  // Up to a quarter less, so that those that failed together do not come back together.
  auto quarter = delay.count() / 4;
  std::uniform_int_distribution<std::int64_t> jitter{0, quarter};
  return delay - Timestamp{jitter(random_)};
}

} // namespace castor
