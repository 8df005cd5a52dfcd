#include "castor/tools/cli/inspection_text.hpp"

#include "castor/tools/cli/dot_string.hpp"
#include "castor/tools/cli/table.hpp"
#include "castor/tools/cli/timeline.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace castor::cli {

namespace {

std::string value_text(const Json& x) {
  return x.is_string() ? x.get<std::string>() : x.dump();
}

/// What stands under these keys; nothing where there is nothing.
std::vector<std::string> cells(const Json& x, const std::vector<const char*>& keys) {
  std::vector<std::string> result;
  for (auto* key : keys)
    result.push_back(x.contains(key) ? value_text(x[key]) : "");
  return result;
}

std::string full_name(const Json& component) {
  auto subarchitecture = component["subarchitecture"].get<std::string>();
  auto name = component["name"].get<std::string>();
  return subarchitecture.empty() ? name : subarchitecture + '.' + name;
}

/// Which part of a processor, on average.
std::string load(double cpu, double age) {
  return age > 0 ? fmt::format("{:.1f} %", 100 * cpu / age) : "";
}

std::string megabytes(const Json& bytes) {
  return fmt::format("{:.1f} MB", bytes.get<double>() / 1e6);
}

std::string nodes_as_text(const Json& report) {
  Table table{{"node", "address", "state", ">components", ">load", ">memory"}};
  for (auto& x : report["nodes"]) {
    auto row = cells(x, {"name", "address", "state", "components"});
    if (x.contains("cpu")) {
      row.push_back(load(x["cpu"], x["age"]));
      row.push_back(megabytes(x["memory"]));
    }
    table.add(row);
    if (x["state"] != "up")
      table.remark(x["reason"]);
  }
  return table.text();
}

std::string components_as_text(const Json& report) {
  Table table{{"component", "class", "node", "state", ">restarts", ">load", ">busy", ">events",
               ">callbacks", ">writes", ">reads"}};
  for (auto& x : report["components"]) {
    auto row = cells(x, {"name", "class", "node", "state", "restarts"});
    row.front() = full_name(x);
    row.push_back(load(x["cpu"], report["age"]));
    row.push_back(fmt::format("{:.1f} s", x["busy"].get<double>()));
    for (auto& cell : cells(x, {"events", "callbacks", "writes", "reads"}))
      row.push_back(cell);
    table.add(row);
    if (auto failure = x["failure"].get<std::string>(); !failure.empty())
      table.remark(failure);
    if (auto obeys = x["obeys"].get<std::string>(); !obeys.empty())
      table.remark("obeys " + obeys);
  }
  return table.text();
}

std::string working_memories_as_text(const Json& report) {
  Table table{{"working memory", "node", ">entries", ">filters", ">leases", ">waiting", "journal"}};
  for (auto& x : report["working_memories"]) {
    auto row = cells(x, {"subarchitecture", "node", "entries", "filters", "leases", "waiting"});
    auto& journal = x["journal"];
    row.push_back(value_text(journal["mode"]));
    if (journal.contains("bytes"))
      row.back() += fmt::format(", {}, {} unsynced", megabytes(journal["bytes"]),
                                value_text(journal["unsynced"]));
    if (journal.contains("failure"))
      row.back() = "FAILED";
    table.add(row);
    if (journal.contains("failure"))
      table.remark(journal["failure"]);
  }
  return table.text();
}

std::string event_stages_as_text(const Json& report) {
  Table table{{"working memory", ">events", ">matched", ">delivered", ">coalesced", ">suppressed",
               ">backlog", ">forwarded", ">routed", ">refused"}};
  for (auto& x : report["working_memories"])
    table.add(cells(x, {"subarchitecture", "events", "matched", "delivered", "coalesced",
                        "suppressed", "backlog", "forwarded", "routed", "refused"}));
  return table.text();
}

/// What components of a system that broadcasts did with events; empty for other systems.
std::string rejections_as_text(const Json& report) {
  Table table{{"component", ">events", ">rejected", ">callbacks"}};
  bool has_rejected = false;
  for (auto& x : report["components"]) {
    has_rejected = has_rejected || x["rejected"] != 0;
    auto row = cells(x, {"name", "events", "rejected", "callbacks"});
    row.front() = full_name(x);
    table.add(row);
  }
  return has_rejected ? '\n' + table.text() : "";
}

std::string links_as_text(const Json& report) {
  Table table{{"link", "state", ">events out", ">events in", ">messages out", ">messages in",
               ">sent", ">received", ">connections", ">unacknowledged"}};
  for (auto& node : report["nodes"]) {
    if (!node.contains("links"))
      continue;
    for (auto& x : node["links"]) {
      auto row =
        cells(x, {"to", "state", "events_out", "events_in", "messages_out", "messages_in"});
      row.front() = value_text(node["name"]) + " - " + row.front();
      row.push_back(megabytes(x["bytes_out"]));
      row.push_back(megabytes(x["bytes_in"]));
      row.push_back(value_text(x["connections"]));
      row.push_back(megabytes(x["unacknowledged"]));
      table.add(row);
    }
  }
  return table.text();
}

/// "adds 3, deletes 1": of these counters, those that are not zero.
std::string counts(const Json& x, const std::vector<const char*>& keys) {
  std::string result;
  for (auto* key : keys)
    if (x[key] != 0)
      result += fmt::format("{}{} {}", result.empty() ? "" : ", ", key, value_text(x[key]));
  return result;
}

} // namespace

std::string clock_as_text(const Json& x) {
  if (x["kind"] == "real")
    return "the real clock";
  auto speed = x["speed"].is_number()
                 ? fmt::format("{:g} times real time", x["speed"].get<double>())
                 : std::string{"as fast as possible"};
  return fmt::format("simulated time {:.3f} s, {}{}", x["time"].get<double>(), speed,
                     x["paused"].get<bool>() ? ", paused" : "");
}

std::string system_as_text(const Json& report, bool stats) {
  auto result = fmt::format("{}: process {}, {:.1f} s old, {}\n", value_text(report["system"]),
                            value_text(report["process"]), report["age"].get<double>(),
                            value_text(report["file"]));
  if (report["clock"]["kind"] != "real")
    result += clock_as_text(report["clock"]) + '\n';
  result += '\n';
  result += nodes_as_text(report) + '\n' + components_as_text(report) + '\n' +
            working_memories_as_text(report);
  if (!stats)
    return result;
  result += '\n' + event_stages_as_text(report) + rejections_as_text(report);
  if (report["nodes"].size() > 1)
    result += '\n' + links_as_text(report);
  return result;
}

std::string entries_as_text(const std::vector<Json>& entries) {
  bool values = !entries.empty() && entries.front().contains("value");
  Table table{
    {"subarchitecture", "id", "type", ">version", "writer", ">bytes", values ? "value" : ""}};
  for (auto& x : entries)
    table.add(cells(x, {"subarchitecture", "id", "type", "version", "writer", "bytes", "value"}));
  return table.text();
}

std::string actions_as_text(const std::vector<Json>& actions, const std::vector<Json>& offers) {
  Table asked{{"action", "type", "status", ">progress", "requester", "executor"}};
  for (auto& x : actions) {
    auto& action = x["value"];
    auto subarchitecture = value_text(x["subarchitecture"]);
    auto is_over = action["status"] == "over";
    asked.add({subarchitecture + '/' + value_text(x["id"]), value_text(action["what"]["type"]),
               value_text(is_over ? action["outcome"] : action["status"]),
               fmt::format("{:.0f} %", 100 * action["progress"].get<double>()),
               subarchitecture + '.' + value_text(action["requester"]),
               value_text(action["subarchitecture"]) + '.' +
                 (action["executor"] == "" ? "?" : value_text(action["executor"]))});
    if (action["reason"] != "")
      asked.remark(value_text(action["reason"]));
  }
  Table offered{{"type", "executor", "pause", "cancel", "preconditions"}};
  auto yes_or_no = [](const Json& x) { return x.get<bool>() ? "yes" : "no"; };
  for (auto& x : offers) {
    auto& offer = x["value"];
    offered.add({value_text(offer["type"]),
                 value_text(x["subarchitecture"]) + '.' + value_text(offer["component"]),
                 yes_or_no(offer["can_pause"]), yes_or_no(offer["can_cancel"]),
                 value_text(offer["preconditions"])});
  }
  return (asked.empty() ? "no component has asked for an action\n" : asked.text()) + '\n' +
         (offered.empty() ? "no component offers actions\n" : offered.text());
}

std::string change_as_text(const Json& change, bool coloured) {
  auto result = timeline_line(change, coloured) + '\n';
  if (change.contains("value"))
    result += "    " + change["value"].dump() + '\n';
  return result;
}

std::string usage_as_dot(const Json& report, const std::vector<Json>& accesses) {
  std::map<std::string, std::set<std::string>> components;
  std::map<std::string, std::set<std::string>> types;
  std::set<std::string> known;
  for (auto& x : report["components"]) {
    auto name = value_text(x["name"]);
    known.insert(name);
    // Task managers alone are no news.
    components[value_text(x["subarchitecture"])];
  }
  auto type_of = [](const Json& x) {
    return value_text(x["subarchitecture"]) + '/' + value_text(x["type"]);
  };
  std::string edges;
  std::set<std::string> used;
  for (auto& x : accesses) {
    auto component = value_text(x["component"]);
    if (known.count(component) == 0)
      continue;
    used.insert(component);
    types[value_text(x["subarchitecture"])].insert(type_of(x));
    if (auto label = counts(x, {"adds", "overwrites", "deletes"}); !label.empty())
      edges += fmt::format("  {} -> {} [label={}];\n", dot_string(component),
                           dot_string(type_of(x)), dot_string(label));
    if (auto label = counts(x, {"events", "reads"}); !label.empty())
      edges += fmt::format("  {} -> {} [label={}, style=dashed];\n", dot_string(type_of(x)),
                           dot_string(component), dot_string(label));
  }
  for (auto& x : report["components"])
    if (used.count(value_text(x["name"])) > 0)
      components[value_text(x["subarchitecture"])].insert(value_text(x["name"]));
  std::string result = "digraph " + dot_string(value_text(report["system"])) +
                       " {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n"
                       "  edge [fontname=\"sans-serif\", fontsize=10];\n";
  for (auto& [subarchitecture, names] : components) {
    bool grouped = !subarchitecture.empty();
    if (grouped)
      result += fmt::format("  subgraph {} {{\n    label={};\n",
                            dot_string("cluster_" + subarchitecture), dot_string(subarchitecture));
    for (auto& name : names)
      result += fmt::format("    {} [shape=box];\n", dot_string(name));
    for (auto& type : types[subarchitecture])
      result +=
        fmt::format("    {} [label={}, shape=ellipse, style=filled, fillcolor=\"#eeeeee\"];\n",
                    dot_string(type), dot_string(type.substr(type.find('/') + 1)));
    if (grouped)
      result += "  }\n";
  }
  return result + edges + "}\n";
}

} // namespace castor::cli
