#pragma once

#include "castor/binding/types.hpp"
#include "castor/mapping/graph/types.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace castor::mapping {

/// The concept that an area's label stands for, "living_room" of "living room".
std::string concept_of_label(std::string label);

/// The label of an area that is called by a concept.
std::string label_of_concept(std::string name);

/// What there is to say of areas: rooms, of the concepts of their labels, next to which others they
/// are ("near"), and in which of them the robot itself is.
/// @param robot area where it is; nothing if that is not known
binding::KnowledgeReply knowledge_of_areas(const std::vector<Area>& areas,
                                           const std::vector<GraphNode>& nodes,
                                           const std::vector<GraphEdge>& edges,
                                           std::optional<std::int64_t> robot);

/// Said to who has called the place here by a name.
/// @param before what it was called before; nothing if it is not known yet which area it is
std::string reply_to_name(const std::string& label, const std::optional<std::string>& before);

} // namespace castor::mapping
