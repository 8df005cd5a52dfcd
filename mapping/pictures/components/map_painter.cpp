#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/values_of.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/map_components/keyframe_poses.hpp"
#include "castor/mapping/maps/output_file.hpp"
#include "castor/mapping/people/types.hpp"
#include "castor/mapping/pictures/components/types.hpp"
#include "castor/mapping/pictures/map_scene.hpp"
#include "castor/mapping/pictures/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Draws what is known of a building: when it is asked to, at the end of a run, and now and then as
/// a MapPicture.
class MapPainter final : public UnmanagedComponent {
  void start() override {
    const auto note = [this](const ChangeEvent& event) {
      try {
        const auto x = read<Person>(event.address);
        people_[x->id].push_back({x->x, x->y, x->heading});
      } catch (const DoesNotExistOnWM&) {
        debug("{} was deleted before it was read", event.address.id);
      }
    };
    on_change(changed<Person>().in(where(people_in_)), note);
    on_call<DrawMap>([this](const DrawMap& request) {
      if (request.file.empty())
        throw std::invalid_argument("the request names no file");
      return draw(request.file);
    });
    if (period_.get() > 0s)
      every(period_.get(), [this] { show(); });
  }

  void stop() override {
    if (output_->empty())
      return;
    std::filesystem::create_directories(output_.get());
    try {
      info("drew {}",
           draw((std::filesystem::path{output_.get()} / "picture.png").string()).content);
    } catch (const std::invalid_argument& e) {
      info("drew no picture: {}", e.what());
    }
  }

  struct Drawing {
    CellMap map;
    MapScene scene;
    /// Of the whole picture, in words.
    std::string content;
  };

  Drawing drawing() {
    MapKnowledge knowledge;
    std::optional<GraphPoses> graph;
    for (auto& x : all<GraphPoses>(keyframes_))
      graph = x;
    for (auto& x : contents_of(all<Keyframe>(keyframes_), graph, {}).keyframes)
      knowledge.trajectory.push_back(x.pose);
    knowledge.nodes = all<GraphNode>(graph_);
    knowledge.edges = all<GraphEdge>(graph_);
    knowledge.areas = all<Area>(graph_);
    knowledge.people = people_;
    knowledge.explorations = all<ExplorationState>(navigation_);
    knowledge.movements = all<Movement>(navigation_);
    const auto tiles = all<GridTile>(grid_);
    Drawing result{cell_map(tiles), map_scene(knowledge), {}};
    result.content = result.scene.content;
    if (!tiles.empty())
      result.content = result.content.empty() ? "grid" : "grid, " + result.content;
    return result;
  }

  DrawnMap draw(const std::string& file) {
    const auto x = drawing();
    write_output_file(file, map_picture(x.map, x.scene.tracks, {}, x.scene.marks));
    return {file, x.content};
  }

  /// Writes the picture if it has changed.
  void show() {
    const auto x = drawing();
    if (x.content.empty())
      return;
    auto pixels = map_pixels(x.map, x.scene.tracks, {.side = shown_side_}, x.scene.marks);
    MapPicture picture{x.content,
                       {static_cast<std::uint32_t>(pixels.width),
                        static_cast<std::uint32_t>(pixels.height), 3, std::move(pixels.bytes)}};
    if (picture == shown_)
      return;
    put(here("map-picture"), picture);
    shown_ = std::move(picture);
  }

  std::string where(const SubarchitectureName& x) const {
    return x.empty() ? std::string{subarchitecture()} : std::string{x};
  }

  template <class T>
  std::vector<T> all(const SubarchitectureName& place) {
    return values_of(read_all_in<T>(where(place)));
  }

  Option<std::string> output_{this, "output", "",
                              "folder for picture.png at the end of a run; empty: none"};
  Option<SubarchitectureName> grid_{this, "grid", "",
                                    "subarchitecture of the grid; empty: its own"};
  Option<SubarchitectureName> keyframes_{this, "keyframes", "",
                                         "subarchitecture of the keyframes; empty: its own"};
  Option<SubarchitectureName> graph_{this, "graph", "",
                                     "subarchitecture of nodes, edges and areas; empty: its own"};
  Option<SubarchitectureName> people_in_{this, "people", "",
                                         "subarchitecture of people; empty: its own"};
  Option<SubarchitectureName> navigation_{
    this, "navigation", "", "subarchitecture of Navigator and Explorer; empty: its own"};

  Option<std::chrono::milliseconds> period_{
    this, "period", 0ms, "time between entries with the picture, for timelines; 0: none"};

  /// Longer side of the picture in an entry, pixels.
  static constexpr int shown_side_ = 480;

  std::map<std::int64_t, std::vector<Pose2>> people_;
  MapPicture shown_;
};

CASTOR_COMPONENT(MapPainter, "draws the map with what is known of it")

} // namespace

} // namespace castor::mapping
