#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

namespace castor {

/// Operations of a component that does not wait, from when they begin until their results were
/// called back: in the order in which these arrive. Pure: time is an argument.
class OpenOperations {
public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// An operation; `call_back` is called with its result, or when that has not come in time.
  struct Open {
    /// Of the request; 0 if none was needed.
    std::uint64_t id = 0;
    /// Names the operation in reports of its failure.
    std::string what;
    std::function<void()> call_back;
  };
  using OpenPtr = std::shared_ptr<Open>;

  /// An operation was sent. `until` must not be earlier than that of the last one.
  OpenPtr begin(Open x, TimePoint until) {
    auto result = std::make_shared<Open>(std::move(x));
    waiting_.emplace(result->id, result);
    deadlines_.emplace_back(until, result->id);
    return result;
  }

  /// An operation was done at once.
  OpenPtr begin_done(Open x) { return done_.emplace_back(std::make_shared<Open>(std::move(x))); }

  /// The result of an operation has arrived.
  void answered(std::uint64_t id) {
    if (auto x = waiting_.extract(id))
      done_.push_back(std::move(x.mapped()));
  }

  /// Those that are due are done: there will be no result.
  void expire(TimePoint now) {
    for (; !deadlines_.empty() && deadlines_.front().first <= now; deadlines_.pop_front())
      answered(deadlines_.front().second);
  }

  /// When the next one is due; `TimePoint::max()` if none waits.
  TimePoint next_deadline() {
    while (!deadlines_.empty() && waiting_.count(deadlines_.front().second) == 0)
      deadlines_.pop_front();
    return deadlines_.empty() ? TimePoint::max() : deadlines_.front().first;
  }

  bool is_empty() const { return waiting_.empty() && done_.empty(); }
  /// Whether there is something to call back.
  bool has_done() const { return !done_.empty(); }

  OpenPtr take_done() {
    auto result = std::move(done_.front());
    done_.pop_front();
    return result;
  }

  void clear() {
    waiting_.clear();
    done_.clear();
    deadlines_.clear();
  }

private:
  std::unordered_map<std::uint64_t, OpenPtr> waiting_;
  std::deque<OpenPtr> done_;
  /// Those of operations that were answered are among them.
  std::deque<std::pair<TimePoint, std::uint64_t>> deadlines_;
};

} // namespace castor
