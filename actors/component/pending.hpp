#pragma once

#include "castor/wm/entries/failure.hpp"

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

namespace castor {

/// An operation that was sent and whose result has not arrived. Call `get()` or `then()`, and at
/// most once. Destroying this object abandons the result, not the operation; that of a
/// CallbackComponent fails if nobody takes the failure of the operation.
template <class T>
class Pending {
public:
  /// Calls its argument on the component's own turn, once `finish` need not wait.
  using Attach = std::function<void(std::function<void()>)>;

  Pending(std::function<T()> finish, Attach attach)
    : finish_(std::move(finish)), attach_(std::move(attach)) {}

  /// Waits for the result; throws what the synchronous operation would throw. In a
  /// CallbackComponent, which must not wait, throws std::logic_error.
  T get() { return std::exchange(finish_, nullptr)(); }

  /// Calls `callback` with the result, like a callback for a change event: never while other code
  /// of the component runs. If the operation fails, calls `on_failure` with what the synchronous
  /// operation would throw; if that is empty, the component fails.
  void then(std::function<void(T)> callback,
            std::function<void(const WorkingMemoryException&)> on_failure = {}) {
    attach_([finish = std::exchange(finish_, nullptr), callback = std::move(callback),
             on_failure = std::move(on_failure)] {
      if (!on_failure)
        return callback(finish());
      std::optional<T> result;
      try {
        result.emplace(finish());
      } catch (const WorkingMemoryException& e) {
        return on_failure(e);
      }
      callback(*std::move(result));
    });
  }

  /// The operation with `f` of its result as result.
  template <class F>
  auto map(F f) && {
    using U = std::invoke_result_t<F, T>;
    return Pending<U>{
      [finish = std::move(finish_), f = std::move(f)]() -> U { return f(finish()); },
      std::move(attach_)};
  }

private:
  std::function<T()> finish_;
  Attach attach_;
};

} // namespace castor
