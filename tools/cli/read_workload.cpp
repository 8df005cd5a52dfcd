#include "castor/tools/cli/read_workload.hpp"

#include "castor/actors/system/known_names.hpp"
#include "castor/actors/system/value_from_json.hpp"
#include "castor/base/input_file.hpp"
#include "castor/tools/chaos/workload_parser.hpp"
#include "castor/tools/cli/bundled_file.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/wm/values/known_types.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <exception>
#include <utility>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;

/// Bytes of a scene file, which has some tens of lines.
constexpr std::size_t longest_scene = std::size_t{1} << 20;

/// As cameras look for their sources.
fs::path path_of(const faults::WorkloadPlaces::Camera& camera) {
  std::error_code error;
  fs::path file{camera.file};
  return file.is_relative() && !fs::exists(file, error) && !camera.base.empty()
           ? fs::path{camera.base} / file
           : file;
}

void read_scene(CheckedWorkload& x) {
  for (auto& camera : x.places.cameras) {
    auto path = path_of(camera);
    if (x.scene && path != x.scene_file) {
      x.scene.reset();
      return;
    }
    if (!x.scene) {
      x.scene.emplace(read_input_file(path.string(), longest_scene));
      x.scene_file = path;
    }
  }
}

std::string problem_of(const faults::WriteEntry& x, const TypeCatalogue& types) {
  try {
    auto type = find_type(x.type, types);
    if (!type)
      return "of the type " + x.type + " only those that derive from it are known here";
    value_from_json(type, nlohmann::ordered_json::parse(x.value));
    return {};
  } catch (const std::exception& e) {
    return e.what();
  }
}

} // namespace

std::string workload_beside(const std::string& given, const std::string& system_file) {
  if (given == no_workload)
    return {};
  if (!given.empty())
    return file_or_bundled(given);
  auto file = fs::path{system_file}.replace_extension(".workload").string();
  std::error_code error;
  return fs::is_regular_file(file, error) ? file : std::string{};
}

std::optional<CheckedWorkload> read_workload(const std::string& file,
                                             const ArchitectureDescription& architecture) {
  auto parsed = faults::parse_workload_file(file);
  print(parsed.diagnostics);
  if (!parsed.ok())
    return std::nullopt;
  CheckedWorkload result{*std::move(parsed.workload), faults::places_of(architecture), {}, {}};
  read_scene(result);
  const auto types = known_types();
  auto problems = check_workload(
    result.workload, result.places, result.scene,
    [&](const faults::WriteEntry& x) { return problem_of(x, types); },
    [&](const std::string& type) { return is_known_type(type, types); });
  print(problems);
  if (!problems.empty())
    return std::nullopt;
  return result;
}

} // namespace castor::cli
