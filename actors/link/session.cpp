#include "castor/actors/link/session.hpp"

#include "castor/actors/link/link_bytes.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

enum class FrameKind : std::uint8_t { part, ack, ping, goodbye };

constexpr std::uint8_t first_part = 1;
constexpr std::uint8_t last_part = 2;
constexpr std::size_t frame_header = sizeof(std::uint32_t) + 1;
constexpr std::size_t part_header = sizeof(std::uint32_t) + 1;
constexpr std::size_t longest_goodbye = 4096;
/// Acknowledgements are owed after so many parts or bytes, and at every reminder.
constexpr std::uint64_t parts_per_ack = 32;
constexpr std::size_t bytes_per_ack = 256 * 1024;

using link_bytes::put;
using link_bytes::take;

/// Begins a frame; `size` is that of its content.
void put_header(std::vector<char>& out, FrameKind kind, std::size_t size) {
  put(out, static_cast<std::uint32_t>(size + 1));
  put(out, kind);
}

} // namespace

struct LinkSession::Message {
  std::uint32_t number = 0;
  /// Count and words, then the head.
  Bytes begin;
  /// Those whose bytes follow.
  std::vector<Value> contents;
  SentContents::Mentions mentions;
  std::size_t size = 0;
  /// Of it, what was cut into parts.
  std::size_t cut = 0;
  std::function<void()> arrived;

  bool is_written() const { return cut == size; }

  /// Appends the bytes from `at` on.
  void copy(std::size_t at, std::size_t n, std::vector<char>& out) const {
    auto append = [&](const Bytes& piece) {
      if (at >= piece.size()) {
        at -= piece.size();
        return;
      }
      auto length = std::min(n, piece.size() - at);
      auto from = piece.begin() + static_cast<std::ptrdiff_t>(at);
      out.insert(out.end(), from, from + static_cast<std::ptrdiff_t>(length));
      n -= length;
      at = 0;
    };
    append(begin);
    for (auto& x : contents) {
      if (n == 0)
        return;
      append(x.bytes());
    }
  }
};

// -- out

/// Puts the words of the contents, and takes those whose bytes follow.
void LinkSession::add_contents(Message& message, OutgoingMessage& from,
                               std::vector<std::uint64_t>& words) {
  std::size_t size = from.head.size();
  for (auto& x : from.contents)
    size += x.bytes().size();
  // Of a message that the peer does not take it keeps nothing.
  bool may_keep = from.may_repeat && size <= limits_.largest_message;
  for (auto& x : from.contents) {
    auto& mentions = message.mentions;
    if (auto kept = may_keep ? sent_contents_.find(x, mentions) : nullptr) {
      words.push_back(message_word(MessageWord::kept, kept->number));
      continue;
    }
    auto length = x.bytes().size();
    if (auto kept = may_keep ? sent_contents_.add(x, length, mentions) : nullptr)
      words.push_back(message_word(MessageWord::keep, kept->number));
    words.push_back(length);
    message.size += length;
    message.contents.push_back(std::move(x));
  }
  if (!may_keep)
    return;
  sent_contents_.take_forgotten(message.mentions);
  for (auto& x : message.mentions.forgotten)
    words.push_back(message_word(MessageWord::forget, x->number));
}

void LinkSession::send(OutgoingMessage message) {
  auto x = std::make_shared<Message>();
  x->number = ++last_number_;
  x->arrived = std::move(message.arrived);
  std::vector<std::uint64_t> words{message.head.size()};
  add_contents(*x, message, words);
  std::vector<char> begin;
  put(begin, static_cast<std::uint32_t>(words.size()));
  for (auto word : words)
    put(begin, word);
  x->begin = std::move(message.head);
  x->begin.insert(x->begin.begin(), begin.begin(), begin.end());
  x->size += x->begin.size();
  if (message.comes_first) {
    first_.push_back(std::move(x));
    return;
  }
  auto lane = std::find_if(long_.begin(), long_.end(),
                           [&](auto& y) { return message.lane != 0 && y.lane == message.lane; });
  if (lane == long_.end() && x->size <= limits_.chunk && x->mentions.are_ready()) {
    short_.push_back(std::move(x));
    return;
  }
  ++long_messages_;
  if (lane == long_.end())
    lane = long_.insert(long_.end(), LongLane{message.lane, {}});
  lane->messages.push_back(std::move(x));
}

LinkSession::Part LinkSession::cut(const MessagePtr& message) {
  Part part{message, message->cut, std::min(limits_.chunk, message->size - message->cut)};
  message->cut += part.size;
  if (message->is_written())
    sent_contents_.written(std::exchange(message->mentions, {}));
  return part;
}

bool LinkSession::next_part(Part& part) {
  if (!first_.empty()) {
    part = cut(first_.front());
    if (part.message->is_written())
      first_.pop_front();
    return true;
  }
  // The message sent first of all that are left is always ready: what it refers to was sent before.
  auto lane =
    std::ranges::find_if(long_, [](auto& x) { return x.messages.front()->mentions.are_ready(); });
  // Short messages pass long ones, but do not hold them up for ever.
  if (!short_.empty() && (lane == long_.end() || short_run_ < limits_.chunk)) {
    part = cut(short_.front());
    short_run_ += part.size;
    short_.pop_front();
    return true;
  }
  short_run_ = 0;
  if (lane == long_.end())
    return false;
  part = cut(lane->messages.front());
  if (part.message->is_written()) {
    lane->messages.pop_front();
    --long_messages_;
  }
  if (lane->messages.empty())
    long_.erase(lane);
  else
    long_.splice(long_.end(), long_, lane);
  return true;
}

void LinkSession::write_part(std::vector<char>& out, const Part& part) const {
  auto& message = *part.message;
  auto needed = out.size() + frame_header + part_header + part.size;
  if (needed > out.capacity())
    out.reserve(std::max(needed, 2 * out.capacity()));
  put_header(out, FrameKind::part, part_header + part.size);
  put(out, message.number);
  std::uint8_t flags = 0;
  if (part.begin == 0)
    flags |= first_part;
  if (part.begin + part.size == message.size)
    flags |= last_part;
  put(out, flags);
  message.copy(part.begin, part.size, out);
}

void LinkSession::produce(std::vector<char>& out, std::size_t at_most) {
  auto end = out.size() + at_most;
  if (received_ - acknowledged_to_peer_ >= parts_per_ack || received_since_ >= bytes_per_ack ||
      (reminded_ && received_ > acknowledged_to_peer_)) {
    put_header(out, FrameKind::ack, sizeof(std::uint64_t));
    put(out, received_);
    acknowledged_to_peer_ = received_;
    received_since_ = 0;
    reminded_ = false;
  }
  while (out.size() < end && rewritten_ < sent_.size())
    write_part(out, sent_[rewritten_++]);
  Part part;
  while (out.size() < end && rewritten_ == sent_.size() && unacknowledged_ < limits_.window &&
         next_part(part)) {
    write_part(out, part);
    unacknowledged_ += part.size;
    sent_.push_back(std::move(part));
    ++rewritten_;
    reminded_ = false;
  }
  if (std::exchange(reminded_, false) || announced_) {
    put_header(out, FrameKind::ping, sizeof(std::uint32_t) + 1);
    put(out, static_cast<std::uint32_t>(promised_.count()));
    put(out, static_cast<std::uint8_t>(awaits_));
    announced_ = false;
  }
  if (!goodbye_.empty()) {
    auto text = std::exchange(goodbye_, {}).substr(0, longest_goodbye);
    put_header(out, FrameKind::goodbye, text.size());
    out.insert(out.end(), text.begin(), text.end());
  }
}

bool LinkSession::has_output() const {
  return reminded_ || announced_ || !goodbye_.empty() || rewritten_ < sent_.size() ||
         received_ - acknowledged_to_peer_ >= parts_per_ack || received_since_ >= bytes_per_ack ||
         (waiting() > 0 && unacknowledged_ < limits_.window);
}

void LinkSession::acknowledge(std::uint64_t received_by_peer) {
  if (received_by_peer > acknowledged_ + sent_.size())
    throw LinkError("the peer acknowledges parts that were never sent");
  while (acknowledged_ < received_by_peer) {
    auto& part = sent_.front();
    unacknowledged_ -= part.size;
    if (part.message->arrived && part.begin + part.size == part.message->size)
      part.message->arrived();
    sent_.pop_front();
    ++acknowledged_;
    rewritten_ -= rewritten_ > 0 ? 1 : 0;
  }
}

void LinkSession::resume(std::uint64_t received_by_peer) {
  if (received_by_peer < acknowledged_)
    throw LinkError("the peer has lost parts that it had acknowledged");
  acknowledge(received_by_peer);
  rewritten_ = 0;
  input_.clear();
  peer_promise_ = {};
  peer_awaits_ = false;
  acknowledged_to_peer_ = received_;
  received_since_ = 0;
}

// -- in

void LinkSession::receive(std::span<const std::uint8_t> bytes,
                          const std::function<void(IncomingMessage)>& deliver) {
  // Whole frames are taken from where they are; only the beginning of one is kept.
  auto in = bytes;
  if (!input_.empty()) {
    input_.insert(input_.end(), bytes.begin(), bytes.end());
    in = input_;
  }
  while (in.size() >= sizeof(std::uint32_t) && peer_goodbye_.empty()) {
    auto rest = in;
    std::size_t size = take<std::uint32_t>(rest);
    if (size == 0 || size > limits_.chunk + part_header + 1)
      throw LinkError("a frame of " + std::to_string(size) + " bytes");
    if (rest.size() < size)
      break;
    take_frame(rest.first(size), deliver);
    in = rest.subspan(size);
  }
  input_ = Bytes{in.begin(), in.end()};
}

void LinkSession::take_frame(std::span<const std::uint8_t> frame,
                             const std::function<void(IncomingMessage)>& deliver) {
  switch (take<FrameKind>(frame)) {
    case FrameKind::part:
      take_part(frame, deliver);
      return;
    case FrameKind::ack:
      acknowledge(take<std::uint64_t>(frame));
      break;
    case FrameKind::ping:
      peer_promise_ = std::chrono::milliseconds{take<std::uint32_t>(frame)};
      peer_awaits_ = take<std::uint8_t>(frame) != 0;
      break;
    case FrameKind::goodbye:
      peer_goodbye_.assign(frame.begin(), frame.end());
      if (peer_goodbye_.empty())
        peer_goodbye_ = "no reason given";
      return;
    default:
      throw LinkError("a frame of an unknown kind");
  }
  if (!frame.empty())
    throw LinkError("a frame is longer than it should be");
}

void LinkSession::take_part(std::span<const std::uint8_t> content,
                            const std::function<void(IncomingMessage)>& deliver) {
  auto number = take<std::uint32_t>(content);
  auto flags = take<std::uint8_t>(content);
  auto known = unfinished_.find(number);
  if ((known == unfinished_.end()) != ((flags & first_part) != 0))
    throw LinkError("parts of a message are out of order");
  if (known == unfinished_.end()) {
    if (unfinished_.size() >= limits_.unfinished_messages)
      throw LinkError("too many messages at the same time");
    known = unfinished_.emplace(number, std::make_shared<UnfinishedMessage>()).first;
  }
  auto message = known->second;
  message->take(content, limits_.largest_message);
  if (message->complete() != ((flags & last_part) != 0))
    throw LinkError("a message is shorter than its declared size");
  ++received_;
  received_since_ += content.size();
  if (!message->complete())
    return;
  unfinished_.erase(known);
  auto result = message->result(received_contents_);
  deliver(std::move(result));
}

} // namespace castor
