#include "castor/actors/runtime/injected_faults.hpp"

#include <stdexcept>
#include <thread>
#include <utility>

namespace castor {

void InjectedFaults::take(const ComponentFault& x, Clock::time_point now) {
  switch (x.kind) {
    case ComponentFault::Kind::crash:
      crash_ = true;
      break;
    case ComponentFault::Kind::failure:
      failure_in_ = x.callback;
      failure_ticket_ = x.ticket;
      break;
    case ComponentFault::Kind::hang:
      hang_ = x.by;
      hang_ticket_ = x.ticket;
      break;
    case ComponentFault::Kind::blocked_configure:
      blocked_[Phase::configure] = {x.by, x.ticket};
      break;
    case ComponentFault::Kind::blocked_start:
      blocked_[Phase::start] = {x.by, x.ticket};
      break;
    case ComponentFault::Kind::slowness:
      slowness_ = x.by;
      slow_until_ = now + x.duration;
      slowness_ticket_ = x.ticket;
      break;
  }
}

void InjectedFaults::in_phase(Phase x) {
  if (auto blocked = blocked_.extract(x)) {
    report_effect(blocked.mapped().ticket);
    std::this_thread::sleep_for(blocked.mapped().by);
  }
}

void InjectedFaults::in_callback() {
  if (auto hang = std::exchange(hang_, std::nullopt)) {
    report_effect(hang_ticket_);
    std::this_thread::sleep_for(*hang);
  }
  if (slowness_ > Timestamp{0} && Clock::now() < slow_until_) {
    report_effect(slowness_ticket_);
    std::this_thread::sleep_for(slowness_);
  }
  if (failure_in_ > 0 && --failure_in_ == 0) {
    report_effect(failure_ticket_);
    throw std::runtime_error("injected failure");
  }
}

} // namespace castor
