#pragma once

#include "castor/actors/link/incoming_message.hpp"
#include "castor/actors/link/kept_contents.hpp"
#include "castor/actors/link/link_error.hpp"
#include "castor/actors/link/unfinished_message.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace castor {

/// Messages of one lane, other than 0, arrive in the order in which they were sent.
using Lane = std::uint64_t;

/// A message to another process.
struct OutgoingMessage {
  Bytes head;
  /// Large contents, which follow the head; shared, so that they are not copied.
  std::vector<Value> contents = {};
  Lane lane = 0;
  /// Called once the peer has the whole message.
  std::function<void()> arrived = {};
  /// Passes everything that waits: later messages cannot be read without it.
  bool comes_first = false;
  /// The contents may be sent again, so the peer keeps them if there is room.
  bool may_repeat = false;
};

struct SessionLimits {
  /// Most bytes that one frame carries.
  std::size_t chunk = 64 * 1024;
  /// Unacknowledged bytes at which sending stops.
  std::size_t window = 4 * 1024 * 1024;
  /// The largest message that is taken, in bytes; of a larger one only the head arrives.
  std::size_t largest_message = std::size_t{1} << 30;
  /// Messages that may be under way from the peer at the same time.
  std::size_t unfinished_messages = 4096;
  /// Contents of at least this size in bytes are pieces of their own.
  std::size_t shared_content = 4096;
  /// Bytes of contents that each end keeps for the other, in case they are sent again; the same at
  /// both.
  std::size_t kept_contents = std::size_t{16} << 20;
};

/// Turns messages into frames and back, so that all arrive exactly once, even if the connections
/// that carry them are lost. A long message travels in chunks between which others pass.
///
/// Pure: the owner moves the bytes. Written parts are kept until the peer acknowledges them. A new
/// connection begins with each side telling the other how much it has received (`received`,
/// `resume`), from where the sender goes on.
///
/// A frame is a length (u32, of what follows), a kind (u8) and its content:
///
///     part     u32 the message's number, u8 1 first | 2 last, bytes of the message
///     ack      u64 how many parts were received, since the session began
///     ping     u32 milliseconds until the next sign of life: the peer is alive
///     goodbye  the reason, as text: the peer ends the session
///
/// A message begins with a u32 count and as many u64 words (`MessageWord`): the length of its head,
/// for each content its length or the number of one that the peer keeps, and which of these the
/// peer need not keep any longer. Then follow the bytes of all lengths. All numbers are
/// little-endian.
class LinkSession {
public:
  explicit LinkSession(SessionLimits limits = {})
    : limits_(limits), sent_contents_(limits.kept_contents),
      received_contents_(limits.kept_contents) {}

  void send(OutgoingMessage message);

  /// Appends frames to `out` until there is nothing to send, the window is full or `out` has grown
  /// by `at_most` bytes or a little more.
  void produce(std::vector<char>& out, std::size_t at_most);

  /// Takes what came over the connection, however it was cut. Throws LinkError.
  void receive(std::span<const std::uint8_t> bytes,
               const std::function<void(IncomingMessage)>& deliver);

  /// Number of parts received, from where the peer goes on.
  std::uint64_t received() const { return received_; }

  /// A new connection: everything after the first `received_by_peer` parts is sent again. Throws
  /// LinkError if the peer claims more than was sent, or less than it has acknowledged.
  void resume(std::uint64_t received_by_peer);

  /// Heartbeat: the next `produce` writes a ping if there is nothing else to write. The ping says
  /// that there will be another sign of life after `next` at the latest.
  void remind(std::chrono::milliseconds next) {
    reminded_ = true;
    promised_ = next;
    awaits_ = false;
  }

  /// As `remind`, but a ping is written in any case. It also says whether this side awaits an
  /// answer, so that the peer's signs of life should come as often.
  void announce(std::chrono::milliseconds next, bool awaits) {
    remind(next);
    announced_ = true;
    awaits_ = awaits;
  }

  /// What the peer's last ping said; 0 without one since the connection was made.
  std::chrono::milliseconds peer_promise() const { return peer_promise_; }
  /// Whether the peer awaited an answer then.
  bool peer_awaits() const { return peer_awaits_; }

  /// Ends the session once `produce` was called.
  void say_goodbye(std::string reason) { goodbye_ = std::move(reason); }

  /// The peer's reason to end the session; empty until it has.
  const std::string& goodbye() const { return peer_goodbye_; }

  /// Whether `produce` would write anything.
  bool has_output() const;

  /// Bytes that were written and not acknowledged.
  std::size_t unacknowledged() const { return unacknowledged_; }

  /// Messages that have not been written completely.
  std::size_t waiting() const { return first_.size() + short_.size() + long_messages_; }

private:
  struct Message;
  using MessagePtr = std::shared_ptr<Message>;

  /// A range of bytes of a message.
  struct Part {
    MessagePtr message;
    std::size_t begin = 0;
    std::size_t size = 0;
  };

  /// Messages of one lane, the first of which is long, or waits for one of another lane.
  struct LongLane {
    Lane lane;
    std::deque<MessagePtr> messages;
  };

  void add_contents(Message& message, OutgoingMessage& from, std::vector<std::uint64_t>& words);
  Part cut(const MessagePtr& message);
  void write_part(std::vector<char>& out, const Part& part) const;
  bool next_part(Part& part);
  void take_part(std::span<const std::uint8_t> content,
                 const std::function<void(IncomingMessage)>& deliver);
  void take_frame(std::span<const std::uint8_t> frame,
                  const std::function<void(IncomingMessage)>& deliver);
  void acknowledge(std::uint64_t received_by_peer);

  SessionLimits limits_;

  // -- out
  std::uint32_t last_number_ = 0;
  std::deque<MessagePtr> first_;
  std::deque<MessagePtr> short_;
  std::list<LongLane> long_;
  std::size_t long_messages_ = 0;
  /// Bytes of short messages since the last part of a long one.
  std::size_t short_run_ = 0;
  /// Written but not acknowledged; the first of them is number `acknowledged_`.
  std::deque<Part> sent_;
  std::uint64_t acknowledged_ = 0;
  std::size_t unacknowledged_ = 0;
  /// Of `sent_`, how many were written to the present connection.
  std::size_t rewritten_ = 0;
  bool reminded_ = false;
  bool announced_ = false;
  std::chrono::milliseconds promised_{0};
  bool awaits_ = false;
  std::string goodbye_;
  SentContents sent_contents_;

  // -- in
  Bytes input_;
  std::unordered_map<std::uint32_t, std::shared_ptr<UnfinishedMessage>> unfinished_;
  ReceivedContents received_contents_;
  std::uint64_t received_ = 0;
  std::uint64_t acknowledged_to_peer_ = 0;
  std::size_t received_since_ = 0;
  std::chrono::milliseconds peer_promise_{0};
  bool peer_awaits_ = false;
  std::string peer_goodbye_;
};

} // namespace castor
