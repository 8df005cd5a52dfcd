#include "castor/actors/node/placement.hpp"

#include "castor/base/suggestion.hpp"

#include <unistd.h>

#include <array>
#include <optional>
#include <set>
#include <stdexcept>

namespace castor {

namespace {

bool is_this_machine(const ArchitectureDescription& architecture, const std::string& host) {
  auto localhost = architecture.host_names.find("localhost");
  return host.empty() || host == "localhost" || host == "127.0.0.1" || host == "::1" ||
         host == name_of_machine() ||
         (localhost != architecture.host_names.end() && host == localhost->second);
}

/// Empty if no HOSTNAME line names the host.
std::string given_name(const ArchitectureDescription& architecture, const std::string& host) {
  for (auto& [name, definition] : architecture.host_names)
    if (definition == host)
      return name;
  return {};
}

} // namespace

std::string name_of_machine() {
  std::array<char, 256> result{};
  gethostname(result.data(), result.size() - 1);
  return result.data();
}

Placement place(const ArchitectureDescription& architecture,
                const std::map<std::string, Endpoint>& nodes, Placement known) {
  auto result = std::move(known);
  result.of.clear();
  // The process at a host; nothing for this one.
  auto process_at = [&](const std::string& host, const std::string& whose,
                        const SourceLocation& where,
                        const std::string& line) -> std::optional<ProcessNumber> {
    auto node = nodes.find(host);
    if (node == nodes.end() && is_this_machine(architecture, host))
      return std::nullopt;
    auto [i, is_new] =
      result.hosts.try_emplace(host, static_cast<ProcessNumber>(result.processes.size()));
    if (!is_new)
      return i->second;
    try {
      auto at = node == nodes.end() ? parse_endpoint(host, default_node_port) : node->second;
      result.processes.push_back({given_name(architecture, host), at.host, at.port});
    } catch (const std::invalid_argument& e) {
      result.processes.emplace_back();
      result.problems.push_back({Severity::error,
                                 where,
                                 line,
                                 {},
                                 "the host of " + whose + " is no address: " + e.what(),
                                 {}});
    }
    return i->second;
  };
  for_each_component(architecture, [&](const ComponentDescription& x) {
    if (auto process = process_at(x.host, x.name, x.where, x.line))
      result.of[x.name] = *process;
  });
  for (auto& rule : architecture.failover)
    for (auto& host : rule.hosts)
      process_at(host, rule.who, rule.where, "FAILOVER " + rule.who + " TO " + host);
  return result;
}

std::map<std::string, std::string> other_hosts(const ArchitectureDescription& architecture) {
  std::map<std::string, std::string> result;
  auto add = [&](const std::string& host) {
    if (is_this_machine(architecture, host))
      return;
    auto name = given_name(architecture, host);
    result[host] = name.empty() ? host : name;
  };
  for_each_component(architecture, [&](const ComponentDescription& x) { add(x.host); });
  for (auto& rule : architecture.failover)
    for (auto& host : rule.hosts)
      add(host);
  return result;
}

std::string host_called(const ArchitectureDescription& architecture, const std::string& name) {
  std::set<std::string> used;
  for_each_component(architecture, [&](const ComponentDescription& x) { used.insert(x.host); });
  for (auto& rule : architecture.failover)
    used.insert(rule.hosts.begin(), rule.hosts.end());
  if (auto i = architecture.host_names.find(name); i != architecture.host_names.end()) {
    if (name != "localhost" && is_this_machine(architecture, i->second))
      throw std::invalid_argument("in " + architecture.file + ", the host " + name +
                                  " is this machine, as is everything without a host; give it an "
                                  "address of its own there: HOSTNAME " +
                                  name + ' ' + name + ".local");
    return i->second;
  }
  for (auto& [known, address] : architecture.host_names)
    if (address == name)
      return name;
  if (used.contains(name))
    return name;
  std::set<std::string> names;
  for (auto& [known, address] : architecture.host_names)
    if (!is_this_machine(architecture, address))
      names.insert(known);
  for (auto& host : used)
    if (!is_this_machine(architecture, host) && given_name(architecture, host).empty())
      names.insert(host);
  auto text = architecture.file + " has no host " + name + "; ";
  if (names.empty())
    throw std::invalid_argument(text + "everything in it runs on this machine");
  if (auto guess = did_you_mean(name, {names.begin(), names.end()}); !guess.empty())
    text += guess + ' ';
  text += "its hosts are: ";
  for (auto& x : names)
    text += (x == *names.begin() ? "" : ", ") + x;
  throw std::invalid_argument(text);
}

void spread(ArchitectureDescription& architecture, int nodes) {
  int next = 0;
  for_each_component(architecture, [&](ComponentDescription& x) {
    x.host = "node" + std::to_string(1 + next++ % nodes);
  });
}

} // namespace castor
