#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace castor::planning {

/// What planning may use.
struct PlanningLimits {
  /// From the call on; nothing for no limit.
  std::optional<std::chrono::milliseconds> time;
  std::size_t memory_bytes = std::size_t{3000} << 20;
  /// Actions, effects and axioms without variables.
  std::size_t groundings = 4'000'000;
  /// Planning ends soon after it becomes true; may be null.
  const std::atomic<bool>* is_cancelled = nullptr;
};

/// Why planning ended before it was known whether there is a plan.
enum class LimitReached : std::uint8_t { time, memory, groundings, cancelled };

std::string to_string(LimitReached limit);

class LimitError : public std::runtime_error {
public:
  explicit LimitError(LimitReached limit) : std::runtime_error(to_string(limit)), limit_(limit) {
    // nop
  }

  LimitReached limit() const { return limit_; }

private:
  LimitReached limit_;
};

/// Looks at the flag with each unit of work, and at the clock now and then.
class LimitWatch {
public:
  explicit LimitWatch(const PlanningLimits& limits);

  const PlanningLimits& limits() const { return limits_; }

  /// To be called once per unit of work, which should take at most a millisecond.
  /// \throws LimitError
  void check(std::size_t work = 1) {
    if (limits_.is_cancelled && limits_.is_cancelled->load(std::memory_order_relaxed))
      throw LimitError(LimitReached::cancelled);
    work_ += work;
    if (work_ >= interval)
      look();
  }

  /// \throws LimitError if the data are larger than the limit.
  void check_memory(std::size_t bytes) const {
    if (bytes > limits_.memory_bytes)
      throw LimitError(LimitReached::memory);
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t interval = 1024;

  void look();

  PlanningLimits limits_;
  Clock::time_point begin_ = Clock::now();
  std::size_t work_ = 0;
};

} // namespace castor::planning
