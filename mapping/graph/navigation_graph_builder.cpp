#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/write_batch.hpp"
#include "castor/mapping/graph/graph_keeper.hpp"
#include "castor/mapping/graph/room_segments.hpp"
#include "castor/mapping/map_components/follows_grid.hpp"
#include "castor/mapping/map_components/follows_keyframes.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Keeps the navigation graph of the robot's path: an entry for each node, edge and area.
class NavigationGraphBuilder final : public FollowsGrid<FollowsKeyframes<UnmanagedComponent>> {
  void configure() override {
    GraphOptions options;
    options.spacing = spacing_;
    options.free_way = free_way_;
    options.gateway_reach = gateway_reach_;
    options.doors.least_width = least_door_;
    options.doors.most_width = most_door_;
    options.gateways.views = views_;
    options.graph.comfort = comfort_;
    options.graph.narrowness = narrowness_;
    options.graph.tolerance = tolerance_;
    keeper_.emplace(options);
  }

  void start() override {
    restore();
    on_change(overwritten<Area>().in(subarchitecture()), [this](const ChangeEvent& event) {
      if (event.source != component_name())
        adopt_label(event.address);
    });
    if (rooms_) {
      follow_grid();
      every(rooms_period_.get(), [this] {
        if (is_behind() || !reconcile())
          return;
        keeper_->finish();
        write_changes();
      });
    }
    follow_keyframes();
  }

  void grid_changed(const CellRegion&) override { is_grid_new_ = true; }

  /// Whether the grid has changed since the last time.
  bool reconcile() {
    if (!std::exchange(is_grid_new_, false))
      return false;
    keeper_->reconcile(room_segments(grid().map()));
    return true;
  }

  void restore() {
    std::vector<GraphNode> nodes;
    std::vector<GraphEdge> edges;
    std::vector<Area> areas;
    for (auto& x : read_all<GraphNode>())
      nodes.push_back(*x);
    for (auto& x : read_all<GraphEdge>())
      edges.push_back(*x);
    for (auto& x : read_all<Area>())
      areas.push_back(*x);
    for (auto& x : read_all<RobotArea>())
      told_ = *x;
    for (auto& x : nodes)
      written_.insert(node_id(x.id));
    for (auto& x : edges)
      written_.insert(edge_id(edge_key(x.a, x.b)));
    for (auto& x : areas)
      written_.insert(area_id(x.id));
    if (told_)
      keeper_->restore(nodes, edges, areas, *told_);
    if (!nodes.empty())
      info("goes on from {} nodes and {} areas", nodes.size(), areas.size());
  }

  void place(const EntryOf<Keyframe>& keyframe, const Pose2& robot) override {
    if (added_.try_emplace(keyframe.address.id, keyframe->number).second)
      keeper_->add(keyframe->number, {keyframe.object, &keyframe->scan}, keyframe->local_pose,
                   robot);
    else
      keeper_->correct(keyframe->number, robot);
  }

  void remove(const std::string& keyframe) override {
    auto x = added_.find(keyframe);
    if (x == added_.end())
      return;
    keeper_->remove(x->second);
    added_.erase(x);
  }

  void placed() override {
    // Gateways that the rooms have confirmed before a restart, or not, stay what they are.
    if (!std::exchange(is_caught_up_, true))
      reconcile();
    keeper_->finish();
    write_changes();
  }

  void write_changes() {
    const auto changes = keeper_->take_changes();
    const auto position = keeper_->position();
    if (changes.empty() && (position.keyframe < 0 || position == told_))
      return;
    try {
      write_all(changes, position);
    } catch (const ConsistencyException&) {
      // Somebody has named an area meanwhile, which its event will tell later.
      for (auto& x : read_all<Area>())
        keeper_->label(x->id, x->label);
      write_all(changes, position);
    }
  }

  void write_all(const GraphChanges& changes, const RobotArea& position) {
    WriteBatch batch;
    std::vector<std::string> new_ids;
    std::vector<std::string> old_ids;
    const auto& graph = keeper_->graph();
    for (auto id : changes.nodes)
      write_to(batch, new_ids, old_ids, node_id(id), graph.nodes(), id);
    for (auto& key : changes.edges)
      write_to(batch, new_ids, old_ids, edge_id(key), graph.edges(), key);
    for (auto id : changes.areas)
      write_to(batch, new_ids, old_ids, area_id(id), graph.areas(), id);
    if (position.keyframe >= 0 && !told_)
      batch.add(here("robot-area"), position);
    else if (position.keyframe >= 0 && position != told_)
      batch.overwrite(here("robot-area"), position);
    if (!batch.items().empty())
      write(batch);
    written_.insert(new_ids.begin(), new_ids.end());
    for (auto& id : old_ids)
      written_.erase(id);
    if (position.keyframe >= 0)
      told_ = position;
  }

  /// @param new_ids of entries that the batch adds; @param old_ids of those that it deletes
  template <class Map>
  void write_to(WriteBatch& batch, std::vector<std::string>& new_ids,
                std::vector<std::string>& old_ids, const std::string& id, const Map& all,
                const typename Map::key_type& key) const {
    const auto x = all.find(key);
    const bool is_written = written_.contains(id);
    if (x != all.end() && is_written) {
      batch.overwrite(here(id), x->second);
    } else if (x != all.end()) {
      batch.add(here(id), x->second);
      new_ids.push_back(id);
    } else if (is_written) {
      batch.delete_entry(here(id));
      old_ids.push_back(id);
    }
  }

  void adopt_label(const Address& address) {
    try {
      const auto x = read<Area>(address);
      keeper_->label(x->id, x->label);
    } catch (const DoesNotExistOnWM&) {
      debug("{} was deleted before it was read", address.id);
    }
  }

  static std::string node_id(std::int64_t id) { return "node-" + std::to_string(id); }
  static std::string area_id(std::int64_t id) { return "area-" + std::to_string(id); }
  static std::string edge_id(const EdgeKey& x) {
    return "edge-" + std::to_string(x.first) + "-" + std::to_string(x.second);
  }

  void stop() override {
    catch_up();
    const auto& graph = keeper_->graph();
    std::size_t gateways = 0;
    for (auto& [id, x] : graph.nodes())
      gateways += x.kind == NodeKind::gateway ? 1 : 0;
    std::size_t areas = 0;
    for (auto& [id, x] : graph.areas())
      areas += x.merged_into < 0 ? 1 : 0;
    info("{} places in {} areas, {} gateways, {} edges", graph.nodes().size() - gateways, areas,
         gateways, graph.edges().size());
  }

  Option<double> spacing_{this, "spacing", 1, "distance between neighbouring places, metres"};
  Option<double> free_way_{this, "free-way", 0.2,
                           "a straight line is a way if nothing is nearer to it, metres"};
  Option<double> gateway_reach_{
    this, "gateway-reach", 2.5,
    "how far from a place a gateway that was not passed may be to be connected with it, metres"};
  Option<double> least_door_{this, "least-door", 0.6, "smallest width of a door, metres"};
  Option<double> most_door_{this, "most-door", 1.05, "largest width of a door, metres"};
  Option<int> views_{this, "views", 3, "number of views that confirm a gateway"};
  Option<bool> rooms_{this, "rooms", true,
                      "whether rooms of the grid are a second source for gateways"};
  Option<std::chrono::milliseconds> rooms_period_{
    this, "rooms-period", 10s, "time from one division of the grid into rooms to the next"};
  Option<double> comfort_{this, "comfort", 0.5, "edges with a smaller clearance cost more; metres"};
  Option<double> narrowness_{this, "narrowness", 1,
                             "a narrow edge costs up to 1 + this times its length"};
  Option<double> tolerance_{this, "tolerance", 0.01,
                            "smaller changes of positions and costs are not written, metres"};

  std::optional<GraphKeeper> keeper_;
  bool is_caught_up_ = false;
  bool is_grid_new_ = false;
  /// Keyframes that are in the graph, and their numbers.
  std::map<std::string, std::int64_t> added_;
  /// Ids of the entries.
  std::set<std::string> written_;
  std::optional<RobotArea> told_;
};

CASTOR_COMPONENT(NavigationGraphBuilder, "keeps the navigation graph of the robot's path")

} // namespace

} // namespace castor::mapping
