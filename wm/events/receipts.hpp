#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

namespace castor {

/// Receiver's end of a flow with at most `limit` unacknowledged items: counts the items taken, and
/// says when to acknowledge them. Acknowledgements are batched, to be cheap.
class Receipts {
public:
  explicit Receipts(std::uint32_t limit) : batch_(batch_for(limit)) {}

  /// Number of items per acknowledgement.
  static std::uint32_t batch_for(std::uint32_t limit) { return std::max(limit / 4, 1U); }

  /// Counts one more item; returns the number to acknowledge now, or 0.
  std::uint32_t take() { return ++taken_ < batch_ ? 0 : std::exchange(taken_, 0); }

private:
  std::uint32_t batch_;
  std::uint32_t taken_ = 0;
};

} // namespace castor
