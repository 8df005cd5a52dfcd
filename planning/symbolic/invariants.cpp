#include "castor/planning/symbolic/invariants.hpp"
namespace castor::planning {
MutexGroups find_mutex_groups(const LiftedTask&, const NormalTask&, const GroundTask&, LimitWatch&) {
  return {};
}
} // namespace castor::planning
