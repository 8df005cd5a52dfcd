#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>

namespace castor {

/// Holds back outgoing messages of a working memory while changes are not yet in its journal: no
/// message depends on a change that a crash could undo.
///
/// While the unsynced changes and their bytes are within bounds, everything is sent at once. Beyond
/// that, messages wait until the changes before them are synced, and keep their order.
class OutputGate {
public:
  struct Bounds {
    std::size_t changes = 0;
    std::size_t bytes = 0;
  };

  OutputGate() = default;
  explicit OutputGate(Bounds bounds) : bounds_(bounds) {}

  /// Whether a message has to wait now.
  bool holds() const { return changes_ > bounds_.changes || bytes_ > bounds_.bytes; }

  /// Records a write that was sent to the journal: the sequence number of its last change, and the
  /// number and bytes of its changes.
  void written(std::uint64_t sequence, std::size_t changes, std::size_t bytes) {
    unsynced_.push_back({sequence, changes, bytes});
    changes_ += changes;
    bytes_ += bytes;
    last_ = sequence;
  }

  /// Queues a message. \pre holds()
  void push(std::function<void()> output) { waiting_.emplace_back(last_, std::move(output)); }

  /// All changes up to `sequence` are synced: sends the messages that waited for them.
  void synced(std::uint64_t sequence) {
    while (!unsynced_.empty() && unsynced_.front().last <= sequence) {
      changes_ -= unsynced_.front().changes;
      bytes_ -= unsynced_.front().bytes;
      unsynced_.pop_front();
    }
    while (!waiting_.empty() && (!holds() || waiting_.front().first <= sequence)) {
      auto output = std::move(waiting_.front().second);
      waiting_.pop_front();
      output();
    }
  }

  /// There is no journal any more: sends everything.
  void open() { synced(~std::uint64_t{0}); }

  /// Discards the waiting messages.
  void drop() { waiting_.clear(); }

  std::size_t unsynced() const { return changes_; }
  std::size_t waiting() const { return waiting_.size(); }

private:
  struct Write {
    std::uint64_t last = 0;
    std::size_t changes = 0;
    std::size_t bytes = 0;
  };

  Bounds bounds_;
  std::deque<Write> unsynced_;
  std::size_t changes_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t last_ = 0;
  std::deque<std::pair<std::uint64_t, std::function<void()>>> waiting_;
};

} // namespace castor
