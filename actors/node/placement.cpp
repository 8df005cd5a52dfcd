#include "castor/actors/node/placement.hpp"

#include <unistd.h>

#include <array>
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
  for_each_component(architecture, [&](const ComponentDescription& x) {
    auto node = nodes.find(x.host);
    if (node == nodes.end() && is_this_machine(architecture, x.host))
      return;
    auto [i, is_new] =
      result.hosts.try_emplace(x.host, static_cast<ProcessNumber>(result.processes.size()));
    result.of[x.name] = i->second;
    if (!is_new)
      return;
    try {
      auto at = node == nodes.end() ? parse_endpoint(x.host, default_node_port) : node->second;
      result.processes.push_back({given_name(architecture, x.host), at.host, at.port});
    } catch (const std::invalid_argument& e) {
      result.processes.emplace_back();
      result.problems.push_back({cast::Severity::error,
                                 x.where,
                                 x.line,
                                 {},
                                 "the host of " + x.name + " is no address: " + e.what(),
                                 {}});
    }
  });
  return result;
}

std::map<std::string, std::string> other_hosts(const ArchitectureDescription& architecture) {
  std::map<std::string, std::string> result;
  for_each_component(architecture, [&](const ComponentDescription& x) {
    if (is_this_machine(architecture, x.host))
      return;
    auto name = given_name(architecture, x.host);
    result[x.host] = name.empty() ? x.host : name;
  });
  return result;
}

void spread(ArchitectureDescription& architecture, int nodes) {
  int next = 0;
  for_each_component(architecture, [&](ComponentDescription& x) {
    x.host = "node" + std::to_string(1 + next++ % nodes);
  });
}

} // namespace castor
