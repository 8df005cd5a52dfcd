#pragma once

#include "castor/base/caf.hpp"
#include "castor/base/doorbell.hpp"
#include "castor/wm/clock/simulated_clock.hpp"

#include <caf/blocking_actor.hpp>
#include <caf/mailbox_element.hpp>
#include <caf/message.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace castor {

/// Where a pumped actor runs: on a thread of its own, which may wait, or on threads that it shares
/// with others, a turn at a time.
enum class ActorThread : std::uint8_t { own, shared };

/// An actor whose single mailbox is pumped by hand.
///
/// Whatever its thread waits for, it takes every message that arrived out of CAF's mailbox and
/// files it: replies into the slots of their requests, work into a queue, stop and loss into flags.
/// So an operation inside a callback works, a stop is seen inside every operation, deadlines hold
/// under a flood of events, and filing costs the same however long the queue is.
///
/// With a simulated clock, one on its own thread holds a token of the process's activity, except
/// while it is parked: its thread waits, and its mailbox is empty. Whoever sends to it then takes a
/// token for it. For those on shared threads, ComponentPool holds one.
class PumpedActor : public caf::blocking_actor {
public:
  using Clock = std::chrono::steady_clock;

  /// `clock` is null if the clock is the real one. Of those that are woken at one time, the one of
  /// lower `order` is woken first.
  PumpedActor(caf::actor_config& config, std::shared_ptr<SimulatedClock> clock, std::uint64_t order,
              ActorThread thread = ActorThread::own);

  using blocking_actor::enqueue;
  void enqueue(caf::mailbox_element_ptr x, caf::execution_unit* context) override;

  /// When something may be expected to arrive. What comes soon is not worth sleeping for; what
  /// comes in turn, after others that wait for the same, only to one of them at a time.
  enum class Expected : std::uint8_t { soon, in_turn, later };

  /// Files what has arrived; if nothing has, waits for it. False once `until`, which is real time,
  /// has passed without any.
  bool pump(Clock::time_point until, Expected expected = Expected::later);

  /// The same until a simulated time; for ever if it is `Timestamp::max()`. Only with a simulated
  /// clock.
  bool pump_until(Timestamp until);

  /// Files what has arrived; if nothing has, waits for it until `until`, which is real time, or
  /// until nobody else in the process has anything to do. Returns whether the latter is the case.
  /// Only with a simulated clock.
  bool pump_until_quiet(Clock::time_point until);

  /// Null if the clock is the real one.
  SimulatedClock* simulated_clock() const { return clock_.get(); }

  /// Whether it must not wait, since others wait for its thread.
  bool shares_threads() const { return thread_ == ActorThread::shared; }

  /// Files what has arrived. Bounded, so that a sender faster than this loop cannot block the
  /// caller.
  void file_arrived();

  /// A reply under way; empty until it has arrived.
  using Slot = caf::mailbox_element_ptr;

  /// Expects the reply to request `id`. The slot stays until `close_slot`.
  void open_slot(std::uint64_t id) { slots_.emplace(id, nullptr); }
  Slot& slot(std::uint64_t id) { return slots_.at(id); }
  void close_slot(std::uint64_t id);

  /// Calls `f` once the slot has its reply, at once if that was filed already; like the function of
  /// `on_reply`, it must not run the component's own code.
  void on_filled(std::uint64_t id, std::function<void()> f);

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
  /// To be called by the actor's thread before anything else.
  void begin_activity();

  /// Files a message that is not a reply.
  virtual void file(caf::mailbox_element_ptr x) = 0;

  /// Something has arrived while nobody pumped; called by who has sent it.
  virtual void arrived() { Doorbell::ring(arrival_); }

  /// Has the clock wake this actor at a simulated time: only its mailbox is pumped then.
  SimulatedClock::Key wake_at(Timestamp time) { return wake_at(time, order_); }
  /// A message that wakes this actor and says nothing else.
  static caf::message wake_up_call();

  bool cleanup(caf::error&& reason, caf::execution_unit* host) override;

private:
  /// Puts it into CAF's mailbox; wakes the thread if it waits.
  void deposit(caf::mailbox_element_ptr x, caf::execution_unit* context);
  /// Waits until something has arrived; false once `until` has passed without any.
  bool park(Clock::time_point until);
  bool await_arrival(Clock::time_point until);
  /// Whether something arrives within microseconds, for which the thread stays awake.
  bool comes_early(Clock::time_point until, Expected expected);
  bool comes_soon(Clock::time_point until);
  bool comes_in_turn(Clock::time_point until);
  SimulatedClock::Key wake_at(Timestamp time, std::uint64_t order);

  /// Whether it is its own business to hold a token.
  bool holds_token() const { return clock_ && !shares_threads(); }

  const std::shared_ptr<SimulatedClock> clock_;
  const std::uint64_t order_;
  const ActorThread thread_;
  const std::shared_ptr<Doorbell> arrival_ = std::make_shared<Doorbell>();
  /// The clock has woken this actor since this was reset.
  bool was_woken_ = false;
  /// Of the following three, which are used only with a simulated clock.
  std::mutex parking_mutex_;
  bool parked_ = false;
  bool closed_ = false;
  /// Of the token that the actor holds; 0 if it holds none.
  Activity::Turn turn_ = 0;

  std::unordered_map<std::uint64_t, Slot> slots_;
  std::unordered_map<std::uint64_t, std::function<void()>> slot_observers_;
  std::unordered_map<std::uint64_t, std::function<void(caf::mailbox_element&)>> receivers_;
};

} // namespace castor
