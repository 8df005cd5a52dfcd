#pragma once

#include "castor/tools/linearizability/history.hpp"

#include <map>

namespace castor::linearizability {

/// Possible lapses of the leases of a history, up to `end`: of each known lease `lease_duration`
/// after its request, or once its client has ended; of leases that pending locks may have obtained,
/// at any time.
History possible_lease_expiries(const History& operations, Tick lease_duration,
                                const std::map<Client, Tick>& ends, Tick end);

} // namespace castor::linearizability
