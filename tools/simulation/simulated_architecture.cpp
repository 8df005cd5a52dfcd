#include "castor/tools/simulation/simulated_architecture.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"

#include <fmt/core.h>

#include <array>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::simulation {

/// What the description names. An actor of another kind takes its place.
class Simulated : public ManagedComponent {};

namespace {

/// Once the class is needed, as no other command is to know of it.
void register_class() {
  static std::once_flag once;
  std::call_once(once, [] { detail::register_component<Simulated>("Simulated", "is simulated"); });
}

ArchitectureDescription parsed(const std::string& text) {
  auto result = cast::parse_string(text, "simulated.cast");
  if (!result.architecture)
    throw std::logic_error(render(result.diagnostics));
  return *std::move(result.architecture);
}

} // namespace

const ArchitectureDescription& simulated_architecture(const ArchitectureVariant& x) {
  // Parsing takes longer than simulating.
  static thread_local std::map<ArchitectureVariant, ArchitectureDescription> known;
  auto [i, is_new] = known.try_emplace(x);
  if (!is_new)
    return i->second;
  register_class();
  static constexpr std::array strategies{"one_for_one", "one_for_all", "rest_for_one"};
  std::string text;
  for (std::size_t node = 1; node < x.machines; ++node)
    text += fmt::format("HOSTNAME node{0} node{0}\n", node);
  text += "SUPERVISE SYSTEM RESTARTS 1000 IN 10s DELAY 20ms TO 200ms\n";
  text += std::string{"SUPERVISE * "} + strategies[x.strategy] +
          (x.escalates ? " RESTARTS 1 IN 2s" : " RESTARTS 1000 IN 10s") + " DELAY 20ms TO 200ms\n";
  if (x.moves && x.machines == 3)
    text += "FAILOVER b2 TO [node2]\nFAILOVER c2 TO [node1]\n";
  for (std::string name : {"a", "b", "c"})
    text += "SUBARCHITECTURE " + name + "\nCPP WM SubarchitectureWorkingMemory --lease " +
            std::to_string(x.lease.count()) + "ms --journal " + std::string{to_string(x.journals)} +
            "\nCPP TM AlwaysPositiveTaskManager\nCPP MG " + name + "1 Simulated\nCPP MG " + name +
            "2 Simulated\n";
  i->second = parsed(text);
  return i->second;
}

} // namespace castor::simulation
