#include "castor/actors/node/node.hpp"

#include "castor/actors/link/listener.hpp"
#include "castor/actors/node/actor_system_config.hpp"
#include "castor/actors/node/memberships.hpp"

#include <memory>
#include <utility>

namespace castor {

class Node::Implementation {
public:
  explicit Implementation(const NodeOptions& options)
    : memberships_(std::make_shared<Memberships>(
        system_,
        MembershipParts{
          options.name, options.credentials, options.link, spawn_link, {}, options.on_system})) {
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
