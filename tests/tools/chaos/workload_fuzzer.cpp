// Feeds arbitrary bytes to the reader of workloads: what it takes for a workload is printed and
// read again.

#include "castor/tests/support/fuzzing.hpp"
#include "castor/tools/chaos/scene_text.hpp"
#include "castor/tools/chaos/workload_parser.hpp"
#include "castor/tools/chaos/workload_places.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace {

using namespace castor;
using test::require;

/// Does to a scene what the workload says.
void edit(faults::SceneText& scene, const faults::Workload& workload) {
  for (auto& statement : workload.statements)
    for (auto& action : statement.actions)
      if (auto* moved = std::get_if<faults::MoveThing>(&action))
        scene.move(moved->thing, moved->x, moved->y);
      else if (auto* added = std::get_if<faults::AddThing>(&action))
        scene.add(added->thing, added->place);
      else if (auto* removed = std::get_if<faults::RemoveThing>(&action))
        scene.remove(removed->thing);
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view input(reinterpret_cast<const char*>(data), size);
  auto result = faults::parse_workload(input, "fuzz.workload", test::hermetic_options());
  require(result.diagnostics.size() <= 21);
  require(render(result.diagnostics).find('\x1b') == std::string::npos);
  // A scene may be any text, too.
  faults::SceneText scene{input};
  if (!result.ok())
    return 0;
  auto again = faults::parse_workload(faults::to_string(*result.workload), "again.workload");
  require(again.ok() && *again.workload == *result.workload);
  edit(scene, *result.workload);
  const faults::WorkloadPlaces places{{"s"}, {}, "s", {}};
  auto problems = faults::check_workload(
    *result.workload, places, scene, [](const faults::WriteEntry&) { return std::string{}; },
    [](const std::string&) { return false; });
  require(render(problems).find('\x1b') == std::string::npos);
  return 0;
}
