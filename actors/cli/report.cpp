#include "castor/actors/cli/report.hpp"

#include "castor/wm/json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

namespace castor::cli {

namespace {

std::string state_of(const ComponentStatus& x) {
  for (auto& [name, state] : reflection_of<ComponentState>().enumerators)
    if (state == x.state)
      return std::string{name};
  return {};
}

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

} // namespace

std::string report(const SystemSummary& summary) {
  std::string out;
  auto line = [&]<class... Ts>(fmt::format_string<Ts...> format, Ts&&... xs) {
    fmt::format_to(std::back_inserter(out), format, std::forward<Ts>(xs)...);
    out += '\n';
  };
  line("{:<16} {:<24} {:>8}", "working memory", "type", "entries");
  for (auto& wm : summary.working_memories) {
    std::uint64_t total = 0;
    for (auto& [type, count] : wm.entries_by_type) {
      line("{:<16} {:<24} {:>8}", total == 0 ? wm.subarchitecture : "", type, count);
      total += count;
    }
    if (total == 0)
      line("{:<16} {:<24} {:>8}", wm.subarchitecture, "(empty)", 0);
  }
  line("");
  line("{:<28} {:<10} {:>8} {:>9} {:>8} {:>8}", "component", "state", "events", "callbacks",
       "writes", "reads");
  for (auto& x : summary.components) {
    line("{:<28} {:<10} {:>8} {:>9} {:>8} {:>8}", x.identity.full_name(), state_of(x),
         x.events_received, x.callbacks, x.writes, x.reads);
    if (x.pushes_dropped > 0)
      line("  {} of its pushes were dropped for receivers that did not keep up", x.pushes_dropped);
    if (!x.failure.empty())
      line("  {}", x.failure);
  }
  return out;
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
