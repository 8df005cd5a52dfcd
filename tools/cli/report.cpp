#include "castor/tools/cli/report.hpp"

#include "castor/tools/cli/table.hpp"
#include "castor/wm/values/json.hpp"

#include <algorithm>

#include <fmt/core.h>

#include <map>
#include <utility>
#include <vector>

namespace castor::cli {

namespace {

std::string in_quotes(const std::string& x) {
  std::string result = "\"";
  for (char c : x) {
    if (c == '"' || c == '\\')
      result += '\\';
    if (static_cast<unsigned char>(c) >= 0x20)
      result += c;
  }
  return result + '"';
}

std::string links_as_text(const SystemSummary& summary) {
  std::map<ProcessNumber, std::string> names;
  for (auto& process : summary.processes)
    for (auto& x : process.links)
      names[x.news.peer] = x.news.peer == 0 ? "localhost" : x.news.name;
  Table result{{"link", ">events out", ">events in", ">messages out", ">messages in", ">sent",
                ">received", ">connections"}};
  for (auto& process : summary.processes)
    for (auto& x : process.links) {
      auto& from = process.description.name;
      result.add({(from.empty() ? "localhost" : from) + " - " + names[x.news.peer],
                  std::to_string(x.events_out), std::to_string(x.events_in),
                  std::to_string(x.messages_out), std::to_string(x.messages_in),
                  fmt::format("{:.1f} MB", static_cast<double>(x.bytes_out) / 1e6),
                  fmt::format("{:.1f} MB", static_cast<double>(x.bytes_in) / 1e6),
                  std::to_string(x.connections)});
    }
  return result.text();
}

} // namespace

std::string report(const SystemSummary& summary) {
  Table entries{{"working memory", "type", ">entries"}};
  Table events{{"working memory", ">events", ">matched", ">delivered", ">coalesced", ">suppressed",
                ">forwarded", ">routed", ">refused"}};
  for (auto& wm : summary.working_memories) {
    std::string name = wm.subarchitecture;
    for (auto& [type, count] : wm.entries_by_type)
      entries.add({std::exchange(name, {}), type, std::to_string(count)});
    if (wm.entries_by_type.empty())
      entries.add({name, "(empty)", "0"});
    std::vector<std::string> row{wm.subarchitecture};
    for (auto x : {wm.events, wm.matched, wm.delivered, wm.coalesced, wm.suppressed, wm.forwarded,
                   wm.routed, wm.refused})
      row.push_back(std::to_string(x));
    events.add(row);
  }
  Table components{
    {"component", "state", ">restarts", ">events", ">callbacks", ">writes", ">reads"}};
  for (auto& x : summary.components) {
    components.add({x.identity.full_name(), state_of(x), std::to_string(x.restarts),
                    std::to_string(x.events_received), std::to_string(x.callbacks),
                    std::to_string(x.writes), std::to_string(x.reads)});
    if (x.pushes_dropped > 0)
      components.remark(fmt::format(
        "{} of its pushes were dropped for receivers that did not keep up", x.pushes_dropped));
    if (!x.failure.empty())
      components.remark(x.failure);
  }
  auto result = entries.text() + '\n' + components.text() + '\n' + events.text();
  if (summary.processes.size() > 1)
    result += '\n' + links_as_text(summary);
  return result;
}

bool has_failed(const SystemSummary& summary) {
  return !summary.unstopped.empty() || std::ranges::any_of(summary.components, [](auto& x) {
    return x.state == ComponentState::failed;
  });
}

std::string entries_as_json(System& system) {
  // Pictures are written as pictures, not as text.
  JsonOptions options;
  options.max_bytes = 64;
  std::string out = "{";
  const char* separator = "\n";
  for (auto& name : system.subarchitectures()) {
    out += separator + in_quotes(name) + ": [";
    separator = ",\n";
    const char* inner = "\n";
    for (auto& entry : system.entries(name)) {
      out += fmt::format("{}  {{\"id\": {}, \"type\": {}, \"version\": {}, \"writer\": {}, "
                         "\"value\": {}}}",
                         inner, in_quotes(entry->address.id), in_quotes(entry->type_name()),
                         entry->version, in_quotes(entry->writer), to_json(entry->value, options));
      inner = ",\n";
    }
    out += "\n]";
  }
  return out + "\n}\n";
}

} // namespace castor::cli
