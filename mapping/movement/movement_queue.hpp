#pragma once

#include "castor/mapping/movement/types.hpp"
#include "castor/wm/entries/address.hpp"

#include <optional>
#include <set>

namespace castor::mapping {

/// Which actions of movement an urgent one has cleared: it does so when it arrives, not when its
/// turn comes.
class MovementQueue {
public:
  /// An action was asked for. It may have begun already.
  void arrive(const Address& action, MovementPriority priority);

  /// The turn of an action has come. False if it was cleared, and is not to begin.
  bool begin(const Address& action);

  /// The one that runs has ended.
  void end();

  /// Whether the one that runs was cleared, and is to end.
  bool is_cleared() const { return is_cleared_; }

private:
  /// Those that have not begun, and those of them that are not to begin.
  std::set<Address> waiting_;
  std::set<Address> cleared_;
  std::optional<Address> runs_;
  bool is_cleared_ = false;
};

} // namespace castor::mapping
