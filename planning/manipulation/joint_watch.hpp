#pragma once

#include <cmath>
#include <string>

namespace castor::manipulation {

/// Tells a joint that does not move any more from one that sticks for a moment: motions have ended
/// twice because it did not follow, and it has not moved in between.
class JointWatch {
public:
  /// A motion has ended because that joint did not follow.
  /// @param at where the joint stands, radians or metres
  /// @returns whether it does not move any more
  bool did_not_follow(const std::string& joint, double at) {
    constexpr double same_place = 1e-3;
    const bool stands = joint == joint_ && std::abs(at - at_) < same_place;
    joint_ = joint;
    at_ = at;
    return stands;
  }

private:
  std::string joint_;
  double at_ = 0;
};

} // namespace castor::manipulation
