#include "castor/actors/runtime/component_context.hpp"

#include <caf/actor_proxy.hpp>

#include <utility>

namespace castor {

void ComponentContext::set_neighbours(NeighboursPtr neighbours) {
  auto before = std::exchange(neighbours_, std::move(neighbours));
  if (!before)
    return;
  for (auto& f : observers_)
    f(*before);
}

bool ComponentContext::is_in_another_process(const std::string& subarchitecture) const {
  if (!neighbours_)
    return false;
  auto i = neighbours_->working_memories.find(subarchitecture);
  return i != neighbours_->working_memories.end() &&
         dynamic_cast<caf::actor_proxy*>(caf::actor_cast<caf::abstract_actor*>(i->second));
}

} // namespace castor
