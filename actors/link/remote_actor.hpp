#pragma once

#include "castor/actors/link/link_port.hpp"

#include <caf/actor_proxy.hpp>

#include <atomic>
#include <memory>
#include <typeinfo>
#include <utility>

namespace castor {

/// Represents an actor of another process: messages to it go over the link, on the sender's thread.
class RemoteActor final : public caf::actor_proxy {
public:
  RemoteActor(caf::actor_config& config, std::shared_ptr<LinkPort> port, ActorName actor)
    : actor_proxy(config), port_(std::move(port)), actor_(actor) {}

  const char* name() const override { return "remote_actor"; }

  ActorName actor() const { return actor_; }

  void enqueue(caf::mailbox_element_ptr x, caf::execution_unit* context) override;

  /// The actor has ended, or is lost.
  void kill_proxy(caf::execution_unit* context, caf::error reason) override;

private:
  const std::shared_ptr<LinkPort> port_;
  const ActorName actor_;
  std::atomic<bool> ended_{false};
};

/// The actor as one of another process; null if it is none. (A dynamic_cast through the bases of
/// typed actors takes far longer.)
inline RemoteActor* as_remote(const caf::strong_actor_ptr& x) {
  auto& actor = *x->get();
  return typeid(actor) == typeid(RemoteActor) ? static_cast<RemoteActor*>(&actor) : nullptr;
}

/// Ends the representative of an actor that has ended, or is lost.
inline void end_remote(const caf::strong_actor_ptr& representative, caf::error reason) {
  static_cast<RemoteActor*>(representative->get())->kill_proxy(nullptr, std::move(reason));
}

} // namespace castor
