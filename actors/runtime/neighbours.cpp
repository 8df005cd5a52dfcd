#include "castor/actors/runtime/neighbours.hpp"

namespace castor {

std::vector<std::string> lost_working_memories(const Neighbours& before, const Neighbours& now) {
  std::vector<std::string> result;
  for (auto& [name, working_memory] : before.working_memories) {
    auto i = now.working_memories.find(name);
    if (i == now.working_memories.end() || i->second != working_memory)
      result.push_back(name);
  }
  return result;
}

} // namespace castor
