#include "castor/actors/runtime/timers.hpp"

#include <algorithm>
#include <utility>

namespace castor {

TimerId Timers::add(std::chrono::nanoseconds period, TimePoint now, std::function<void()> call) {
  TimerId id{++last_id_};
  timers_.emplace(id, Timer{period, now + period,
                            std::make_shared<const std::function<void()>>(std::move(call))});
  return id;
}

Timers::TimePoint Timers::next() const {
  auto result = TimePoint::max();
  for (auto& [id, timer] : timers_)
    result = std::min(result, timer.due);
  return result;
}

std::vector<std::pair<TimerId, Timers::Call>> Timers::take_due(TimePoint now) {
  std::vector<std::pair<TimePoint, TimerId>> due;
  for (auto& [id, timer] : timers_)
    if (timer.due <= now)
      due.emplace_back(timer.due, id);
  std::sort(due.begin(), due.end());
  std::vector<std::pair<TimerId, Call>> result;
  for (auto& [time, id] : due) {
    auto& timer = timers_.at(id);
    timer.due += timer.period * (1 + (now - timer.due) / timer.period);
    result.emplace_back(id, timer.call);
  }
  return result;
}

} // namespace castor
