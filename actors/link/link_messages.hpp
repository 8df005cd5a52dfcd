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

/// Properties of messages that links need, supplied by the user of the links. Used from any thread.
class LinkMessages {
public:
  using Content = caf::type_erased_tuple;
  /// Called with the representative of the message's receiver, null if that is lost.
  using OnArrival = std::function<void(const caf::strong_actor_ptr& receiver)>;

  /// The table has to outlive it.
  explicit LinkMessages(const WireTable& table) : table_(table) {}
  virtual ~LinkMessages() = default;

  /// Messages that may be sent to other processes.
  const WireTable& table() const { return table_; }

  /// Number of change events in a message, for the link's record.
  virtual std::size_t count_events(const Content& x) const = 0;

  /// Why a message must not be sent to an actor; nothing if it may.
  virtual std::optional<Failure> check(ActorName to, const Content& x) const = 0;

  /// Failure of a message of at least `size` bytes over a link that takes up to `largest` bytes.
  virtual Failure too_large(const Content& x, std::size_t size, std::size_t largest) const = 0;

  /// Outcome for an actor that waits for an operation if `x` is not sent: the reply if `x` is the
  /// request, otherwise sent in place of `x`. Nothing if the outcome cannot hold a failure.
  virtual std::optional<caf::message> failed_outcome(const Content& x,
                                                     const Failure& why) const = 0;

  /// Receipt that the sender of a message that is no request gets in the receiver's name if the
  /// message is not sent; without it, the message would count as under way for ever. Nothing for
  /// most.
  virtual std::optional<caf::message> receipt_if_dropped(const Content& x) const = 0;

  /// Whether values in the message may be sent to the same process again, as those of entries that
  /// several of its components read.
  virtual bool may_repeat(const Content& x) const = 0;

  /// Function to call once the peer has received the whole message; empty for most.
  virtual OnArrival on_arrival(ProcessNumber peer, const caf::strong_actor_ptr& sender,
                               const Content& x) = 0;

  /// The process has ended: nothing is sent to it any more.
  virtual void process_ended(ProcessNumber peer) = 0;

private:
  const WireTable& table_;
};

} // namespace castor
