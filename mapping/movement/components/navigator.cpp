#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/values_of.hpp"
#include "castor/mapping/movement/components/executes_movement.hpp"
#include "castor/mapping/movement/graph_routes.hpp"
#include "castor/mapping/people/types.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Moves the robot: executes the actions of movement, one after the other.
class Navigator final : public ExecutesMovement {
  void start() override {
    ExecutesMovement::start();
    if (!graph_->empty())
      follow_gateways();
    execute<GoToPlace>([this](ActionInProgress& action, const GoToPlace& x) {
      return go(action, fmt::format("go to {:.2f} {:.2f}", x.x, x.y), [&] {
        auto route = route_to({{x.x, x.y}, {}}, x.along_graph);
        if (x.has_heading)
          route.heading = x.heading;
        return route;
      });
    });
    execute<GoToNode>([this](ActionInProgress& action, const GoToNode& x) {
      return go(action, fmt::format("go to node {}", x.node),
                [&] { return route_to(graph().node(x.node), x.along_graph); });
    });
    execute<GoToArea>([this](ActionInProgress& action, const GoToArea& x) {
      const auto name = x.label.empty() ? fmt::format("area {}", x.area) : x.label;
      return go(action, fmt::format("go to {}", name), [&] {
        return route_to(x.label.empty() ? graph().area(x.area) : graph().area_named(x.label),
                        x.along_graph);
      });
    });
    execute<GoToObject>([this](ActionInProgress& action, const GoToObject& x) {
      return go(action, fmt::format("go near {:.2f} {:.2f}", x.x, x.y),
                [&] { return route_near(x); });
    });
    execute<FollowPerson>([this](ActionInProgress& action, const FollowPerson& x) {
      if (people_->empty())
        return ActionResult::failed("the Navigator does not know where people are: name the "
                                    "subarchitecture of a PersonTracker by --people");
      return follow(action, x, [this] { return people_in_sight(); });
    });
    execute<TurnBy>([this](ActionInProgress& action, const TurnBy& x) {
      return turn(action, x.angle, fmt::format("turn by {:.2f} rad", x.angle));
    });
    execute<TurnTo>([this](ActionInProgress& action, const TurnTo& x) {
      const double angle = pose() ? normalised(x.heading - pose()->heading) : 0;
      return turn(action, angle, fmt::format("turn to {:.2f} rad", x.heading));
    });
    execute<StopMoving>([this](ActionInProgress&, const StopMoving&) {
      drive({});
      return ActionResult::succeeded();
    });
  }

  /// Those whom a tracker sees; one who is only expected somewhere is not in sight.
  std::vector<SeenPerson> people_in_sight() {
    std::vector<SeenPerson> result;
    constexpr double in_sight = 0.5;
    for (const auto& x : read_all_in<Person>(people_.get()))
      if (x->visibility >= in_sight)
        result.push_back({x->id, {x->x, x->y}, x->heading, x->speed});
    return result;
  }

  // -- the navigation graph

  /// The graph of now; without one, it has no nodes.
  GraphRoutes graph() {
    if (graph_->empty())
      return GraphRoutes{{}, {}, {}};
    return {entries<GraphNode>(), entries<GraphEdge>(), entries<Area>()};
  }

  template <class T>
  std::vector<T> entries() {
    return values_of(read_all_in<T>(graph_.get()));
  }

  /// Doors are few and change rarely: all are read again when one has changed.
  void follow_gateways() {
    on_change(changed<GraphNode>().in(graph_).where(field(&GraphNode::kind) == NodeKind::gateway),
              [this](const ChangeEvent&) { are_gateways_old_ = true; });
    every(1s, [this] {
      if (std::exchange(are_gateways_old_, false))
        gateways_ = GraphRoutes(entries<GraphNode>(), {}, {}).gateways();
    });
  }

  /// Nodes on the way to a place.
  std::vector<Point2> nodes_to(const Point2& goal) {
    const auto& map = planning_map();
    auto plan = pursuit_options().plan;
    plan.explains = false;
    const auto way = [&](const Point2& from, const Point2& to) {
      const auto x = plan_path(map.cells(), map.clearance(), from, to, plan);
      return x.points.empty() ? std::numeric_limits<double>::infinity() : x.length;
    };
    return graph().between({pose()->x, pose()->y}, goal, way);
  }

  // -- routes

  Route route_to(const GraphRoutes::Place& goal, bool along_graph) {
    Route result;
    result.reason = goal.reason;
    if (along_graph && goal.reason.empty())
      result.places = nodes_to(goal.place);
    if (result.places.empty() || result.places.back() != goal.place)
      result.places.push_back(goal.place);
    return result;
  }

  /// To the place around the object that takes the shortest way.
  Route route_near(const GoToObject& x) {
    const auto& map = planning_map();
    auto options = pursuit_options().plan;
    options.explains = false;
    Route best;
    double shortest = std::numeric_limits<double>::infinity();
    std::string reason;
    constexpr int directions = 16;
    for (int i = 0; i < directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / directions;
      const Point2 place{x.x + x.distance * std::cos(angle), x.y + x.distance * std::sin(angle)};
      const auto plan =
        plan_path(map.cells(), map.clearance(), {pose()->x, pose()->y}, place, options);
      if (plan.points.empty()) {
        reason = plan.reason;
      } else if (plan.length < shortest) {
        shortest = plan.length;
        best = {{place}, normalised(angle + std::numbers::pi), {}};
      }
    }
    if (best.places.empty())
      best.reason =
        fmt::format("no place {:.2f} m from the object can be reached: {}", x.distance, reason);
    return best;
  }

  Option<std::string> people_{this, "people", "",
                              "subarchitecture of a PersonTracker; empty: none"};
  Option<std::string> graph_{this, "graph", "",
                             "subarchitecture of the navigation graph; empty: none"};

  bool are_gateways_old_ = true;
};

CASTOR_COMPONENT(Navigator, "moves the robot: goes to places, follows people, turns, stops")

} // namespace

} // namespace castor::mapping
