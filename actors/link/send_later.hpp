#pragma once

#include "castor/base/caf.hpp"

#include <caf/actor_clock.hpp>
#include <caf/local_actor.hpp>
#include <caf/mailbox_element.hpp>

#include <chrono>

namespace castor {

/// Sends a broker a message after a delay, without a sender. With the broker as sender, as in
/// `delayed_send` and `delayed_anon_send`, a message that arrives after its end would keep it alive
/// for ever: a broker that ends leaves unread messages in its mailbox.
template <class T>
void send_later(caf::local_actor* to, std::chrono::milliseconds after, const T& x) {
  auto& clock = to->system().clock();
  clock.schedule_message(clock.now() + after, caf::actor_cast<caf::strong_actor_ptr>(to),
                         caf::make_mailbox_element(nullptr, caf::make_message_id(), {}, x));
}

} // namespace castor
