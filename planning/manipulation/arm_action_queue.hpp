#pragma once

#include "castor/wm/entries/address.hpp"

#include <set>

namespace castor::manipulation {

/// Which actions of an arm a stop has ended: the one that runs, and those that waited when it came.
class ArmActionQueue {
public:
  /// An action was asked for. It may have begun already.
  void arrive(const Address& action) {
    if (!begun_.contains(action))
      waiting_.insert(action);
  }

  void stop() {
    stopped_.insert(waiting_.begin(), waiting_.end());
    waiting_.clear();
    is_stopped_ = true;
  }

  /// The turn of an action has come. False if it was stopped, and is not to begin.
  bool begin(const Address& action) {
    waiting_.erase(action);
    begun_ = {action};
    is_stopped_ = stopped_.erase(action) > 0;
    return !is_stopped_;
  }

  /// Whether the one that runs is to end.
  bool is_stopped() const { return is_stopped_; }

private:
  std::set<Address> waiting_;
  std::set<Address> stopped_;
  /// The one that has begun last.
  std::set<Address> begun_;
  bool is_stopped_ = false;
};

} // namespace castor::manipulation
