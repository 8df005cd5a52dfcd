#pragma once

#include "castor/actors/link/actor_names.hpp"
#include "castor/actors/link/link_clock.hpp"
#include "castor/actors/link/link_fault.hpp"
#include "castor/actors/link/link_messages.hpp"
#include "castor/actors/link/link_record.hpp"
#include "castor/actors/link/message_subject.hpp"
#include "castor/actors/link/open_requests.hpp"
#include "castor/actors/link/session.hpp"
#include "castor/base/caf.hpp"

#include <caf/message.hpp>
#include <caf/message_id.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace castor {

/// The actors of a system as one process sees them: its own, which others may know by name, and
/// those of other processes, for which it has representatives.
///
/// Representatives are used as local actors: messages, requests, monitors and exits work. Safe to
/// use from any thread.
class Mesh {
public:
  /// Takes messages in place of an actor, on the network's thread.
  using Sink = std::function<void(ProcessNumber from, const caf::message& message,
                                  caf::execution_unit* context)>;

  Mesh(caf::actor_system& system, std::shared_ptr<LinkMessages> messages, ProcessNumber self)
    : system_(system), messages_(std::move(messages)), self_(self),
      names_(std::make_shared<ActorNames>(system, self)) {}

  caf::actor_system& system() { return system_; }
  ProcessNumber self() const { return self_; }
  ActorNames& names() { return *names_; }

  void set_well_known(WellKnownActor number, const caf::strong_actor_ptr& who);

  /// Passes messages to that number of this process to `sink` from now on.
  void set_sink(WellKnownActor number, Sink sink);

  /// The representative of a well-known actor of another process.
  caf::strong_actor_ptr well_known(ProcessNumber process, WellKnownActor number);

  /// The link that leads to a process, with the limits of both its ends.
  void add_link(const caf::actor& link, std::shared_ptr<LinkRecord> record,
                const SessionLimits& limits = {});

  /// Injects a fault into the link to a process.
  void inject(ProcessNumber peer, const LinkFault& x);

  /// Whether a local actor awaits the answer to a request to one of that process.
  bool awaits(ProcessNumber process) const { return requests_->awaits(process); }

  /// Of all links there ever were, in the order of their peers.
  std::vector<LinkStatus> links() const;

  /// Sends the time of this clock with every message, and keeps it from going on while one arrives.
  void set_clock(std::shared_ptr<SimulatedClock> x) { clock_->set(std::move(x)); }

  /// Messages exchanged with the other processes so far, without those of their clocks.
  MessageCounts message_counts() const;

  /// The process is lost: ends the representatives of its actors, and fails open requests to them.
  void end_process(ProcessNumber process);

  /// Ends all processes as `end_process`, and removes all names of local actors.
  void close();

  /// A message that introduces types, for `receive` at the other end.
  static Bytes introduction(const std::vector<TypeDescriptorPtr>& types);

  /// Handles a message from another process. Throws DecodeError.
  void receive(ProcessNumber from, IncomingMessage message, caf::execution_unit* context);

private:
  void receive_subject(ProcessNumber from, MessageSubject subject, WireReader& in,
                       caf::execution_unit* context);
  void receive_message(ProcessNumber from, bool is_error, WireReader& in,
                       caf::execution_unit* context);
  /// A message has arrived at its receiver.
  void count_received(ProcessNumber from);
  void drop_too_large(WireReader& in, std::uint64_t size, caf::execution_unit* context);
  caf::strong_actor_ptr local(std::uint32_t number) const;
  Sink sink(std::uint32_t number) const;

  caf::actor_system& system_;
  const std::shared_ptr<LinkMessages> messages_;
  const ProcessNumber self_;
  const std::shared_ptr<ActorNames> names_;
  const std::shared_ptr<LinkClock> clock_ = std::make_shared<LinkClock>();
  const std::shared_ptr<OpenRequests> requests_ = std::make_shared<OpenRequests>();

  mutable std::mutex mutex_;
  std::map<std::uint32_t, Sink> sinks_;
  std::map<ProcessNumber, std::shared_ptr<LinkRecord>> records_;
};

} // namespace castor
