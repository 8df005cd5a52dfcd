#include "castor/actors/supervision/system_model.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/actors/supervision/child_options.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor {

void SystemModel::set(ArchitectureDescription architecture, std::chrono::milliseconds shutdown) {
  architecture_ = std::move(architecture);
  auto known = std::exchange(children_, {});
  for_each_component(architecture_, [&](const ComponentDescription& x) {
    auto& child = children_[x.name];
    if (auto i = known.find(x.name); i != known.end())
      child = i->second;
    child.number = x.number;
    child.kind = x.kind;
    child.subarchitecture = x.subarchitecture;
    child.shutdown = ChildOptions{x}.shutdown.value_or(shutdown);
    child.isolated = x.is_on("isolate");
  });
}

const SupervisedChild* SystemModel::find(const std::string& name) const {
  auto i = children_.find(name);
  return i == children_.end() ? nullptr : &i->second;
}

std::vector<std::string> SystemModel::in_order(const std::vector<std::string>& names) const {
  std::vector<std::string> result;
  std::copy_if(tree_.order().begin(), tree_.order().end(), std::back_inserter(result),
               [&](auto& x) { return std::ranges::count(names, x) > 0; });
  return result;
}

void SystemModel::begin_life(const std::string& name) {
  ++children_.at(name).incarnation;
}

bool SystemModel::set_alive(const std::string& name, bool alive) {
  return std::exchange(children_.at(name).alive, alive);
}

void SystemModel::set_given_up(const std::string& name, bool given_up) {
  children_.at(name).given_up = given_up;
}

bool SystemModel::set_killed(const std::string& name, bool killed) {
  return std::exchange(children_.at(name).killed, killed);
}

PartPlan SystemModel::plan() const {
  PartPlan result;
  result.architecture = architecture_;
  result.placement = failover_.placement().of;
  for (auto& [name, child] : children_) {
    if (child.incarnation != 1)
      result.incarnations[name] = child.incarnation;
    if (tree_.restart_type(name) == RestartType::temporary)
      result.temporary.insert(name);
    // It is made in its next life, once that has begun.
    if (failover_.is_between_processes(name))
      result.placement[name] = nowhere;
  }
  return result;
}

SystemRoster SystemModel::roster(const std::map<std::string, caf::strong_actor_ptr>& actors) const {
  SystemRoster result;
  for (auto& x : architecture_.subarchitectures)
    if (auto i = actors.find(x.working_memory.name); i != actors.end())
      result.working_memories[x.name] = caf::actor_cast<WorkingMemoryActor>(i->second);
  if (auto i = actors.find(working_memory_of(health_subarchitecture)); i != actors.end())
    result.working_memories[health_subarchitecture] =
      caf::actor_cast<WorkingMemoryActor>(i->second);
  for (auto& x : architecture_.standalone)
    if (auto i = actors.find(x.name); i != actors.end())
      result.providers[x.name] = caf::actor_cast<caf::actor>(i->second);
  for (auto& [name, child] : children_)
    result.placement[name] = failover_.process_of(name);
  for (auto& name : tree_.order())
    if (children_.at(name).kind != ComponentKind::working_memory)
      result.components.push_back(status_of(name));
  result.hosts = failover_.placement();
  return result;
}

ComponentStatus SystemModel::status_of(const std::string& name) const {
  auto& child = children_.at(name);
  ComponentStatus result;
  result.identity = {name, child.subarchitecture, architecture_.component(name)->class_name,
                     static_cast<std::uint32_t>(child.number), child.incarnation};
  result.is_task_manager = child.kind == ComponentKind::task_manager;
  result.restarts = child.incarnation - 1;
  // If it has ended, of which those who look may know earlier.
  result.will_restart = !child.given_up;
  return result;
}

} // namespace castor
