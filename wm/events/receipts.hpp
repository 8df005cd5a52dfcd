#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

namespace castor {

/// The receiver's end of a flow that keeps no more than `limit` on their way: counts what the
/// receiver takes, and says when to tell the sender, which is seldom, so that it costs next to
/// nothing.
class Receipts {
public:
  explicit Receipts(std::uint32_t limit) : batch_(batch_for(limit)) {}

  /// So many are acknowledged at a time.
  static std::uint32_t batch_for(std::uint32_t limit) { return std::max(limit / 4, 1U); }

  /// One more is taken: how many are to be acknowledged now.
  std::uint32_t take() { return ++taken_ < batch_ ? 0 : std::exchange(taken_, 0); }

private:
  std::uint32_t batch_;
  std::uint32_t taken_ = 0;
};

} // namespace castor
