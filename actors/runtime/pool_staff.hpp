#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

namespace castor {

/// Threads of a pool, and which of them are held up by what they run: decides how many there have
/// to be. Pure: time is an argument.
class PoolStaff {
public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Id = std::uint64_t;

  struct Limits {
    /// Threads that are to be there for others.
    std::size_t wanted = 2;
    /// Time after which a thread that runs the same turn is held up.
    std::chrono::milliseconds patience{100};
    /// Most threads, those held up included.
    std::size_t most = 256;
  };

  explicit PoolStaff(Limits limits) : limits_(limits) {}

  std::size_t size() const { return threads_.size(); }

  /// A thread begins.
  Id hire() {
    threads_.emplace(++last_, std::nullopt);
    return last_;
  }
  void dismiss(Id x) { threads_.erase(x); }

  void begin_turn(Id x, TimePoint now) { threads_.at(x) = now; }
  void end_turn(Id x) { threads_.at(x) = std::nullopt; }

  /// Number of threads that have to be hired, so that enough are not held up.
  std::size_t missing(TimePoint now) const {
    auto there = available(now);
    return there >= limits_.wanted || size() >= limits_.most
             ? 0
             : std::min(limits_.wanted - there, limits_.most - size());
  }

  /// Whether some were hired in the place of others, which were held up.
  bool is_enlarged() const { return size() > limits_.wanted; }

  /// Whether there are more than enough: those that were held up are back.
  bool has_surplus(TimePoint now) const { return is_enlarged() && available(now) > limits_.wanted; }

private:
  std::size_t available(TimePoint now) const {
    return static_cast<std::size_t>(std::count_if(threads_.begin(), threads_.end(), [&](auto& x) {
      return !x.second || now - *x.second < limits_.patience;
    }));
  }

  const Limits limits_;
  Id last_ = 0;
  /// With the beginning of their turns.
  std::map<Id, std::optional<TimePoint>> threads_;
};

} // namespace castor
