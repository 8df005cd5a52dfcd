#pragma once

#include "castor/mapping/graph/types.hpp"
#include "castor/planning/continual/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::planning {

/// In which words of a domain it is told what the navigation graph knows.
struct GraphFactTerms {
  std::string agent = "robot";
  std::string agent_type = "robot";
  std::string area_type = "room";
  /// Type of what people call areas.
  std::string label_type = "area-name";
  /// State variable: the area of the agent.
  std::string position = "is-in";
  /// State variable: the area that people call so.
  std::string label = "area-of";
  /// Predicate of two areas with a way between them.
  std::string connected = "connected";
};

/// The entries of a navigation graph.
struct GraphEntries {
  std::vector<mapping::GraphNode> nodes;
  std::vector<mapping::GraphEdge> edges;
  std::vector<mapping::Area> areas;
  std::optional<mapping::RobotArea> robot;
};

/// Areas ("area-7"), their labels, the ways between them, and where the robot is.
StateReply facts_of(const GraphEntries& graph, const GraphFactTerms& terms);

} // namespace castor::planning
