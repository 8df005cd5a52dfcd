#pragma once

#include "castor/wm/clock/clock_messages.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// Limits of a factor.
inline constexpr double slowest_pace = 1e-3;
inline constexpr double fastest_pace = 1e6;

/// How fast simulated time goes on.
struct Pace {
  /// Simulated seconds per real second; nothing for as fast as everybody is done.
  std::optional<double> factor;
  bool paused = false;

  friend bool operator==(const Pace&, const Pace&) = default;
};

/// Decides when the simulated time of a system goes on, and to when, from the reports of its
/// processes. Real time is an argument.
///
/// Time goes on when every process has reported that nobody there has anything to do since it was
/// told that time goes on, and no message is between two of them: for each pair, as many have
/// arrived at one as the other has sent. Why counts of each pair, and not their sums: suppose that
/// somebody was activated after its process reported, and take the first one, by a message from
/// another process. That process had sent it before its own report, or it would have been activated
/// earlier. So the message is in the sender's count and not in the receiver's, and equal counts
/// need another message that was sent after the sender's report and received before the receiver's;
/// then again the sender was activated earlier.
class TimeControl {
public:
  using RealTime = std::chrono::steady_clock::time_point;

  /// Member 0 is the process that decides, and knows of every round.
  explicit TimeControl(RealTime now) : anchor_real_(now) { members_.insert(0); }

  void add_member(ClockMember x) { members_.insert(x); }
  /// The process is lost, or does not take part any more.
  void remove_member(ClockMember x);

  void report(ClockMember from, ClockReport x);
  /// The process has to report anew.
  void forget_report(ClockMember from) { reports_.erase(from); }

  Timestamp now() const { return now_; }
  ClockAdvance present() const { return {round_, now_}; }

  /// Time goes on up to here, and stands then.
  void set_limit(Timestamp x) { limit_ = x; }
  Timestamp limit() const { return limit_; }

  const Pace& pace() const { return pace_; }
  void set_pace(Pace x, RealTime real);
  /// While time is paused, lets that much pass.
  void step(Timestamp x);

  struct Decision {
    std::optional<ClockAdvance> advance;
    /// Other processes to tell. The rest has nobody to wake, and learns of it with the next message
    /// from a process that knows.
    std::vector<ClockMember> receivers;
    /// When to ask again, if nothing is reported earlier.
    std::optional<RealTime> ask_again;
    /// Nobody has anything to do before the limit, where time stands.
    bool at_limit = false;
  };
  Decision decide(RealTime real);

  /// Members that have something to do, as far as is known.
  std::vector<ClockMember> busy() const;

private:
  /// Whether the member has reported since it was told to go on.
  bool has_reported(ClockMember x) const;
  bool is_quiet() const;
  Timestamp next() const;
  /// Time that corresponds to `real` at the present pace.
  Timestamp paced(RealTime real) const;
  RealTime due(Timestamp x) const;

  std::set<ClockMember> members_;
  std::map<ClockMember, ClockReport> reports_;
  /// Last round that each member was told of.
  std::map<ClockMember, std::uint64_t> told_;
  std::uint64_t round_ = 0;
  Timestamp now_{0};
  Timestamp limit_ = Timestamp::max();
  /// Limit of the steps that were asked for while time is paused.
  Timestamp step_limit_{0};
  Pace pace_;
  /// Where the present pace began.
  RealTime anchor_real_;
  Timestamp anchor_time_{0};
};

} // namespace castor
