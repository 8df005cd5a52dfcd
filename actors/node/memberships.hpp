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

/// A node takes part in a system, or does not any more.
struct MembershipNews {
  std::string system;
  bool takes_part = false;
  /// The node of the system's coordinator, if it takes part.
  std::string coordinator;
  /// Why it does not any more.
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

  /// The link that a new connection is for. The coordinator's first makes the node take part.
  std::variant<caf::actor, Refusal> route(const Hello& x);

  std::vector<std::string> systems() const;

  /// Leaves all systems, and enters no other; the links that end thereby.
  std::vector<caf::actor> end();

private:
  /// What this process contributes to one system.
  struct Membership {
    Hello self;
    std::shared_ptr<Mesh> mesh;
    caf::actor agent;
    std::map<ProcessNumber, caf::actor> links;
  };

  /// Whether the coordinator takes this process for a new one.
  bool is_given_up(const Hello& coordinator) const;
  Membership& enter(const Hello& coordinator);
  /// Unless the node has left the system since it took part in that incarnation.
  void connect(const std::string& system, std::uint64_t incarnation, const PartPlan& plan);
  void add_link(Membership& membership, ProcessNumber peer, const std::string& name,
                std::optional<Endpoint> dial);
  /// In that incarnation, or in any.
  std::vector<caf::actor> leave(const std::string& system, const std::string& why,
                                std::optional<std::uint64_t> incarnation = {});
  void tell(const MembershipNews& x);

  caf::actor_system& system_;
  const MembershipParts parts_;
  mutable std::mutex mutex_;
  bool has_ended_ = false;
  std::mutex telling_;
  std::map<std::string, Membership> memberships_;
};

} // namespace castor
