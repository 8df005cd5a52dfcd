#include "castor/planning/contributors/graph_facts.hpp"

#include "castor/mapping/graph/adjoining_areas.hpp"
#include "castor/planning/continual/object_name.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace castor::planning {

namespace {

using mapping::Area;

std::string name_of(std::int64_t area) {
  return "area-" + std::to_string(area);
}

} // namespace

StateReply facts_of(const GraphEntries& graph, const GraphFactTerms& terms) {
  StateReply result;
  result.objects.push_back({terms.agent, terms.agent_type});
  std::set<std::int64_t> known;
  std::map<std::string, std::set<std::int64_t>> labels;
  for (const auto& x : graph.areas) {
    // What was merged is a part of another one.
    if (x.merged_into >= 0)
      continue;
    known.insert(x.id);
    result.objects.push_back({name_of(x.id), terms.area_type});
    if (!x.label.empty())
      labels[word_name(x.label)].insert(x.id);
  }
  for (const auto& [label, areas] : labels) {
    result.objects.push_back({label, terms.label_type});
    // Of two areas with one name it is not known which is meant.
    if (areas.size() == 1)
      result.facts.push_back("(= (" + terms.label + " " + label + ") " + name_of(*areas.begin()) +
                             ")");
  }
  for (const auto& [a, b] : mapping::adjoining_areas(graph.nodes, graph.edges))
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}})
      if (known.contains(from) && known.contains(to))
        result.facts.push_back("(" + terms.connected + " " + name_of(from) + " " + name_of(to) +
                               ")");
  std::set<std::string> distinct(result.facts.begin(), result.facts.end());
  if (graph.robot && known.contains(graph.robot->area))
    distinct.insert("(= (" + terms.position + " " + terms.agent + ") " +
                    name_of(graph.robot->area) + ")");
  result.facts.assign(distinct.begin(), distinct.end());
  return result;
}

} // namespace castor::planning
