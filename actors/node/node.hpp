#pragma once

#include "castor/wm/caf.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace castor {

struct NodeOptions {
  /// By which systems know it.
  std::string name;
  /// Listens already (`listen_at`); belongs to the node from now on.
  int socket = -1;
};

/// A process that makes its part of every system whose coordinator asks it to. Systems on the same
/// node know nothing of each other.
class Node {
public:
  explicit Node(NodeOptions options);
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
