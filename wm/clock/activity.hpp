#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace castor {

/// Told when nobody in the process has anything to do.
class QuietListener {
public:
  virtual ~QuietListener() = default;

  /// Called on the thread that returned the last token.
  virtual void on_quiet() = 0;
};

/// Counts the tokens of a process with a simulated clock: an actor holds one from before it becomes
/// ready until it waits again. Simulated time stands while there is a token.
///
/// If actors run one at a time, a token can be a turn: whoever takes one waits until all turns
/// taken earlier have ended. So the order in which actors run is that in which they became ready.
///
/// A token is taken by a holder of another one, for somebody who is to become ready, or from
/// outside, by a thread that holds none. So while there is no token, all actors wait, and no
/// message is on its way inside the process. Safe to use from any thread.
class Activity {
public:
  enum class Order : std::uint8_t { parallel, one_at_a_time };

  /// Number of a turn; 0 for none.
  using Turn = std::uint64_t;

  explicit Activity(Order order = Order::parallel)
    : one_at_a_time_(order == Order::one_at_a_time) {}

  bool is_one_at_a_time() const { return one_at_a_time_; }

  /// Takes a token, and the next turn.
  Turn begin() {
    hold();
    return one_at_a_time_ ? last_turn_.fetch_add(1) + 1 : 1;
  }

  /// Waits until the turns before this one have ended.
  void await(Turn turn) const {
    if (!one_at_a_time_)
      return;
    for (auto x = present_turn_.load(); x != turn; x = present_turn_.load())
      present_turn_.wait(x);
  }

  /// Returns the token, whose turn it is.
  void end(Turn turn) {
    if (one_at_a_time_) {
      present_turn_.store(turn + 1);
      present_turn_.notify_all();
    }
    release();
  }

  /// Takes a token without a turn, for somebody who is not an actor, or who is going to send
  /// something later.
  void hold() { count_.fetch_add(one_activation + 1); }

  void release() {
    if (!release_silently())
      return;
    for (auto& x : *listeners())
      if (auto listener = x.lock())
        listener->on_quiet();
  }

  // -- for listeners

  void add_listener(const std::shared_ptr<QuietListener>& x);

  /// Takes a token if there is none. Returns whether it did.
  bool hold_if_quiet() {
    auto x = count_.load();
    return tokens(x) == 0 && count_.compare_exchange_strong(x, x + one_activation + 1);
  }

  /// Number of tokens that have been taken so far, modulo 2^32.
  std::uint32_t activations() const { return static_cast<std::uint32_t>(count_.load() >> 32); }

  /// Returns the token without calling listeners. Returns whether it was the last one.
  bool release_silently() { return tokens(count_.fetch_sub(1)) == 1; }

private:
  using Listeners = std::vector<std::weak_ptr<QuietListener>>;

  static constexpr std::uint64_t one_activation = std::uint64_t{1} << 32;

  static std::uint32_t tokens(std::uint64_t count) { return static_cast<std::uint32_t>(count); }

  std::shared_ptr<const Listeners> listeners() const {
    std::lock_guard guard{mutex_};
    return listeners_;
  }

  const bool one_at_a_time_;
  /// Activations so far in the upper half, present tokens in the lower one.
  std::atomic<std::uint64_t> count_{0};
  std::atomic<Turn> last_turn_{0};
  std::atomic<Turn> present_turn_{1};
  mutable std::mutex mutex_;
  std::shared_ptr<const Listeners> listeners_ = std::make_shared<Listeners>();
};

/// A token for as long as it lives; none if it was made of nothing.
class TimeHold {
public:
  TimeHold() = default;
  explicit TimeHold(std::shared_ptr<Activity> activity) : activity_(std::move(activity)) {
    if (activity_)
      activity_->hold();
  }
  TimeHold(TimeHold&&) = default;
  TimeHold& operator=(TimeHold&& x) noexcept {
    std::swap(activity_, x.activity_);
    return *this;
  }
  ~TimeHold() {
    if (activity_)
      activity_->release();
  }

private:
  std::shared_ptr<Activity> activity_;
};

} // namespace castor
