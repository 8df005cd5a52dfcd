#include "castor/base/injected_fault.hpp"

#include <utility>

namespace castor {

void report_effect(FaultTicket& x) {
  if (auto observer = std::exchange(x.observer, {}))
    caf::anon_send(observer, FaultHappened{x.number});
}

} // namespace castor
