#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace castor::linearizability {

/// Checks that locks are granted in the order of their arrival, except for those that overtake:
/// which do not wait themselves, are another client's, and come within a bounded time.
///
/// That time begins after the last lock that was granted from the queue, and is measured from
/// below: from the return of the first lock that overtook to the invocation of the last one.
class LockOrder {
public:
  struct Lock {
    OperationRecord record;
    /// When it was known to have reached its working memory; `never` if it was not before it
    /// returned.
    Tick arrived_by = never;
    Timestamp invoked{0};
    Timestamp returned{0};
  };

  explicit LockOrder(Timestamp overtaking) : overtaking_(overtaking) {}

  void add(Lock x) { locks_.push_back(std::move(x)); }

  /// One text for each lock that was overtaken wrongly.
  std::vector<std::string> violations() const;

private:
  /// Those that obtained a lease of that entry, in the order of their tokens.
  std::vector<const Lock*> granted(std::uint32_t entry) const;
  /// Whether a lease that nobody was told of may have been granted before that.
  bool may_hide_grants(const Lock& x) const;

  Timestamp overtaking_;
  std::vector<Lock> locks_;
};

} // namespace castor::linearizability
