#pragma once

#include "castor/actors/link/received_content.hpp"
#include "castor/wm/values/value.hpp"

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

/// Contents that the receiving end of a link keeps because they may be sent again: they cross the
/// link once, and later messages refer to them. So it is with the value of an entry that several
/// components of a process read, each of which gets an answer of its own.
///
/// Values are immutable, so a reference is never stale. The sending end alone decides what is kept,
/// and until when. Messages may overtake each other, so it
/// - lets a message that refers to a content wait until the one that carries it is written, and
/// - says that a content is not needed any more once no message that mentions it is on its way.
namespace castor {

/// Number of a kept content, which is never used twice.
using ContentNumber = std::uint64_t;

/// What a content counts for beside its own bytes.
inline constexpr std::size_t content_overhead = 256;

/// The kept contents, as the sending end knows them.
class SentContents {
public:
  struct Content {
    ContentNumber number = 0;
    /// Its size in bytes, and the overhead.
    std::size_t cost = 0;
    std::weak_ptr<const void> value;
    /// Messages that mention it and are not written completely.
    std::size_t messages = 0;
    /// Whether the message that carries it is written completely.
    bool is_written = false;
  };
  using ContentPtr = std::shared_ptr<Content>;

  /// Kept contents in one message.
  struct Mentions {
    std::vector<ContentPtr> carried;
    /// Those of earlier messages.
    std::vector<ContentPtr> referred;
    std::vector<ContentPtr> forgotten;

    /// Whether all is written that has to arrive before the message.
    bool are_ready() const;
  };

  /// The peer keeps contents of up to `limit` bytes.
  explicit SentContents(std::size_t limit) : limit_(limit) {}
  SentContents(const SentContents&) = delete;
  SentContents& operator=(const SentContents&) = delete;

  /// The content that is this value, if it is kept; to be mentioned in the next message.
  ContentPtr find(const Value& x, Mentions& mentions);

  /// Keeps a value from the next message on, which carries it; null if there is no room. \pre it is
  /// not kept
  ContentPtr add(const Value& x, std::size_t bytes, Mentions& mentions);

  /// What is not needed any more; to be mentioned in the next message.
  void take_forgotten(Mentions& mentions);

  /// A message with these mentions is written completely.
  void written(const Mentions& mentions);

  /// How many contents are kept.
  std::size_t size() const { return by_use_.size(); }

private:
  using ByUse = std::list<ContentPtr>;

  void make_room(std::size_t cost);
  /// Forgets those whose values nobody has any more, from time to time.
  void sweep();
  ByUse::iterator forget(ByUse::iterator x);

  const std::size_t limit_;
  ContentNumber last_number_ = 0;
  /// The least recently used first.
  ByUse by_use_;
  std::map<std::weak_ptr<const void>, ByUse::iterator, std::owner_less<>> by_value_;
  std::vector<ContentPtr> forgotten_;
  /// Costs of the kept contents, and of those that the peer may still keep.
  std::size_t kept_ = 0;
  std::size_t leaving_ = 0;
  /// Number of contents at which to look for those that nobody has any more.
  std::size_t sweep_at_ = 4;
};

/// The kept contents at the receiving end.
class ReceivedContents {
public:
  /// The limit is that of the sending end.
  explicit ReceivedContents(std::size_t limit) : limit_(limit) {}

  // Each throws LinkError if the peer violates the protocol.

  void add(ContentNumber number, ReceivedContentPtr content);
  const ReceivedContentPtr& find(ContentNumber number) const;
  void forget(ContentNumber number);

  std::size_t size() const { return contents_.size(); }

private:
  const std::size_t limit_;
  std::size_t kept_ = 0;
  std::unordered_map<ContentNumber, ReceivedContentPtr> contents_;
};

} // namespace castor
