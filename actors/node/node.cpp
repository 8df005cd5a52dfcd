#include "castor/actors/node/node.hpp"

#include "castor/actors/component/log.hpp"
#include "castor/actors/link/listener.hpp"
#include "castor/actors/node/actor_system_config.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/messages.hpp"
#include "castor/actors/node/part_agent.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>
#include <variant>

namespace castor {

namespace {

/// What this process contributes to one system.
struct Membership {
  Hello self;
  std::shared_ptr<Mesh> mesh;
  caf::actor agent;
  LinkOptions link;
  std::map<ProcessNumber, caf::actor> links;
};

using Route = std::variant<caf::actor, Refusal>;

/// The systems that a node takes part in; used by the network's thread and by agents.
class Memberships : public std::enable_shared_from_this<Memberships> {
public:
  Memberships(caf::actor_system& system, const NodeOptions& options)
    : system_(system), name_(options.name), credentials_(options.credentials), link_(options.link) {
  }

  /// Leaves all systems; the links that end thereby.
  std::vector<caf::actor> end() {
    std::vector<caf::actor> result;
    for (auto& name : systems())
      for (auto& link : leave(name, name_ + " ends"))
        result.push_back(link);
    return result;
  }

  std::vector<std::string> systems() const {
    std::lock_guard guard{mutex_};
    std::vector<std::string> result;
    for (auto& [name, membership] : memberships_)
      result.push_back(name);
    return result;
  }

  /// The link that a new connection is for.
  Route route(const Hello& x) {
    std::lock_guard guard{mutex_};
    auto i = memberships_.find(x.system);
    if (i == memberships_.end()) {
      if (x.known != 0)
        return Refusal{"it was started again and takes no part in the system any more", true};
      if (x.process != 0)
        return Refusal{"it does not take part in the system yet", false};
      i = enter(x);
    }
    auto& links = i->second.links;
    auto link = links.find(x.process);
    if (link == links.end())
      return Refusal{"it has not heard of a process " + std::to_string(x.process) + " yet", false};
    return link->second;
  }

private:
  std::map<std::string, Membership>::iterator enter(const Hello& coordinator) {
    note(LogLevel::info,
         name_ + " takes part in " + coordinator.system + ", for " + coordinator.node);
    auto& result = memberships_[coordinator.system];
    result.self.node = name_;
    result.self.system = coordinator.system;
    result.self.incarnation = new_incarnation();
    result.self.process = coordinator.receiver;
    result.link = link_;
    result.mesh = std::make_shared<Mesh>(system_, system_messages(), coordinator.receiver);
    PartAgentParts parts;
    parts.self = coordinator.receiver;
    parts.mesh = result.mesh;
    parts.connect = [node = weak_from_this(), name = coordinator.system](const PartPlan& plan) {
      if (auto self = node.lock())
        self->connect(name, plan);
    };
    result.agent = system_.spawn(part_agent, std::move(parts));
    result.mesh->set_well_known(WellKnownActor::agent,
                                caf::actor_cast<caf::strong_actor_ptr>(result.agent));
    add_link(result, 0, coordinator.node, std::nullopt);
    return memberships_.find(coordinator.system);
  }

  /// Of each two processes, the one with the lower number dials.
  void connect(const std::string& system, const PartPlan& plan) {
    std::lock_guard guard{mutex_};
    auto i = memberships_.find(system);
    if (i == memberships_.end())
      return;
    i->second.link.patience = plan.patience;
    caf::anon_send(i->second.links.at(0), LinkPatience{plan.patience});
    for (std::size_t p = 1; p < plan.processes.size(); ++p) {
      auto number = static_cast<ProcessNumber>(p);
      auto& peer = plan.processes[p];
      auto link = i->second.links.find(number);
      if (peer.lost && link != i->second.links.end()) {
        // The coordinator knows it before this process has tried for long enough.
        caf::anon_send(link->second, CloseLink{"it is lost"});
        continue;
      }
      if (number == i->second.self.process || peer.lost || link != i->second.links.end())
        continue;
      add_link(i->second, number, peer.name,
               number > i->second.self.process ? std::optional{Endpoint{peer.host, peer.port}}
                                               : std::nullopt);
    }
  }

  void add_link(Membership& membership, ProcessNumber peer, const std::string& name,
                std::optional<Endpoint> dial) {
    LinkParts parts;
    parts.mesh = membership.mesh;
    parts.peer = peer;
    parts.peer_name = name;
    parts.dial = std::move(dial);
    parts.self = membership.self;
    parts.credentials = credentials_;
    parts.options = membership.link;
    parts.on_news = [node = weak_from_this(), agent = membership.agent,
                     system = membership.self.system](const LinkNews& x) {
      caf::anon_send(agent, x);
      auto self = node.lock();
      if (self && x.peer == 0 && x.state == LinkState::lost)
        self->leave(system, x.reason);
    };
    membership.links[peer] = spawn_link(std::move(parts));
  }

  std::vector<caf::actor> leave(const std::string& system, const std::string& why) {
    std::map<std::string, Membership>::node_type left;
    {
      std::lock_guard guard{mutex_};
      left = memberships_.extract(system);
    }
    std::vector<caf::actor> links;
    if (!left)
      return links;
    note(LogLevel::info, name_ + " leaves " + system + ": " + why);
    auto& membership = left.mapped();
    caf::anon_send_exit(membership.agent, caf::exit_reason::user_shutdown);
    for (auto& [peer, link] : membership.links) {
      caf::anon_send(link, CloseLink{why});
      links.push_back(link);
    }
    membership.mesh->close();
    return links;
  }

  caf::actor_system& system_;
  const std::string name_;
  const std::optional<Credentials> credentials_;
  const LinkOptions link_;
  mutable std::mutex mutex_;
  std::map<std::string, Membership> memberships_;
};

} // namespace

class Node::Implementation {
public:
  explicit Implementation(const NodeOptions& options)
    : memberships_(std::make_shared<Memberships>(system_, options)) {
    ListenerParts parts;
    parts.socket = options.socket;
    parts.route = [memberships = memberships_](const Hello& x) { return memberships->route(x); };
    parts.credentials = options.credentials;
    listener_ = spawn_listener(system_, std::move(parts));
  }

  ~Implementation() {
    caf::anon_send_exit(listener_, caf::exit_reason::user_shutdown);
    auto ending = memberships_->end();
    ending.push_back(listener_);
    await_ends(system_, ending);
  }

  std::vector<std::string> systems() const { return memberships_->systems(); }

private:
  ActorSystemConfig config_{true};
  caf::actor_system system_{config_};
  std::shared_ptr<Memberships> memberships_;
  caf::actor listener_;
};

Node::Node(const NodeOptions& options)
  : implementation_(std::make_unique<Implementation>(options)) {}

Node::~Node() = default;

std::vector<std::string> Node::systems() const {
  return implementation_->systems();
}

} // namespace castor
