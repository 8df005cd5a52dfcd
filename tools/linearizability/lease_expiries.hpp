#pragma once

#include "castor/tools/linearizability/history.hpp"

#include <map>

namespace castor::linearizability {

/// The lapses that there may be among operations, until the moment `end`: of each lease that
/// somebody knows of, so long after it was asked for or once its client has ended; and of those
/// that pending locks may have obtained, at any time.
History possible_lease_expiries(const History& operations, Tick lease_duration,
                                const std::map<Client, Tick>& ends, Tick end);

} // namespace castor::linearizability
