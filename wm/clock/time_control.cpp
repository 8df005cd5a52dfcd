#include "castor/wm/clock/time_control.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor {

namespace {

/// How often time goes on at a pace of real time although nobody is to be woken, so that what comes
/// from outside gets a time stamp of its own.
constexpr std::chrono::milliseconds paced_step{20};

std::uint64_t count_of(const std::map<ClockMember, std::uint64_t>& counts, ClockMember x) {
  auto i = counts.find(x);
  return i == counts.end() ? 0 : i->second;
}

} // namespace

void TimeControl::remove_member(ClockMember x) {
  members_.erase(x);
  reports_.erase(x);
  told_.erase(x);
}

void TimeControl::report(ClockMember from, ClockReport x) {
  if (members_.contains(from))
    reports_[from] = std::move(x);
}

void TimeControl::set_pace(Pace x, RealTime real) {
  anchor_time_ = now_;
  anchor_real_ = real;
  step_limit_ = now_;
  pace_ = x;
}

void TimeControl::step(Timestamp x) {
  step_limit_ = std::max(step_limit_, now_) + x;
}

bool TimeControl::has_reported(ClockMember x) const {
  auto report = reports_.find(x);
  auto told = told_.find(x);
  return report != reports_.end() && (told == told_.end() || report->second.round >= told->second);
}

bool TimeControl::is_quiet() const {
  if (!std::all_of(members_.begin(), members_.end(), [&](auto x) { return has_reported(x); }))
    return false;
  for (auto from : members_)
    for (auto to : members_)
      if (from != to && count_of(reports_.at(from).counts.sent, to) !=
                          count_of(reports_.at(to).counts.received, from))
        return false;
  return true;
}

std::vector<ClockMember> TimeControl::busy() const {
  std::vector<ClockMember> result;
  std::copy_if(members_.begin(), members_.end(), std::back_inserter(result),
               [&](auto x) { return !has_reported(x); });
  return result;
}

Timestamp TimeControl::next() const {
  auto result = Timestamp::max();
  for (auto& [member, report] : reports_)
    result = std::min(result, report.next);
  return result;
}

Timestamp TimeControl::paced(RealTime real) const {
  using Seconds = std::chrono::duration<double>;
  auto passed = Seconds{real - anchor_real_} * *pace_.factor;
  return anchor_time_ + std::chrono::duration_cast<Timestamp>(passed);
}

TimeControl::RealTime TimeControl::due(Timestamp x) const {
  using Seconds = std::chrono::duration<double>;
  auto wait = Seconds{x - anchor_time_} / *pace_.factor;
  return anchor_real_ + std::chrono::ceil<RealTime::duration>(wait);
}

TimeControl::Decision TimeControl::decide(RealTime real) {
  Decision result;
  if (!is_quiet())
    return result;
  auto first = next();
  auto limit = pace_.paused ? std::min(limit_, step_limit_) : limit_;
  auto target = std::min(first, limit);
  // Those who are woken now are not kept waiting by any limit: no time passes.
  if (first > now_ && target <= now_) {
    result.at_limit = limit_ <= now_;
    return result;
  }
  if (pace_.factor && !pace_.paused && target > now_) {
    auto present = std::max(now_, paced(real));
    if (present < target) {
      auto soon = real + paced_step;
      result.ask_again = target == Timestamp::max() ? soon : std::min(soon, due(target));
      if (present - now_ < paced_step * *pace_.factor)
        return result;
      target = present;
    }
  }
  // Nobody sleeps, and there is no limit: only somebody outside can go on.
  if (target == Timestamp::max())
    return result;
  now_ = std::max(now_, target);
  result.advance = ClockAdvance{++round_, now_};
  told_[0] = round_;
  for (auto x : members_)
    // At a pace of real time, what comes from outside gets the right time everywhere.
    if (x != 0 && (pace_.factor || reports_.at(x).next <= now_)) {
      told_[x] = round_;
      result.receivers.push_back(x);
    }
  return result;
}

} // namespace castor
