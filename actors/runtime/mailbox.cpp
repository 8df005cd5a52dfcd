#include "castor/actors/runtime/mailbox.hpp"

#include <utility>

namespace castor {

bool PumpedActor::pump(Clock::time_point until) {
  if (mailbox().empty()) {
    auto left = until - Clock::now();
    // CAF parks on a clock that may be the wall clock: give it a short relative step, so that a
    // jump of that clock delays nothing for long.
    constexpr Clock::duration longest_step = std::chrono::seconds{1};
    if (left <= Clock::duration::zero())
      return false;
    if (!await_data(timeout_type::clock::now() + std::min(left, longest_step)))
      return Clock::now() < until;
  }
  file_arrived();
  return true;
}

void PumpedActor::file_arrived() {
  constexpr int at_most = 256;
  for (int i = 0; i < at_most && !mailbox().empty(); ++i) {
    auto x = dequeue();
    if (!x->mid.is_response()) {
      file(std::move(x));
    } else if (auto i_slot = slots_.find(x->mid.integer_value()); i_slot != slots_.end()) {
      i_slot->second = std::move(x);
    } else if (auto receiver = receivers_.extract(x->mid.integer_value())) {
      receiver.mapped()(*x);
    }
  }
}

void PumpedActor::respond(const caf::strong_actor_ptr& to, caf::message_id request,
                          caf::message reply) {
  if (request.is_request() && to)
    to->enqueue(ctrl(), request.response_id(), std::move(reply), context());
}

} // namespace castor
