// Feeds arbitrary bytes to the reader of fault plans: what it takes for a plan is printed and read
// again.

#include "castor/tests/support/fuzzing.hpp"
#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/chaos/plan_parser.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace castor;
  using test::require;
  std::string_view input(reinterpret_cast<const char*>(data), size);
  auto result = faults::parse_plan(input, "fuzz.plan", test::hermetic_options());
  require(result.diagnostics.size() <= 21);
  require(render(result.diagnostics).find('\x1b') == std::string::npos);
  if (!result.ok())
    return 0;
  auto text = faults::to_string(*result.plan);
  auto again = faults::parse_plan(text, "again.plan");
  require(again.ok() && *again.plan == *result.plan);
  faults::FaultTargets targets{{{"a", "s", ComponentKind::managed, true}}, {{"s", true}}, {"n"}};
  require(render(faults::check_plan(*result.plan, targets)).find('\x1b') == std::string::npos);
  return 0;
}
