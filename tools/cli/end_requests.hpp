#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace castor::cli {

/// Decides how a process reacts to requests to end: the first one ends it in order, the second by
/// force. Pure: gets the time as an argument.
class EndRequests {
public:
  using Clock = std::chrono::steady_clock;

  enum class Kind : std::uint8_t {
    /// Ctrl-C or SIGTERM.
    interrupt,
    /// The terminal is closed; may be signalled several times.
    hangup,
    /// The reader of the output has closed it.
    output_ended,
    /// The parent process has closed the standard input, or has ended.
    input_ended,
  };

  enum class Answer : std::uint8_t { nothing, in_order, by_force };

  /// Two signals within this time are one request: `timeout` sends its signal to the process, and
  /// then to the process group.
  static constexpr std::chrono::milliseconds same_request{50};

  /// @param patience time after the first request after which the process ends by force; nothing
  /// for never
  explicit EndRequests(std::optional<std::chrono::milliseconds> patience = {})
    : patience_(patience) {}

  Answer request(Kind kind, Clock::time_point now) {
    if (!first_) {
      first_ = now;
      return Answer::in_order;
    }
    bool insists = kind == Kind::interrupt && now - *first_ >= same_request;
    return insists ? Answer::by_force : Answer::nothing;
  }

  /// Sets a deadline for the end of the process, independent of requests; nothing for none.
  void set_limit(std::optional<Clock::time_point> x) { limit_ = x; }

  /// Time at which the process ends by force.
  std::optional<Clock::time_point> deadline() const {
    if (!first_ || !patience_)
      return limit_;
    auto result = *first_ + *patience_;
    return limit_ ? std::min(*limit_, result) : result;
  }

  /// Reaction due to time alone, without a further request.
  Answer look(Clock::time_point now) const {
    auto end = deadline();
    return end && now >= *end ? Answer::by_force : Answer::nothing;
  }

private:
  std::optional<std::chrono::milliseconds> patience_;
  std::optional<Clock::time_point> first_;
  std::optional<Clock::time_point> limit_;
};

} // namespace castor::cli
