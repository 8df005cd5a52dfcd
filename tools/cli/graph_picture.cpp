#include "castor/tools/cli/graph_picture.hpp"

#include "castor/base/markup.hpp"
#include "castor/tools/cli/dot_string.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <graphviz/gvc.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

namespace castor::cli {

namespace {

using Json = nlohmann::ordered_json;

/// More types than this beside an arrow are only counted.
constexpr std::size_t most_types = 6;

std::string text(const Json& x) {
  return x.get<std::string>();
}

/// As an arrow's label: one type on a line, with a margin to the arrow.
std::string types_as_label(const std::set<std::string>& types) {
  std::string result = "<<table border=\"0\" cellborder=\"0\" cellspacing=\"0\" cellpadding=\"2\">";
  auto line = [&](const std::string& x) {
    result += "<tr><td align=\"left\">" + escaped(x) + "</td></tr>";
  };
  auto shown = types.size() > most_types ? most_types - 1 : types.size();
  auto i = types.begin();
  for (std::size_t n = 0; n < shown; ++n)
    line(*i++);
  if (shown < types.size())
    line(fmt::format("+ {} more", types.size() - shown));
  return result + "</table>>";
}

/// From whom to whom, and whether it is a write.
struct Arrow {
  std::string from;
  std::string to;
  bool writes = false;

  auto operator<=>(const Arrow&) const = default;
};

struct Graph {
  std::string system;
  /// Components that use something, by subarchitecture; the key is empty for stand-alone ones.
  std::map<std::string, std::set<std::string>> components;
  /// Subarchitectures whose working memory is used.
  std::set<std::string> working_memories;
  std::map<Arrow, std::set<std::string>> arrows;
};

std::string node_of_working_memory(const std::string& subarchitecture) {
  return "wm/" + subarchitecture;
}

std::string node_of_component(const std::string& name) {
  return "component/" + name;
}

Graph graph_of(const Json& report, const std::vector<Json>& accesses) {
  Graph result;
  result.system = text(report["system"]);
  std::map<std::string, std::string> homes;
  for (auto& x : report["components"])
    homes[text(x["name"])] = text(x["subarchitecture"]);
  for (auto& x : accesses) {
    auto home = homes.find(text(x["component"]));
    if (home == homes.end())
      continue;
    auto component = node_of_component(home->first);
    auto subarchitecture = text(x["subarchitecture"]);
    auto wm = node_of_working_memory(subarchitecture);
    auto sum = [&](std::initializer_list<const char*> counters) {
      std::uint64_t n = 0;
      for (auto* counter : counters)
        n += x[counter].get<std::uint64_t>();
      return n;
    };
    if (sum({"adds", "overwrites", "deletes"}) > 0)
      result.arrows[{component, wm, true}].insert(text(x["type"]));
    if (sum({"reads", "events"}) > 0)
      result.arrows[{wm, component, false}].insert(text(x["type"]));
    result.components[home->second].insert(home->first);
    result.working_memories.insert(subarchitecture);
  }
  return result;
}

std::string nodes_as_dot(const Graph& graph) {
  std::string result;
  auto names = graph.working_memories;
  for (auto& [subarchitecture, components] : graph.components)
    names.insert(subarchitecture);
  for (auto& name : names) {
    if (!name.empty())
      result += fmt::format("  subgraph {} {{\n    label=<<b>{}</b>>; margin=14;\n",
                            dot_string("cluster_" + name), escaped(name));
    if (graph.working_memories.count(name) > 0)
      result += fmt::format("    {} [label=\"working memory\", shape=cylinder, "
                            "fillcolor=\"#fde9c9\", color=\"#b8772b\", margin=\"0.25,0.12\"];\n",
                            dot_string(node_of_working_memory(name)));
    if (auto i = graph.components.find(name); i != graph.components.end())
      for (auto& component : i->second)
        result += fmt::format("    {} [label={}];\n", dot_string(node_of_component(component)),
                              dot_string(component));
    if (!name.empty())
      result += "  }\n";
  }
  return result;
}

std::string as_dot(const Graph& graph) {
  auto result = "digraph " + dot_string(graph.system) +
                " {\n  rankdir=LR; nodesep=0.35; ranksep=0.5; fontname=\"Helvetica\";"
                " fontsize=15; pad=0.3; bgcolor=white;\n"
                "  graph [style=\"rounded,filled\", fillcolor=\"#f4f6f9\", color=\"#aab4c4\", "
                "labeljust=l];\n"
                "  node [fontname=\"Helvetica\", fontsize=13, shape=box, style=\"rounded,filled\", "
                "fillcolor=\"#dbe8f8\", color=\"#3f6ea5\", margin=\"0.18,0.09\", height=0.4];\n"
                "  edge [fontname=\"Helvetica\", fontsize=10, arrowsize=0.7];\n" +
                nodes_as_dot(graph);
  for (auto& [arrow, types] : graph.arrows)
    result += fmt::format("  {} -> {} [label={}, {}];\n", dot_string(arrow.from),
                          dot_string(arrow.to), types_as_label(types),
                          arrow.writes ? "color=\"#a3541c\", fontcolor=\"#7a3c11\""
                                       : "color=\"#3f6ea5\", fontcolor=\"#27496f\", style=dashed");
  return result + "}\n";
}

struct CloseGraph {
  void operator()(Agraph_t* x) const { agclose(x); }
};
struct FreeContext {
  void operator()(GVC_t* x) const { gvFreeContext(x); }
};

} // namespace

std::string usage_as_svg(const Json& report, const std::vector<Json>& accesses) {
  std::unique_ptr<GVC_t, FreeContext> context{gvContext()};
  std::unique_ptr<Agraph_t, CloseGraph> graph{
    agmemread(as_dot(graph_of(report, accesses)).c_str())};
  if (!context || !graph || gvLayout(context.get(), graph.get(), "dot") != 0)
    throw std::runtime_error("Graphviz cannot lay out the graph; are its plugins there "
                             "(libgvc6-plugins or the package graphviz)?");
  char* data = nullptr;
  unsigned size = 0;
  int error = gvRenderData(context.get(), graph.get(), "svg", &data, &size);
  std::string result;
  if (error == 0)
    result.assign(data, size);
  gvFreeRenderData(data);
  gvFreeLayout(context.get(), graph.get());
  if (error != 0)
    throw std::runtime_error("Graphviz cannot draw the graph as SVG");
  return result;
}

} // namespace castor::cli
