#include "castor/tests/actors/component/scripted.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace castor::test {

namespace {

/// As `eventually` waits: a busy machine under sanitizers needs that for what otherwise takes
/// seconds.
constexpr auto longest_run = 2min;

} // namespace

class Unmanaged : public UnmanagedScript {};
class Standalone : public StandaloneScript {};

CASTOR_COMPONENT(Managed, "does what a test says")
CASTOR_COMPONENT(Unmanaged, "does what a test says")
CASTOR_COMPONENT(Standalone, "does what a test says")

void clear_scripts() {
  ManagedScript::scripts().clear();
  UnmanagedScript::scripts().clear();
  StandaloneScript::scripts().clear();
}

ArchitectureDescription architecture(const std::string& text) {
  auto result = cast::parse_string(text, "test.cast");
  if (!result.architecture)
    throw std::runtime_error(render(result.diagnostics));
  return *std::move(result.architecture);
}

std::string subarchitecture(const std::string& name) {
  return "SUBARCHITECTURE " + name +
         " localhost\nCPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n";
}

SystemOptions without_restarts() {
  SystemOptions result;
  result.restarts = false;
  return result;
}

int run(System& system) {
  auto status = -1;
  if (system.start() && system.wait({longest_run, {}}) == EndReason::ended_by_component)
    status = system.ended()->first;
  system.stop();
  return status;
}

} // namespace castor::test
