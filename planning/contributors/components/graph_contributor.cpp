#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/values_of.hpp"
#include "castor/planning/contributors/graph_facts.hpp"

#include <string>

namespace castor::planning {

namespace {

/// Says in the words of a domain what the navigation graph of its subarchitecture knows: a
/// contributor of continual planning.
class GraphContributor final : public ManagedComponent {
  void configure() override {
    terms_.agent = agent_;
    terms_.agent_type = agent_type_;
    terms_.area_type = area_type_;
    terms_.label_type = label_type_;
    terms_.position = position_;
    terms_.label = label_;
    terms_.connected = connected_;
  }

  void start() override {
    on_call<StateRequest>([this](const StateRequest&) {
      GraphEntries graph;
      graph.nodes = values_of(read_all<mapping::GraphNode>());
      graph.edges = values_of(read_all<mapping::GraphEdge>());
      graph.areas = values_of(read_all<mapping::Area>());
      for (const auto& x : read_all<mapping::RobotArea>())
        graph.robot = *x;
      return facts_of(graph, terms_);
    });
  }

  Option<std::string> agent_{this, "agent", "robot", "the robot as an object"};
  Option<std::string> agent_type_{this, "agent-type", "robot", "its type"};
  Option<std::string> area_type_{this, "area-type", "room", "type of areas"};
  Option<std::string> label_type_{this, "label-type", "area-name",
                                  "type of what people call areas"};
  Option<std::string> position_{this, "position", "is-in", "state variable: the robot's area"};
  Option<std::string> label_{this, "label", "area-of",
                             "state variable: the area that people call so"};
  Option<std::string> connected_{this, "connected", "connected",
                                 "predicate of areas with a way between them"};

  GraphFactTerms terms_;
};

CASTOR_COMPONENT(GraphContributor,
                 "says which areas there are and where the robot is, for planning")

} // namespace

} // namespace castor::planning
