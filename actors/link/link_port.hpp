#pragma once

#include "castor/actors/link/link_clock.hpp"
#include "castor/actors/link/link_messages.hpp"
#include "castor/actors/link/link_record.hpp"
#include "castor/actors/link/open_requests.hpp"
#include "castor/actors/link/session.hpp"
#include "castor/actors/link/wire.hpp"
#include "castor/base/caf.hpp"
#include "castor/wm/entries/failure.hpp"

#include <caf/mailbox_element.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace castor {

/// To a link: a message for the peer, and the types that have to arrive before it.
struct LinkMessage {
  OutgoingMessage message;
  std::vector<TypeDescriptorPtr> types;
};

struct LinkPortParts {
  std::shared_ptr<WireNames> names;
  std::shared_ptr<LinkMessages> messages;
  std::shared_ptr<OpenRequests> requests;
  ProcessNumber self = 0;
  ProcessNumber peer = 0;
  caf::actor link;
  std::shared_ptr<LinkRecord> record;
  std::shared_ptr<LinkClock> clock = std::make_shared<LinkClock>();
  /// The peer's are the same.
  SessionLimits limits = {};
};

/// Sends messages of local actors over the link to another process. Safe to use from any thread.
class LinkPort {
public:
  explicit LinkPort(LinkPortParts parts) : parts_(std::move(parts)) {}

  ProcessNumber peer() const { return parts_.peer; }
  const caf::actor& link() const { return parts_.link; }

  /// Sends a message to the actor of that name; a request that cannot be sent is answered here. A
  /// message too large for its receiver, or for any link, is refused here: the actor that waits for
  /// it gets the failure, and nothing else is affected.
  void send(ActorName to, caf::mailbox_element& x);

  /// Tells the peer that an actor here has ended.
  void tell_end(ActorName who);

private:
  void send_checked(ActorName to, caf::mailbox_element& x);
  /// Sends the failure or receipt for a message that is not sent because it is too large.
  void refuse(ActorName to, caf::mailbox_element& x, const Failure& why);
  /// Remembers a request until it is answered; false if the peer is lost.
  bool open_request(ActorName sender, const caf::mailbox_element& x);
  /// Begins a message with the present simulated time, if the clock is simulated.
  void write_time(WireWriter& out) const;
  void hand_over(LinkMessage message);

  const LinkPortParts parts_;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkMessage)
