#pragma once

#include "castor/actors/link/credentials.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/actors/link/link.hpp"
#include "castor/actors/link/mesh.hpp"
#include "castor/actors/node/part.hpp"
#include "castor/actors/node/part_protocol.hpp"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace castor {

/// A node has joined or left a system.
struct MembershipNews {
  std::string system;
  bool takes_part = false;
  /// The node of the system's coordinator, if it takes part.
  std::string coordinator;
  /// Why the node has left.
  std::string reason;
};

struct MembershipParts {
  /// Of the node.
  std::string name;
  std::optional<Credentials> credentials;
  /// Without credentials, connect also with nodes that may be another user's.
  bool insecure = false;
  LinkOptions link;
  LinkSpawn spawn_link;
  PartSpawn spawn;
  /// Called by the network's thread and by agents, one at a time; may be empty.
  std::function<void(const MembershipNews&)> on_news = {};
};

/// Of two nodes, whether `self` dials: the one with the lower number does, unless only one of them
/// listens at a Unix socket, which others may not be able to reach.
bool dials(const PartPlan& plan, ProcessNumber self, ProcessNumber peer);

/// The systems that a node takes part in; used by the network's thread and by agents.
class Memberships : public std::enable_shared_from_this<Memberships> {
public:
  Memberships(caf::actor_system& system, MembershipParts parts)
    : system_(system), parts_(std::move(parts)) {}

  /// The link that a new connection is for. The coordinator's first one makes the node join.
  std::variant<caf::actor, Refusal> route(const Hello& x);

  std::vector<std::string> systems() const;

  /// Leaves all systems, and joins no other; returns the links that end.
  std::vector<caf::actor> end();

private:
  /// What this process contributes to one system.
  struct Membership {
    Hello self;
    std::shared_ptr<Mesh> mesh;
    caf::actor agent;
    std::map<ProcessNumber, caf::actor> links;
  };

  /// Whether the coordinator has given up this process's membership, and addresses the process as a
  /// new one.
  bool is_given_up(const Hello& coordinator) const;
  Membership& enter(const Hello& coordinator);
  /// Makes the links of the plan, unless the node has left that incarnation of the system.
  void connect(const std::string& system, std::uint64_t incarnation, const PartPlan& plan);
  void add_link(Membership& membership, ProcessNumber peer, const std::string& name,
                std::optional<Endpoint> dial);
  /// Leaves the system if it is in that incarnation, or in any; returns the links that end.
  std::vector<caf::actor> leave(const std::string& system, const std::string& why,
                                std::optional<std::uint64_t> incarnation = {});
  void report(const MembershipNews& x);

  caf::actor_system& system_;
  const MembershipParts parts_;
  mutable std::mutex mutex_;
  bool has_ended_ = false;
  std::mutex news_mutex_;
  std::map<std::string, Membership> memberships_;
};

} // namespace castor
