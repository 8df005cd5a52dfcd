#pragma once

#include "castor/actors/link/actor_name.hpp"
#include "castor/actors/link/wire_table.hpp"
#include "castor/base/caf.hpp"
#include "castor/wm/entries/failure.hpp"

#include <caf/message.hpp>

#include <cstddef>
#include <functional>
#include <optional>

namespace castor {

/// What links have to know of the messages that they carry, from those who send them to each other.
/// Used from any thread.
class LinkMessages {
public:
  using Content = caf::type_erased_tuple;
  /// Is given the representative of the message's receiver, null if that is lost.
  using OnArrival = std::function<void(const caf::strong_actor_ptr& receiver)>;

  /// The table has to outlive it.
  explicit LinkMessages(const WireTable& table) : table_(table) {}
  virtual ~LinkMessages() = default;

  /// Those that may travel.
  const WireTable& table() const { return table_; }

  /// How many change events a message counts for in the link's record.
  virtual std::size_t count_events(const Content& x) const = 0;

  /// Why a message is not to be sent to an actor, if it is not.
  virtual std::optional<Failure> check(ActorName to, const Content& x) const = 0;

  /// Why a message of at least `size` bytes is not sent over a link that takes up to `largest`.
  virtual Failure too_large(const Content& x, std::size_t size, std::size_t largest) const = 0;

  /// What somebody who waits for the outcome of an operation gets if `x` is not sent: as a reply if
  /// `x` is the request, or in place of `x`. Nothing if the outcome cannot tell of a failure.
  virtual std::optional<caf::message> failed_outcome(const Content& x,
                                                     const Failure& why) const = 0;

  /// What the sender of a message that is no request is sent in the receiver's name if the message
  /// is not sent, because it would count as under way for ever. Nothing for most.
  virtual std::optional<caf::message> receipt_if_dropped(const Content& x) const = 0;

  /// Called once the peer has all of a message; empty for most.
  virtual OnArrival on_arrival(ProcessNumber peer, const caf::strong_actor_ptr& sender,
                               const Content& x) = 0;

  /// Nothing is sent to that process any more.
  virtual void process_ended(ProcessNumber peer) = 0;

private:
  const WireTable& table_;
};

} // namespace castor
