#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/values_of.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/map_components/keyframe_poses.hpp"
#include "castor/mapping/map_components/map_files.hpp"
#include "castor/mapping/map_components/types.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::mapping {

namespace {

/// Writes map files: when it is asked to, and at the end of a run.
class MapExporter final : public UnmanagedComponent {
  void start() override {
    on_call<ExportMap>([this](const ExportMap& request) {
      if (request.folder.empty())
        throw std::invalid_argument("the request names no folder");
      return write_files(request.folder);
    });
  }

  void stop() override {
    if (!output_->empty())
      write_files(output_.get());
  }

  ExportedMap write_files(const std::string& folder) {
    auto keyframes = all<Keyframe>(keyframes_);
    std::optional<GraphPoses> graph;
    for (auto& x : all<GraphPoses>(keyframes_))
      graph = x;
    std::vector<Pose2> truth;
    for (auto& x : all<TruePath>(maps_))
      truth = std::move(x.poses);
    auto result =
      write_map_files(folder, contents_of(std::move(keyframes), graph, all<Constraint>(keyframes_)),
                      all<GridTile>(maps_), all<OctreeBlock>(maps_), truth);
    for (auto& x : result.files)
      info("wrote {}", x);
    for (auto& x : result.left_out)
      info("left out {}", x);
    return result;
  }

  template <class T>
  std::vector<T> all(const SubarchitectureName& where) {
    return values_of(read_all_in<T>(where.empty() ? subarchitecture() : std::string{where}));
  }

  Option<std::string> output_{this, "output", "",
                              "folder for the files at the end of a run; empty: none"};
  Option<SubarchitectureName> keyframes_{this, "keyframes", "",
                                         "subarchitecture of the keyframes; empty: its own"};
  Option<SubarchitectureName> maps_{this, "maps", "",
                                    "subarchitecture of the grid and the octree; empty: its own"};
};

CASTOR_COMPONENT(MapExporter, "writes map files that other tools open")

} // namespace

} // namespace castor::mapping
