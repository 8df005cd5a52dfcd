#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace castor::planning {

/// A set of tuples of numbers, each with a number of its own, in a few large pieces of memory:
/// millions of them are freed at once.
class TupleTable {
public:
  using Tuple = std::span<const int>;

  /// Number of the tuple, or -1.
  int find(Tuple tuple) const;
  /// Number of the tuple, and whether it is new.
  std::pair<int, bool> add(Tuple tuple);

  std::size_t size() const { return ends_.size(); }
  /// Valid until a tuple is added.
  Tuple operator[](std::size_t number) const {
    const auto begin = number == 0 ? 0 : ends_[number - 1];
    return {values_.data() + begin, ends_[number] - begin};
  }

private:
  /// Slot of the tuple, or the free one where it belongs.
  std::size_t slot_of(Tuple tuple) const;
  void grow();

  std::vector<int> values_;
  std::vector<std::size_t> ends_;
  /// Numbers of tuples by hash, linearly probed, at most half of them taken; -1 for free ones.
  std::vector<int> slots_ = std::vector<int>(16, -1);
};

} // namespace castor::planning
