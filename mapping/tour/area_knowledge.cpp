#include "castor/mapping/tour/area_knowledge.hpp"

#include "castor/mapping/graph/adjoining_areas.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace castor::mapping {

namespace {

using binding::Feature;
using binding::FeatureKind;

constexpr auto self = "self";

std::string id_of(std::int64_t area) {
  return "area-" + std::to_string(area);
}

Feature concept_of(const std::string& name) {
  return binding::feature(FeatureKind::concept_name, name);
}

} // namespace

std::string concept_of_label(std::string label) {
  std::ranges::replace(label, ' ', '_');
  return label;
}

std::string label_of_concept(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

binding::KnowledgeReply knowledge_of_areas(const std::vector<Area>& areas,
                                           const std::vector<GraphNode>& nodes,
                                           const std::vector<GraphEdge>& edges,
                                           std::optional<std::int64_t> robot) {
  binding::KnowledgeReply result;
  std::set<std::int64_t> known;
  for (auto& x : areas) {
    // What was merged is a part of another one.
    if (x.merged_into >= 0)
      continue;
    known.insert(x.id);
    auto& room = result.things.emplace_back(binding::KnownUnion{id_of(x.id), {}, {}});
    room.features.push_back(concept_of("room"));
    if (!x.label.empty())
      room.features.push_back(concept_of(concept_of_label(x.label)));
  }
  result.things.push_back({self, {}, {concept_of(self)}});
  if (robot && known.contains(*robot))
    result.relations.push_back({binding::containment_label, self, id_of(*robot)});
  for (auto& [a, b] : adjoining_areas(nodes, edges))
    if (known.contains(a) && known.contains(b)) {
      result.relations.push_back({"near", id_of(a), id_of(b)});
      result.relations.push_back({"near", id_of(b), id_of(a)});
    }
  return result;
}

std::string reply_to_name(const std::string& label, const std::optional<std::string>& before) {
  if (!before)
    return "Ok, I will call it the " + label + " when I have come there.";
  if (*before == label)
    return "Yes, this is the " + label + ".";
  return "Ok, this is the " + label + (before->empty() ? "." : ", and not the " + *before + ".");
}

} // namespace castor::mapping
