#include "castor/tests/simulation/simulated_architecture.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/registry.hpp"

#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace castor::simulation {

/// What the description names. An actor of another kind takes its place.
class Simulated : public ManagedComponent {};

namespace {

CASTOR_COMPONENT(Simulated, "is simulated")

ArchitectureDescription parsed(const std::string& text) {
  auto result = cast::parse_string(text, "simulated.cast");
  if (!result.architecture)
    throw std::logic_error(cast::render(result.diagnostics));
  return *std::move(result.architecture);
}

} // namespace

const ArchitectureDescription& simulated_architecture(std::chrono::milliseconds lease,
                                                      std::size_t strategy, bool escalates,
                                                      bool moves) {
  static std::map<std::tuple<std::chrono::milliseconds, std::size_t, bool, bool>,
                  ArchitectureDescription>
    known;
  auto [i, is_new] = known.try_emplace({lease, strategy, escalates, moves});
  if (!is_new)
    return i->second;
  static constexpr std::array strategies{"one_for_one", "one_for_all", "rest_for_one"};
  std::string text = "HOSTNAME node1 node1\nHOSTNAME node2 node2\n"
                     "SUPERVISE SYSTEM RESTARTS 1000 IN 10s DELAY 20ms TO 200ms\n";
  text += std::string{"SUPERVISE * "} + strategies[strategy] +
          (escalates ? " RESTARTS 1 IN 2s" : " RESTARTS 1000 IN 10s") + " DELAY 20ms TO 200ms\n";
  if (moves)
    text += "FAILOVER b2 TO [node2]\nFAILOVER c2 TO [node1]\n";
  for (std::string name : {"a", "b", "c"})
    text += "SUBARCHITECTURE " + name + "\nCPP WM SubarchitectureWorkingMemory --lease " +
            std::to_string(lease.count()) + "ms\nCPP TM AlwaysPositiveTaskManager\nCPP MG " + name +
            "1 Simulated\nCPP MG " + name + "2 Simulated\n";
  i->second = parsed(text);
  return i->second;
}

} // namespace castor::simulation
