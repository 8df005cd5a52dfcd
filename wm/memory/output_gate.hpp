#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>

namespace castor {

/// What a working memory has to say while changes are on their way to its journal: nobody hears of
/// a change that a crash could undo.
///
/// As long as no more than so many changes, or bytes of values, are unsynced, everything goes out
/// at once. Beyond that it waits until those before it are synced, and keeps its order.
class OutputGate {
public:
  struct Bounds {
    std::size_t changes = 0;
    std::size_t bytes = 0;
  };

  OutputGate() = default;
  explicit OutputGate(Bounds bounds) : bounds_(bounds) {}

  /// Whether what is to go out now has to wait.
  bool holds() const { return changes_ > bounds_.changes || bytes_ > bounds_.bytes; }

  /// A write was handed to the journal, of so many changes that take so many bytes; the last one's
  /// number.
  void written(std::uint64_t sequence, std::size_t changes, std::size_t bytes) {
    unsynced_.push_back({sequence, changes, bytes});
    changes_ += changes;
    bytes_ += bytes;
    last_ = sequence;
  }

  /// To be asked only while it holds.
  void push(std::function<void()> output) { waiting_.emplace_back(last_, std::move(output)); }

  /// Everything up to that change is synced; lets go what waited for that.
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

  /// There is no journal any more: everything goes out.
  void open() { synced(~std::uint64_t{0}); }

  /// What waits is never said.
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
