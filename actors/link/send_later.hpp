#pragma once

#include "castor/base/caf.hpp"

#include <caf/actor_clock.hpp>
#include <caf/local_actor.hpp>
#include <caf/mailbox_element.hpp>

#include <chrono>

namespace castor {

/// Sends a broker something after a while, from nobody. With itself as the sender, as
/// `delayed_send` and `delayed_anon_send` have it, it would live for ever if that came too late: a
/// broker that ends leaves in its mailbox what it has not looked at.
template <class T>
void send_later(caf::local_actor* to, std::chrono::milliseconds after, const T& x) {
  auto& clock = to->system().clock();
  clock.schedule_message(clock.now() + after, caf::actor_cast<caf::strong_actor_ptr>(to),
                         caf::make_mailbox_element(nullptr, caf::make_message_id(), {}, x));
}

} // namespace castor
