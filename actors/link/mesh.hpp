#pragma once

#include "castor/actors/link/link_fault.hpp"
#include "castor/actors/link/link_record.hpp"
#include "castor/actors/link/session.hpp"
#include "castor/actors/link/wire_table.hpp"
#include "castor/base/caf.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/events/event_flow.hpp"

#include <caf/mailbox_element.hpp>
#include <caf/message.hpp>
#include <caf/message_id.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace castor {

/// Names an actor in the whole system; 0 is no actor.
using ActorName = std::uint64_t;

constexpr ActorName make_actor_name(ProcessNumber process, std::uint32_t number) {
  return (static_cast<ActorName>(process) + 1) << 32 | number;
}

constexpr ProcessNumber process_of(ActorName name) {
  return static_cast<ProcessNumber>((name >> 32) - 1);
}

/// Actors that every process has under the same number.
enum class WellKnownActor : std::uint32_t {
  /// Answers for the process's part of the system.
  agent = 1,
  /// Hands events to the process's working memories.
  events = 2,
};

/// A message and the types that it must not arrive before.
struct LinkMessage {
  OutgoingMessage message;
  std::vector<TypeDescriptorPtr> types;
};

class Mesh;

/// The near end of the link to another process, for the actors here: they may use it from any
/// thread.
class LinkPort {
public:
  /// The peer takes messages of up to `largest_message` bytes.
  LinkPort(std::shared_ptr<Mesh> mesh, ProcessNumber peer, caf::actor link,
           std::shared_ptr<LinkRecord> record,
           std::size_t largest_message = SessionLimits{}.largest_message)
    : mesh_(std::move(mesh)), peer_(peer), link_(std::move(link)), record_(std::move(record)),
      largest_message_(largest_message) {}

  ProcessNumber peer() const { return peer_; }
  const std::shared_ptr<LinkRecord>& record() const { return record_; }
  const caf::actor& link() const { return link_; }

  /// Sends what was sent to the actor of that name; answers a request that cannot travel itself.
  /// What is too large for its receiver, or for any link, is refused here: whoever waits for it is
  /// told why, and nothing else is affected.
  void send(ActorName to, caf::mailbox_element& x);

  /// Tells the peer that an actor here has ended.
  void tell_end(ActorName who);

private:
  void send_checked(ActorName to, caf::mailbox_element& x);
  /// Does what becomes of a message that is not sent because it is too large.
  void refuse(ActorName to, caf::mailbox_element& x, const Failure& why);
  void hand_over(LinkMessage message);

  /// Tells a working memory that the peer has its events, now and then.
  std::function<void()> acknowledgement(ActorName route, caf::strong_actor_ptr sender,
                                        std::size_t events);

  const std::shared_ptr<Mesh> mesh_;
  const ProcessNumber peer_;
  const caf::actor link_;
  const std::shared_ptr<LinkRecord> record_;
  const std::size_t largest_message_;
  std::mutex mutex_;
  /// By working memory.
  std::unordered_map<caf::actor_id, std::shared_ptr<Receipts>> receipts_;
};

/// The actors of a system as one process sees them: its own, which others may know by name, and
/// those of other processes, for which it has representatives.
///
/// Representatives are ordinary actors to everybody here: messages, requests, monitors and exits
/// work as with a local one. Safe to use from any thread.
class Mesh : public WireNames, public std::enable_shared_from_this<Mesh> {
public:
  /// Called with what arrives for `WellKnownActor::events`, on the network's thread.
  using EventSink = std::function<void(const caf::message& events, caf::execution_unit* context)>;

  Mesh(caf::actor_system& system, const WireTable& table, ProcessNumber self)
    : system_(system), table_(table), self_(self) {}

  caf::actor_system& system() { return system_; }
  const WireTable& table() const { return table_; }
  ProcessNumber self() const { return self_; }

  void set_well_known(WellKnownActor number, const caf::strong_actor_ptr& who);
  void set_event_sink(EventSink sink);

  /// A working memory of another process takes values of up to so many bytes: larger ones are
  /// refused before they are sent.
  void set_largest_value(ActorName working_memory, std::string subarchitecture, std::size_t bytes);

  /// The link that leads to a process.
  void add_port(std::shared_ptr<LinkPort> port);

  /// Injects a fault into the link to a process.
  void inject(ProcessNumber peer, const LinkFault& x);

  /// Of all links there ever were, in the order of their peers.
  std::vector<LinkStatus> links() const;

  /// The process is lost: its actors have ended, as far as everybody here is concerned, and will
  /// not answer what they were asked.
  void end_process(ProcessNumber process);

  /// All processes are lost, and nobody here can be named any more.
  void close();

  /// The representative of a well-known actor of another process.
  caf::strong_actor_ptr well_known(ProcessNumber process, WellKnownActor number);

  ActorName name_of(const caf::strong_actor_ptr& x) override;
  caf::strong_actor_ptr actor_of(ActorName name) override;
  TypeDescriptorPtr type_of(std::uint64_t hash) override;

  /// A message that tells of types, for `receive` at the other end.
  static Bytes introduction(const std::vector<TypeDescriptorPtr>& types);

  /// Carries out what a message from a process asks for. Throws DecodeError.
  void receive(ProcessNumber from, IncomingMessage message, caf::execution_unit* context);

private:
  friend class LinkPort;

  struct Process {
    std::shared_ptr<LinkPort> port;
    std::unordered_map<std::uint32_t, caf::strong_actor_ptr> representatives;
    std::unordered_set<std::uint32_t> ended;
  };

  /// A request that nobody has answered yet.
  struct OpenRequest {
    caf::strong_actor_ptr sender;
    caf::message_id id;
    /// Where it went.
    ProcessNumber process = 0;
  };

  /// Remembers a request until it is answered; false if its process is lost.
  bool open_request(ProcessNumber to, const caf::mailbox_element& x);
  std::optional<Failure> refuse_large_value(ActorName to, const caf::type_erased_tuple& x) const;
  void close_request(const caf::strong_actor_ptr& sender, caf::message_id response);
  void drop_too_large(WireReader& in, std::uint64_t size, caf::execution_unit* context);
  void introduce(TypeDescriptorPtr type);
  void watch(const caf::strong_actor_ptr& who, ActorName name);
  void end_of_local(ActorName name);
  void end_of_remote(ProcessNumber process, std::uint32_t number);

  caf::actor_system& system_;
  const WireTable& table_;
  const ProcessNumber self_;

  mutable std::mutex mutex_;
  bool closed_ = false;
  EventSink event_sink_;
  std::uint32_t last_number_ = 15;
  std::unordered_map<caf::actor_id, std::uint32_t> numbers_;
  std::unordered_map<std::uint32_t, caf::strong_actor_ptr> locals_;
  std::map<ProcessNumber, Process> processes_;
  std::map<ProcessNumber, std::shared_ptr<LinkRecord>> records_;
  /// By the sender, and the number of the answer.
  std::map<std::pair<caf::actor_id, std::uint64_t>, OpenRequest> open_requests_;
  std::unordered_map<std::uint64_t, TypeDescriptorPtr> types_;
  /// By working memory: its subarchitecture, and the largest value that it takes.
  std::map<ActorName, std::pair<std::string, std::size_t>> largest_values_;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::LinkMessage)
