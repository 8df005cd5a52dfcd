#include "castor/actors/runtime/mailbox.hpp"

#include <caf/atom.hpp>

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

namespace castor {

namespace {

/// Message of the clock to an actor that it wakes.
using WokenAtom = caf::atom_constant<caf::atom("woken")>;

/// After all others.
constexpr auto last_order = std::numeric_limits<std::uint64_t>::max();

} // namespace

PumpedActor::PumpedActor(caf::actor_config& config, std::shared_ptr<SimulatedClock> clock,
                         std::uint64_t order, ActorThread thread)
  : blocking_actor(config), clock_(std::move(clock)), order_(order), thread_(thread) {
  if (holds_token())
    turn_ = clock_->activity().begin();
}

// -- waiting

bool PumpedActor::pump(Clock::time_point until, Expected expected) {
  if (mailbox().empty() && !comes_early(until, expected) && !park(until))
    return false;
  file_arrived();
  return true;
}

bool PumpedActor::pump_until(Timestamp until) {
  if (mailbox().empty()) {
    if (clock_->now() >= until)
      return false;
    std::optional<SimulatedClock::Key> key;
    if (until < Timestamp::max())
      key = wake_at(until, order_);
    park(Clock::time_point::max());
    if (key)
      clock_->forget(*key);
  }
  file_arrived();
  return true;
}

bool PumpedActor::pump_until_quiet(Clock::time_point until) {
  was_woken_ = false;
  if (mailbox().empty()) {
    auto key = wake_at(clock_->now(), last_order);
    park(until);
    clock_->forget(key);
  }
  file_arrived();
  return was_woken_;
}

SimulatedClock::Key PumpedActor::wake_at(Timestamp time, std::uint64_t order) {
  return clock_->wake_at(time, order, [self = caf::strong_actor_ptr{ctrl()}] {
    self->enqueue(nullptr, caf::make_message_id(), wake_up_call(), nullptr);
  });
}

caf::message PumpedActor::wake_up_call() {
  return caf::make_message(WokenAtom::value);
}

bool PumpedActor::comes_early(Clock::time_point until, Expected expected) {
  if (clock_)
    return false;
  switch (expected) {
    case Expected::soon:
      return comes_soon(until);
    case Expected::in_turn:
      return comes_in_turn(until);
    case Expected::later:
      break;
  }
  return false;
}

bool PumpedActor::comes_soon(Clock::time_point until) {
  // Longer than most answers take, and shorter than it takes to sleep and to be woken.
  constexpr std::chrono::microseconds worth_waiting{5};
  for (auto end = std::min(until, Clock::now() + worth_waiting); Clock::now() < end;) {
    std::this_thread::yield();
    if (!mailbox().empty())
      return true;
  }
  return false;
}

bool PumpedActor::comes_in_turn(Clock::time_point until) {
  // About two turns of others.
  constexpr std::chrono::microseconds worth_waiting{10};
  // The processor was given to others who do not wait for the same: a machine with too much to do,
  // where who sleeps is served earlier than who has just yielded.
  constexpr std::chrono::microseconds too_long{50};
  constexpr std::chrono::milliseconds pause{200};
  static std::atomic<bool> is_one_awake{false};
  static std::atomic<Clock::time_point> paused_until{Clock::time_point::min()};
  auto now = Clock::now();
  if (now < paused_until.load(std::memory_order_relaxed) || is_one_awake.exchange(true))
    return false;
  bool has_arrived = false;
  for (auto end = std::min(until, now + worth_waiting); !has_arrived && now < end;) {
    std::this_thread::yield();
    has_arrived = !mailbox().empty();
    auto before = std::exchange(now, Clock::now());
    if (now - before > too_long)
      paused_until.store(now + pause, std::memory_order_relaxed);
  }
  is_one_awake = false;
  return has_arrived;
}

bool PumpedActor::await_arrival(Clock::time_point until) {
  if (!mailbox().try_block())
    return true;
  // Something may still arrive at the last moment.
  return arrival_->wait_while([this] { return mailbox().blocked(); }, until) ||
         !mailbox().try_unblock();
}

// -- activity

void PumpedActor::begin_activity() {
  if (clock_)
    clock_->activity().await(turn_);
}

bool PumpedActor::park(Clock::time_point until) {
  if (!clock_)
    return await_arrival(until);
  Activity::Turn turn = 0;
  {
    std::lock_guard guard{parking_mutex_};
    if (!mailbox().empty())
      return true;
    parked_ = true;
    turn = std::exchange(turn_, 0);
  }
  clock_->activity().end(turn);
  auto has_arrived = await_arrival(until);
  {
    // Whoever has sent something has taken a token, too, once the mutex is free.
    std::lock_guard guard{parking_mutex_};
    if (std::exchange(parked_, false))
      turn_ = clock_->activity().begin();
    turn = turn_;
  }
  clock_->activity().await(turn);
  return has_arrived || !mailbox().empty();
}

void PumpedActor::enqueue(caf::mailbox_element_ptr x, caf::execution_unit* context) {
  if (!holds_token())
    return deposit(std::move(x), context);
  {
    std::lock_guard guard{parking_mutex_};
    if (!closed_) {
      deposit(std::move(x), context);
      if (std::exchange(parked_, false))
        turn_ = clock_->activity().begin();
      return;
    }
  }
  // A closed mailbox answers requests, which must not happen under the mutex: who has asked may be
  // just closing, too.
  deposit(std::move(x), context);
}

void PumpedActor::deposit(caf::mailbox_element_ptr x, caf::execution_unit* context) {
  auto id = x->mid;
  auto asker = id.is_request() ? x->sender : nullptr;
  switch (mailbox().push_back(std::move(x))) {
    case caf::intrusive::inbox_result::success:
      break;
    case caf::intrusive::inbox_result::unblocked_reader:
      arrived();
      break;
    case caf::intrusive::inbox_result::queue_closed:
      // CAF answers requests to an actor that has ended.
      if (asker)
        blocking_actor::enqueue(caf::make_mailbox_element(std::move(asker), id, {}, caf::message{}),
                                context);
      break;
  }
}

bool PumpedActor::cleanup(caf::error&& reason, caf::execution_unit* host) {
  if (!holds_token())
    return blocking_actor::cleanup(std::move(reason), host);
  Activity::Turn turn = 0;
  {
    std::lock_guard guard{parking_mutex_};
    closed_ = true;
    turn = std::exchange(turn_, 0);
  }
  // Sends the news of the end, under the token.
  auto result = blocking_actor::cleanup(std::move(reason), host);
  if (turn != 0)
    clock_->activity().end(turn);
  return result;
}

// -- what arrives

void PumpedActor::file_arrived() {
  constexpr int at_most = 256;
  for (int i = 0; i < at_most && !mailbox().empty(); ++i) {
    auto x = dequeue();
    if ((clock_ || shares_threads()) && x->content().match_elements<WokenAtom>()) {
      was_woken_ = true;
    } else if (!x->mid.is_response()) {
      file(std::move(x));
    } else if (auto i_slot = slots_.find(x->mid.integer_value()); i_slot != slots_.end()) {
      i_slot->second = std::move(x);
      if (!slot_observers_.empty())
        if (auto observer = slot_observers_.extract(i_slot->first))
          observer.mapped()();
    } else if (auto receiver = receivers_.extract(x->mid.integer_value())) {
      receiver.mapped()(*x);
    }
  }
}

void PumpedActor::close_slot(std::uint64_t id) {
  slots_.erase(id);
  slot_observers_.erase(id);
}

void PumpedActor::on_filled(std::uint64_t id, std::function<void()> f) {
  if (slot(id))
    f();
  else
    slot_observers_[id] = std::move(f);
}

void PumpedActor::respond(const caf::strong_actor_ptr& to, caf::message_id request,
                          caf::message reply) {
  if (request.is_request() && to)
    to->enqueue(ctrl(), request.response_id(), std::move(reply), context());
}

} // namespace castor
