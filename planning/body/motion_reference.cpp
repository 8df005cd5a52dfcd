#include "castor/planning/body/motion_reference.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace castor::manipulation {

MotionReference::MotionReference(Configuration start, double stop_time)
  : joints_(start.size()), stop_time_(stop_time) {
  stay(start);
}

std::size_t MotionReference::samples() const {
  return command_.positions.size() / joints_;
}

double MotionReference::end() const {
  return command_.begin + command_.interval * static_cast<double>(samples() - 1);
}

double MotionReference::sample(std::ptrdiff_t index, std::size_t joint) const {
  const auto last = static_cast<std::ptrdiff_t>(samples()) - 1;
  const auto kept = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, last));
  return command_.positions[kept * joints_ + joint];
}

void MotionReference::follow(const ArmCommand& command) {
  if (command.positions.empty() || command.positions.size() % joints_ != 0 ||
      !(command.interval > 0))
    throw std::invalid_argument("a command needs configurations of " + std::to_string(joints_) +
                                " joints, and an interval of more than 0 s");
  const bool is_new = command.motion != command_.motion;
  command_ = command;
  if (is_new) {
    time_ = std::max(0.0, command_.begin);
    rate_ = 0;
  }
  time_ = std::clamp(time_, command_.begin, end());
}

void MotionReference::advance(double seconds, bool goes_on) {
  const double change = seconds / stop_time_;
  rate_ = goes_on ? std::min(1.0, rate_ + change) : std::max(0.0, rate_ - change);
  const double left = end() - time_;
  // The way on which it comes to rest from full speed is half of what it would have gone.
  rate_ = std::min(rate_, std::sqrt(2 * left / stop_time_));
  time_ = std::min(end(), time_ + rate_ * seconds);
}

void MotionReference::stay(const Configuration& at) {
  command_ = {};
  command_.positions = at;
  time_ = 0;
  rate_ = 0;
}

Configuration MotionReference::position() const {
  const double at = (time_ - command_.begin) / command_.interval;
  const double whole = std::floor(at);
  const auto i = static_cast<std::ptrdiff_t>(whole);
  const double t = at - whole;
  Configuration result(joints_);
  // A spline of Catmull and Rom: smooth where commands meet, as all have the same samples.
  for (std::size_t joint = 0; joint < joints_; ++joint) {
    const double before = sample(i - 1, joint);
    const double from = sample(i, joint);
    const double to = sample(i + 1, joint);
    const double after = sample(i + 2, joint);
    result[joint] =
      from +
      t / 2 *
        (to - before +
         t * (2 * before - 5 * from + 4 * to - after + t * (3 * (from - to) + after - before)));
  }
  return result;
}

} // namespace castor::manipulation
