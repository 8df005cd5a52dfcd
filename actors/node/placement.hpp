#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/node/part_protocol.hpp"
#include "castor/base/diagnostic.hpp"

#include <map>
#include <string>
#include <vector>

namespace castor {

/// The port at which nodes listen unless told otherwise.
inline constexpr std::uint16_t default_node_port = 7117;

/// Which processes a system runs in, and what runs where.
struct Placement {
  /// The first is the coordinator's.
  std::vector<ProcessDescription> processes{1};
  /// The processes at other hosts.
  std::map<std::string, ProcessNumber> hosts;
  /// By the names of the components; the coordinator's own are left out.
  std::map<std::string, ProcessNumber> of;
  /// Errors of hosts that are no addresses.
  std::vector<Diagnostic> problems;

  /// Process in which a component runs.
  ProcessNumber process_of(const std::string& component) const {
    return castor::process_of(of, component);
  }
};

/// Places every component where its host says: in the coordinator's process if that is this
/// machine, otherwise at the node that listens there. `nodes` has the addresses of nodes by host,
/// this machine included; other hosts are read as HOST or HOST:PORT.
///
/// Where a HOSTNAME line names the host, the node must have that name. Processes that are `known`
/// keep their numbers, even if nothing is placed there any more.
Placement place(const ArchitectureDescription& architecture,
                const std::map<std::string, Endpoint>& nodes, Placement known = {});

/// The name of this machine.
std::string name_of_machine();

/// Hosts that are not this machine, with the names that HOSTNAME lines give them, otherwise their
/// own.
std::map<std::string, std::string> other_hosts(const ArchitectureDescription& architecture);

/// The host that a user means: the name of a HOSTNAME line, or an address or HOST as the file has
/// it. Throws std::invalid_argument, with the hosts of the file, if it has no such host.
std::string host_called(const ArchitectureDescription& architecture, const std::string& name);

/// Assigns the hosts node1, node2 and so on to all component lines in turn, regardless of the file.
void spread(ArchitectureDescription& architecture, int nodes);

} // namespace castor
