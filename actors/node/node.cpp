#include "castor/actors/node/node.hpp"

#include "castor/actors/link/listener.hpp"
#include "castor/actors/link/local_socket.hpp"
#include "castor/actors/link/node_socket.hpp"
#include "castor/actors/node/actor_system_config.hpp"
#include "castor/actors/node/memberships.hpp"

#include <unistd.h>

#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

namespace castor {

namespace {

/// To those who come by TCP, while nobody proves who is who.
Refusal only_own_user() {
  return {"it takes systems of " + user_called(geteuid()) +
            " alone, who started it; for those of others and of other machines it needs --tls DIR "
            "(scripts/make-certs makes certificates), as does `castor run`, or both need "
            "--insecure",
          true};
}

} // namespace

class Node::Implementation {
public:
  explicit Implementation(const NodeOptions& options)
    : memberships_(std::make_shared<Memberships>(system_, MembershipParts{options.name,
                                                                          options.credentials,
                                                                          options.insecure,
                                                                          options.link,
                                                                          spawn_link,
                                                                          {},
                                                                          options.on_system})) {
    auto take = [memberships = memberships_](const Hello& x) { return memberships->route(x); };
    auto refuse = [](const Hello&) { return only_own_user(); };
    if (auto path = local_address(options.socket)) {
      file_ = *path;
      listen(options.socket, take, {});
    } else if (options.credentials) {
      listen(options.socket, take, options.credentials);
    } else {
      auto beside = listen_beside(options.socket);
      file_ = beside.file;
      listen(beside.socket, take, {});
      if (options.insecure)
        listen(options.socket, take, {});
      else
        listen(options.socket, refuse, {});
    }
  }

  ~Implementation() {
    // Nobody comes any more.
    std::error_code error;
    std::filesystem::remove(file_, error);
    for (auto& x : listeners_)
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
    auto ending = memberships_->end();
    ending.insert(ending.end(), listeners_.begin(), listeners_.end());
    await_ends(system_, ending);
  }

  std::vector<std::string> systems() const { return memberships_->systems(); }

private:
  void listen(int socket, decltype(ListenerParts::route) route,
              const std::optional<Credentials>& credentials) {
    ListenerParts parts;
    parts.socket = socket;
    parts.route = std::move(route);
    parts.credentials = credentials;
    listeners_.push_back(spawn_listener(system_, std::move(parts)));
  }

  /// Whether the clock of a system is simulated, its plan will say.
  ActorSystemConfig config_{true, std::make_shared<Activity>()};
  caf::actor_system system_{config_};
  std::shared_ptr<Memberships> memberships_;
  std::vector<caf::actor> listeners_;
  /// Of the Unix socket that goes with the node; may be empty.
  std::filesystem::path file_;
};

Node::Node(const NodeOptions& options)
  : implementation_(std::make_unique<Implementation>(options)) {}

Node::~Node() = default;

std::vector<std::string> Node::systems() const {
  return implementation_->systems();
}

} // namespace castor
