#include "castor/tools/chaos/activity.hpp"

#include <utility>

namespace castor::faults {

void ActivityMeter::take(Timestamp at, const std::vector<ComponentSample>& samples) {
  auto is_first = std::exchange(is_first_, false);
  if (is_first)
    begin_ = at;
  end_ = at;
  bool busy = false;
  for (auto& x : samples) {
    auto& counts = components_[x.component];
    auto lives_on = counts.seen > 0 && counts.last.incarnation == x.incarnation;
    auto callbacks = x.callbacks - (lives_on ? counts.last.callbacks : 0);
    auto operations = x.operations - (lives_on ? counts.last.operations : 0);
    counts.seen = lives_on ? counts.seen + 1 : 1;
    counts.last = x;
    if (is_first)
      continue;
    counts.callbacks += callbacks;
    counts.operations += operations;
    // What it does at its start it does because of that.
    busy = busy || (counts.seen > 2 && callbacks + operations > 0);
  }
  if (is_first)
    return;
  ++moments_;
  if (busy)
    ++busy_moments_;
}

Activity ActivityMeter::total() const {
  Activity result{end_ - begin_, 0, 0, moments_, busy_moments_};
  for (auto& [name, x] : components_) {
    result.callbacks += x.callbacks;
    result.operations += x.operations;
  }
  return result;
}

ActivityByComponent ActivityMeter::by_component() const {
  ActivityByComponent result;
  auto seconds = std::chrono::duration<double>(end_ - begin_).count();
  for (auto& [name, x] : components_)
    if (seconds > 0)
      result[name] = {static_cast<double>(x.callbacks) / seconds,
                      static_cast<double>(x.operations) / seconds};
  return result;
}

} // namespace castor::faults
