#pragma once

#include "castor/base/caf.hpp"

#include <caf/blocking_actor.hpp>
#include <caf/mailbox_element.hpp>
#include <caf/message.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>
#include <utility>

namespace castor {

/// A detached actor whose single mailbox is pumped by hand.
///
/// Whatever its thread waits for, it takes every message that arrived out of CAF's mailbox and
/// files it: replies into the slots of their requests, work into a queue, stop and loss into flags.
/// So an operation inside a callback works, a stop is seen inside every operation, deadlines hold
/// under a flood of events, and filing costs the same however long the queue is.
class PumpedActor : public caf::blocking_actor {
public:
  using Clock = std::chrono::steady_clock;

  explicit PumpedActor(caf::actor_config& config) : blocking_actor(config) {}

  /// Files what has arrived; if nothing has, waits for it. False once `until` has passed without
  /// any.
  bool pump(Clock::time_point until);

  /// Files what has arrived. Bounded, so that a sender faster than this loop cannot block the
  /// caller.
  void file_arrived();

  /// A reply under way; empty until it has arrived.
  using Slot = caf::mailbox_element_ptr;

  /// Expects the reply to request `id`. The slot stays until `close_slot`.
  void open_slot(std::uint64_t id) { slots_.emplace(id, nullptr); }
  Slot& slot(std::uint64_t id) { return slots_.at(id); }
  void close_slot(std::uint64_t id) { slots_.erase(id); }

  /// Calls `f` with the reply to request `id` when it is filed, whatever the thread waits for; so
  /// `f` must not run the component's own code.
  void on_reply(std::uint64_t id, std::function<void(caf::mailbox_element&)> f) {
    receivers_.emplace(id, std::move(f));
  }

  /// Answers the message if it is a request.
  void respond(caf::mailbox_element& x, caf::message reply) {
    respond(x.sender, x.mid, std::move(reply));
  }
  void respond(const caf::strong_actor_ptr& to, caf::message_id request, caf::message reply);

protected:
  /// Files a message that is not a reply.
  virtual void file(caf::mailbox_element_ptr x) = 0;

private:
  std::unordered_map<std::uint64_t, Slot> slots_;
  std::unordered_map<std::uint64_t, std::function<void(caf::mailbox_element&)>> receivers_;
};

} // namespace castor
