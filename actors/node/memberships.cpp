#include "castor/actors/node/memberships.hpp"

#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/messages.hpp"
#include "castor/actors/node/part_agent.hpp"
#include "castor/actors/node/part_messages.hpp"
#include "castor/actors/node/well_known_actors.hpp"
#include "castor/base/log.hpp"

#include <chrono>
#include <utility>

namespace castor {

std::vector<caf::actor> Memberships::end() {
  {
    std::lock_guard guard{mutex_};
    has_ended_ = true;
  }
  std::vector<caf::actor> result;
  for (auto& name : systems())
    for (auto& link : leave(name, parts_.name + " ends"))
      result.push_back(link);
  return result;
}

std::vector<std::string> Memberships::systems() const {
  std::lock_guard guard{mutex_};
  std::vector<std::string> result;
  for (auto& [name, membership] : memberships_)
    result.push_back(name);
  return result;
}

std::variant<caf::actor, Refusal> Memberships::route(const Hello& x) {
  if (is_given_up(x))
    leave(x.system, "the coordinator has given it up");
  std::lock_guard guard{mutex_};
  auto i = memberships_.find(x.system);
  if (i == memberships_.end()) {
    if (has_ended_)
      return Refusal{"it ends", false};
    if (x.known != 0)
      return Refusal{"it was started again and takes no part in the system any more", true};
    if (x.process != 0)
      return Refusal{"it does not take part in the system yet", false};
  }
  auto& membership = i == memberships_.end() ? enter(x) : i->second;
  // A link to what ran here before has nothing to do with the one that there is now.
  auto& self = membership.self;
  if ((x.known != 0 && x.known != self.incarnation) || x.receiver < self.process)
    return Refusal{"it was started again", true};
  if (x.receiver > self.process)
    return Refusal{"it does not take part in the system again yet", false};
  auto link = membership.links.find(x.process);
  if (link == membership.links.end())
    return Refusal{"it does not know a process " + std::to_string(x.process) + " yet", false};
  return link->second;
}

bool Memberships::is_given_up(const Hello& coordinator) const {
  std::lock_guard guard{mutex_};
  auto i = memberships_.find(coordinator.system);
  return coordinator.process == 0 && coordinator.known == 0 && i != memberships_.end() &&
         coordinator.receiver > i->second.self.process;
}

Memberships::Membership& Memberships::enter(const Hello& coordinator) {
  log_repeated(LogLevel::info,
               parts_.name + " takes part in " + coordinator.system + ", for " + coordinator.node);
  report({coordinator.system, true, coordinator.node, {}});
  auto& result = memberships_[coordinator.system];
  result.self.node = parts_.name;
  result.self.system = coordinator.system;
  result.self.incarnation = new_incarnation();
  result.self.process = coordinator.receiver;
  auto messages = std::make_shared<PartMessages>(system_messages());
  result.mesh = std::make_shared<Mesh>(system_, messages, coordinator.receiver);
  PartAgentParts parts;
  parts.self = coordinator.receiver;
  parts.mesh = result.mesh;
  parts.messages = std::move(messages);
  parts.spawn = parts_.spawn;
  parts.connect = [node = weak_from_this(), name = coordinator.system,
                   incarnation = result.self.incarnation](const PartPlan& plan) {
    if (auto self = node.lock())
      self->connect(name, incarnation, plan);
  };
  result.agent = system_.spawn(part_agent, std::move(parts));
  result.mesh->set_well_known(part_agent_number,
                              caf::actor_cast<caf::strong_actor_ptr>(result.agent));
  add_link(result, 0, coordinator.node, std::nullopt);
  return result;
}

bool dials(const PartPlan& plan, ProcessNumber self, ProcessNumber peer) {
  bool self_is_local = is_socket_path(plan.processes.at(self).host);
  bool peer_is_local = is_socket_path(plan.processes.at(peer).host);
  return self_is_local != peer_is_local ? self_is_local : self < peer;
}

void Memberships::connect(const std::string& system, std::uint64_t incarnation,
                          const PartPlan& plan) {
  std::lock_guard guard{mutex_};
  auto i = memberships_.find(system);
  if (i == memberships_.end() || i->second.self.incarnation != incarnation)
    return;
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
             dials(plan, i->second.self.process, number)
               ? std::optional{Endpoint{peer.host, peer.port}}
               : std::nullopt);
  }
}

void Memberships::add_link(Membership& membership, ProcessNumber peer, const std::string& name,
                           std::optional<Endpoint> dial) {
  LinkParts parts;
  parts.mesh = membership.mesh;
  parts.peer = peer;
  parts.peer_name = name;
  parts.dial = std::move(dial);
  parts.self = membership.self;
  secure(parts, parts_.credentials, parts_.insecure);
  parts.options = parts_.link;
  // Who is lost is decided by the coordinator alone, so that all agree: with it, this process loses
  // all others, and of those it hears.
  if (peer != 0)
    parts.options.patience = std::chrono::hours{24 * 365};
  parts.on_news = [node = weak_from_this(), agent = membership.agent,
                   system = membership.self.system,
                   incarnation = membership.self.incarnation](const LinkNews& x) {
    caf::anon_send(agent, x);
    auto self = node.lock();
    if (self && x.peer == 0 && x.state == LinkState::lost)
      self->leave(system, x.reason, incarnation);
  };
  membership.links[peer] = parts_.spawn_link(std::move(parts));
}

void Memberships::report(const MembershipNews& x) {
  std::lock_guard guard{news_mutex_};
  if (parts_.on_news)
    parts_.on_news(x);
}

std::vector<caf::actor> Memberships::leave(const std::string& system, const std::string& why,
                                           std::optional<std::uint64_t> incarnation) {
  std::map<std::string, Membership>::node_type left;
  {
    std::lock_guard guard{mutex_};
    auto i = memberships_.find(system);
    if (i != memberships_.end() &&
        incarnation.value_or(i->second.self.incarnation) == i->second.self.incarnation)
      left = memberships_.extract(i);
  }
  std::vector<caf::actor> links;
  if (!left)
    return links;
  log_repeated(LogLevel::info, parts_.name + " leaves " + system + ": " + why);
  report({system, false, {}, why});
  auto& membership = left.mapped();
  caf::anon_send_exit(membership.agent, caf::exit_reason::user_shutdown);
  for (auto& [peer, link] : membership.links) {
    caf::anon_send(link, CloseLink{why});
    links.push_back(link);
  }
  membership.mesh->close();
  return links;
}

} // namespace castor
