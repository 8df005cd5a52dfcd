#pragma once

#include "castor/actors/link/credentials.hpp"
#include "castor/actors/link/link.hpp"
#include "castor/actors/node/memberships.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor {

struct NodeOptions {
  /// Name by which systems know the node.
  std::string name;
  /// Listens already (`listen_at`); belongs to the node from now on.
  int socket = -1;
  /// With credentials, TCP peers must have certificates that are signed by the same CA.
  std::optional<Credentials> credentials = {};
  /// Accepts everybody who can connect. Otherwise a node without credentials accepts systems of its
  /// own user only, over a Unix socket, and refuses TCP connections with that reason.
  bool insecure = false;
  /// Options of links to other processes; `patience` is set by the coordinator.
  LinkOptions link = {};
  /// Called when it takes part in a system, and when it does not any more; by any thread, one at a
  /// time. May be empty.
  std::function<void(const MembershipNews&)> on_system = {};
};

/// A process that makes its part of every system whose coordinator asks it to. Systems on the same
/// node know nothing of each other.
class Node {
public:
  /// Throws std::runtime_error if systems of its own user could not find it.
  explicit Node(const NodeOptions& options);
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  /// Leaves all systems.
  ~Node();

  /// The systems that it takes part in now.
  std::vector<std::string> systems() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace castor
