#include "castor/actors/runtime/component_pool.hpp"

#include "castor/actors/runtime/crash_report.hpp"
#include "castor/base/ring_batch_end.hpp"

#include <algorithm>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace castor {

PoolStaff::Limits ComponentPool::standard_limits() {
  PoolStaff::Limits result;
  result.wanted = std::max<std::size_t>(result.wanted, std::thread::hardware_concurrency());
  return result;
}

ComponentPool::ComponentPool(caf::actor_system& system, std::shared_ptr<Activity> activity,
                             PoolStaff::Limits limits)
  : system_(system), activity_(std::move(activity)), limits_(limits), staff_(limits) {}

// -- members

void ComponentPool::enter() {
  std::lock_guard guard{mutex_};
  ++members_;
  hire(staff_.missing(Clock::now()));
}

void ComponentPool::leave() {
  std::lock_guard guard{mutex_};
  if (--members_ > 0)
    return;
  work_.notify_all();
  watch_.notify_all();
}

void ComponentPool::schedule(PoolMember& x) {
  std::lock_guard guard{mutex_};
  // Under the mutex: who is earlier in the queue has the earlier turn, too.
  queue_.push_back({x.handle(), &x, activity_ ? activity_->begin() : 0});
  if (idle_ == 0)
    return watch_queue();
  // Who tells many of something wakes the threads once, when all of these are in the queue.
  auto wake_idle = [](void* pool) {
    auto& self = *static_cast<ComponentPool*>(pool);
    std::lock_guard batch_guard{self.mutex_};
    for (auto count = std::min(self.idle_, self.queue_.size()); count > 0; --count)
      self.work_.notify_one();
  };
  if (!at_end_of_ring_batch(shared_from_this(), wake_idle))
    work_.notify_one();
}

void ComponentPool::wake_at(Clock::time_point time, const caf::strong_actor_ptr& member,
                            caf::message call) {
  std::lock_guard guard{mutex_};
  alarms_.emplace(time, Alarm{caf::weak_actor_ptr{member.get()}, std::move(call)});
  watch_from(time);
}

// -- threads

void ComponentPool::start_thread(std::function<void(ComponentPool&)> f) {
  system_.inc_detached_threads();
  try {
    std::thread{[self = shared_from_this(), f = std::move(f)]() mutable {
      auto& system = self->system_;
      f(*self);
      self = nullptr;
      system.dec_detached_threads();
    }}.detach();
  } catch (const std::system_error&) {
    system_.dec_detached_threads();
    throw;
  }
}

void ComponentPool::hire(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto id = staff_.hire();
    try {
      start_thread([id](ComponentPool& self) { self.work(id); });
    } catch (const std::system_error&) {
      staff_.dismiss(id);
      if (staff_.size() == 0)
        throw;
      // Those that there are have to do; the watch tries again.
      return;
    }
  }
}

void ComponentPool::work(PoolStaff::Id self) {
  CrashWatch crashes;
  Lock lock{mutex_};
  while (members_ > 0 || !queue_.empty()) {
    if (queue_.empty()) {
      ++idle_;
      work_.wait(lock);
      --idle_;
      continue;
    }
    auto job = std::move(queue_.front());
    queue_.pop_front();
    staff_.begin_turn(self, Clock::now());
    // This turn may be the one that takes too long for them.
    if (!queue_.empty())
      watch_queue();
    lock.unlock();
    run(std::move(job));
    lock.lock();
    staff_.end_turn(self);
    if (staff_.is_enlarged() && staff_.has_surplus(Clock::now()))
      break;
  }
  staff_.dismiss(self);
}

void ComponentPool::run(Job job) {
  if (activity_)
    activity_->await(job.turn);
  job.member->run_turn();
  job.actor = nullptr;
  if (activity_)
    activity_->end(job.turn);
}

// -- watch

void ComponentPool::watch_queue() {
  if (!std::exchange(is_queue_watched_, true))
    watch_from(Clock::time_point::min());
}

void ComponentPool::watch_from(Clock::time_point time) {
  if (!std::exchange(is_watched_, true))
    start_thread([](ComponentPool& self) { self.watch(); });
  else if (time < next_look_)
    watch_.notify_one();
  next_look_ = std::min(next_look_, time);
}

void ComponentPool::watch() {
  Lock lock{mutex_};
  while (members_ > 0) {
    if (call_due(lock))
      continue;
    next_look_ = alarms_.empty() ? Clock::time_point::max() : alarms_.begin()->first;
    is_queue_watched_ = !queue_.empty();
    if (is_queue_watched_) {
      auto now = Clock::now();
      hire(staff_.missing(now));
      next_look_ = std::min(next_look_, now + limits_.patience);
    }
    if (next_look_ == Clock::time_point::max())
      watch_.wait(lock);
    else
      watch_.wait_until(lock, next_look_);
  }
  alarms_.clear();
  is_watched_ = false;
  is_queue_watched_ = false;
}

bool ComponentPool::call_due(Lock& lock) {
  std::vector<Alarm> due;
  auto end = alarms_.upper_bound(Clock::now());
  for (auto i = alarms_.begin(); i != end; ++i)
    due.push_back(std::move(i->second));
  alarms_.erase(alarms_.begin(), end);
  if (due.empty())
    return false;
  lock.unlock();
  for (auto& x : due)
    if (auto actor = x.member.lock())
      actor->enqueue(nullptr, caf::make_message_id(), std::move(x.call), nullptr);
  lock.lock();
  return true;
}

} // namespace castor
