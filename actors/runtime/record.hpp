#pragma once

#include "castor/actors/component/component_identity.hpp"
#include "castor/actors/runtime/code_activity.hpp"
#include "castor/actors/runtime/held_leases.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/values/reflect.hpp"

#include <pthread.h>
#include <time.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace castor {

enum class ComponentState : std::uint8_t {
  created,
  configured,
  started,
  running,
  stopped,
  failed,
};
CASTOR_REFLECT_ENUM(ComponentState, created, configured, started, running, stopped, failed)

/// What a component has done so far.
struct ComponentCounters {
  std::atomic<std::uint64_t> events_received{0};
  /// Events replaced by newer ones before they were delivered (`--queue newest`).
  std::atomic<std::uint64_t> events_discarded{0};
  /// Events that none of its filters matches, in a system that broadcasts.
  std::atomic<std::uint64_t> events_rejected{0};
  std::atomic<std::uint64_t> callbacks{0};
  /// Pushes that a receiver was too slow for.
  std::atomic<std::uint64_t> pushes_dropped{0};
  std::atomic<std::uint64_t> reads{0};
  std::atomic<std::uint64_t> adds{0};
  std::atomic<std::uint64_t> overwrites{0};
  std::atomic<std::uint64_t> deletes{0};
  std::atomic<std::uint64_t> tasks_proposed{0};
  std::atomic<std::uint64_t> tasks_completed{0};
};

/// State of a component, maintained by its own thread; safe to read from any thread.
class ComponentRecord {
public:
  using Clock = std::chrono::steady_clock;

  explicit ComponentRecord(ComponentIdentity identity)
    : identity_(std::move(identity)),
      client_(std::make_shared<const Client>(
        Client{identity_.name, identity_.subarchitecture, identity_.incarnation})) {}

  const ComponentIdentity& identity() const { return identity_; }

  /// The component, as working memories know it.
  const ClientPtr& client() const { return client_; }

  ComponentCounters counters;
  HeldLeases leases;
  /// What the component's own code does.
  CurrentActivity activity;

  ComponentState state() const { return state_.load(); }
  void set_state(ComponentState x) { state_.store(x); }

  /// Whether the component failed because its working memory has ended.
  bool is_orphaned() const { return orphaned_.load(); }
  void set_orphaned() { orphaned_.store(true); }

  /// Stand-alone component, or working memory of another subarchitecture, that was down, so that
  /// the component failed. Empty for other reasons.
  std::string waited_for() const {
    std::lock_guard guard{mutex_};
    return waited_for_;
  }

  void set_waited_for(std::string name) {
    std::lock_guard guard{mutex_};
    waited_for_ = std::move(name);
  }

  /// Whose commands the component obeys now; empty for nobody's.
  std::string obeyed() const {
    std::lock_guard guard{mutex_};
    return obeyed_;
  }

  void set_obeyed(std::string commanders) {
    std::lock_guard guard{mutex_};
    obeyed_ = std::move(commanders);
  }

  /// Why the component failed; empty if it did not.
  std::string failure() const {
    std::lock_guard guard{mutex_};
    return failure_;
  }

  void fail(std::string why) {
    std::lock_guard guard{mutex_};
    failure_ = std::move(why);
    state_.store(ComponentState::failed);
  }

  /// How long the component's own code may run without a pause.
  std::chrono::milliseconds budget() const { return budget_.load(); }
  void set_budget(std::chrono::milliseconds x) { budget_.store(x); }

  /// The component is idle from now on.
  void set_idle() {
    busy_since_.store(0, std::memory_order_relaxed);
    user_code_since_.store(0, std::memory_order_relaxed);
  }

  /// The component's own code runs from now on, until it next calls the runtime.
  void enter_user_code(Clock::time_point now) {
    auto ticks = now.time_since_epoch().count();
    user_code_since_.store(ticks, std::memory_order_relaxed);
    if (busy_since_.load(std::memory_order_relaxed) == 0)
      busy_since_.store(ticks, std::memory_order_relaxed);
  }

  void leave_user_code() { user_code_since_.store(0, std::memory_order_relaxed); }

  /// The calling thread is the component's own until `thread_ends`.
  void thread_begins() {
    std::lock_guard guard{mutex_};
    clockid_t clock{};
    if (pthread_getcpuclockid(pthread_self(), &clock) == 0)
      clock_ = clock;
  }

  void thread_ends() {
    auto total = cpu();
    std::lock_guard guard{mutex_};
    clock_.reset();
    cpu_ = total;
  }

  /// A component without a thread of its own has taken that much on one that it shares.
  void add_cpu(std::chrono::nanoseconds x) {
    std::lock_guard guard{mutex_};
    cpu_ += x;
  }

  /// CPU time of the component's thread, or of its turns on shared ones.
  std::chrono::nanoseconds cpu() const {
    std::lock_guard guard{mutex_};
    timespec time{};
    if (!clock_ || clock_gettime(*clock_, &time) != 0)
      return cpu_;
    return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
  }

  /// Time since the component was last idle; 0 while it is idle.
  Clock::duration busy_for(Clock::time_point now) const { return since(busy_since_, now); }

  /// How long the component's own code has run without calling the runtime.
  Clock::duration in_user_code_for(Clock::time_point now) const {
    return since(user_code_since_, now);
  }

private:
  static Clock::duration since(const std::atomic<std::int64_t>& stamp, Clock::time_point now) {
    auto ticks = stamp.load(std::memory_order_relaxed);
    if (ticks == 0)
      return Clock::duration::zero();
    return now.time_since_epoch() - Clock::duration{ticks};
  }

  const ComponentIdentity identity_;
  const ClientPtr client_;
  std::atomic<ComponentState> state_{ComponentState::created};
  std::atomic<bool> orphaned_{false};
  std::atomic<std::chrono::milliseconds> budget_{std::chrono::milliseconds::max()};
  std::atomic<std::int64_t> busy_since_{0};
  std::atomic<std::int64_t> user_code_since_{0};
  mutable std::mutex mutex_;
  std::string failure_;
  std::string waited_for_;
  std::string obeyed_;
  /// CPU clock of the component's thread, while there is one.
  std::optional<clockid_t> clock_;
  std::chrono::nanoseconds cpu_{0};
};

} // namespace castor
