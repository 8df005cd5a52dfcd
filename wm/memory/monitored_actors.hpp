#pragma once

#include "castor/wm/memory/working_memory_protocol.hpp"

#include <set>

namespace castor {

/// Actors that the working memory monitors, each once.
class MonitoredActors {
public:
  explicit MonitoredActors(WorkingMemoryActor::pointer self) : self_(self) {}

  void add(const caf::strong_actor_ptr& who) {
    if (actors_.insert(caf::actor_cast<caf::actor_addr>(who)).second)
      self_->monitor(who);
  }

  /// The actor has ended.
  void remove(const caf::actor_addr& who) { actors_.erase(who); }

private:
  WorkingMemoryActor::pointer self_;
  std::set<caf::actor_addr> actors_;
};

} // namespace castor
