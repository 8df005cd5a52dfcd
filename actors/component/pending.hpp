#pragma once

#include <functional>
#include <utility>

namespace castor {

/// An operation that was sent and whose result has not arrived. Call `get()` at most once;
/// destroying this object abandons the result, not the operation.
template <class T>
class Pending {
public:
  explicit Pending(std::function<T()> finish) : finish_(std::move(finish)) {}

  /// Waits for the result; throws what the synchronous operation would throw.
  T get() { return std::exchange(finish_, nullptr)(); }

private:
  std::function<T()> finish_;
};

} // namespace castor
