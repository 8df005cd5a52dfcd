#include "castor/actors/link/remote_actor.hpp"

#include <utility>

namespace castor {

void RemoteActor::enqueue(caf::mailbox_element_ptr x, caf::execution_unit*) {
  if (!x)
    return;
  if (ended_)
    bounce(x, caf::make_error(caf::sec::request_receiver_down));
  else
    port_->send(actor_, *x);
}

void RemoteActor::kill_proxy(caf::execution_unit* context, caf::error reason) {
  ended_ = true;
  cleanup(std::move(reason), context);
}

} // namespace castor
