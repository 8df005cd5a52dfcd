#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace castor::cli {

/// What requests to end a process amount to: the first one ends it in order, the second by force.
/// Pure: gets the time as an argument.
class EndRequests {
public:
  using Clock = std::chrono::steady_clock;

  enum class Kind : std::uint8_t {
    /// Ctrl-C or SIGTERM.
    interrupt,
    /// The terminal is closed, which may be said several times.
    hangup,
    /// Nobody reads what is printed.
    output_ended,
    /// Whoever started the process has closed its standard input, or is gone.
    input_ended,
  };

  enum class Answer : std::uint8_t { nothing, in_order, by_force };

  /// Two signals within this time are one request: `timeout` sends its signal to the process, and
  /// then to the process group.
  static constexpr std::chrono::milliseconds same_request{50};

  /// So long after the first request the process ends by force; nothing for never.
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

  /// The process has to be over by then, whether anybody asks it to or not; nothing: it need not.
  void set_limit(std::optional<Clock::time_point> x) { limit_ = x; }

  /// When it ends by force.
  std::optional<Clock::time_point> deadline() const {
    if (!first_ || !patience_)
      return limit_;
    auto result = *first_ + *patience_;
    return limit_ ? std::min(*limit_, result) : result;
  }

  /// What is to be done without a further request.
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
